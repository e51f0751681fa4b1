#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace presa {

/// What of a run a picture can show; the names of `--show`, in the order of the window's keys 1 to 9 and 0.
enum class ShownPart : std::size_t {
  kVisual,    ///< bodies as they look
  kHaptic,    ///< what fingers feel, as lines
  kPhysics,   ///< what collides, as lines
  kPatches,   ///< triangles that are near a finger now
  kHips,      ///< where the devices are
  kProxies,   ///< fingertips at the surface
  kCones,     ///< static friction
  kForces,    ///< on the fingers
  kSleeping,  ///< bodies that the dynamics lets rest
  kFrames,    ///< axes of world and bodies, x red, y green, z blue
  kPlots      ///< force, penetration and haptic rate of the last seconds; key g
};
inline constexpr std::array<std::string_view, 11> kShownPartNames{
    "visual", "haptic", "physics", "patches", "hips", "proxies", "cones", "forces", "sleeping", "frames", "plots"};

}  // namespace presa
