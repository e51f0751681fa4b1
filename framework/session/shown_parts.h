#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace presa {

/// Parts of a run that a picture can show; the names of `--show`, in the order of the window's keys 1 to 9 and 0.
enum class ShownPart : std::size_t {
  kVisual,      ///< bodies as they look
  kHaptic,      ///< haptic geometries, as lines
  kPhysics,     ///< physics geometries, as lines
  kPatches,     ///< triangles that are near a finger now
  kHips,        ///< HIPs, the positions of the devices
  kProxies,     ///< fingertips at the surface
  kCones,       ///< cones of static friction
  kForces,      ///< forces on the fingers
  kSleeping,    ///< bodies that sleep in the dynamics
  kFrames,      ///< axes of world, bodies, rig, contacts and faces, x red, y green, z blue
  kPlots,       ///< force, penetration and haptic rate of the last seconds; key g
  kTexture,     ///< height of the felt surface around a touching finger, where a texture is felt; key t
  kOffset,      ///< of each finger from its HIP and from the touched object, as numbers; key o
  kJoints,      ///< joints between bodies with their positions; key j
  kDevices,     ///< devices whose driver has a figure (framework/device/device_figure.h); key d
  kCompliance,  ///< deflection of their structure under the present force; key b
  kHeat,        ///< heat of their motors; key w
  kPoints,      ///< places at which bodies hold tools with volume, each with its force; key k
  kCoupling,    ///< where the handles of such tools are; key l
  kField        ///< signed distances of the bodies as a tool meets them, on a plane through it; key f
};
inline constexpr std::array<std::string_view, 20> kShownPartNames{
    "visual", "haptic",  "physics", "patches", "hips",    "proxies",    "cones", "forces", "sleeping", "frames",
    "plots",  "texture", "offset",  "joints",  "devices", "compliance", "heat",  "points", "coupling", "field"};

}  // namespace presa
