#pragma once
#include <vector>

#include "framework/device/device_modules.h"
#include "framework/scene/load.h"
#include "framework/session/plan.h"

namespace presa {

/// The stiffest sampled wall that the devices of a run render stably: K_max = b / ((d + 1/2) T) [GilHulin2009,
/// ColgateSchenkel1997], with b the damping of the device (Device::damping), d the delay of its force in samples, and T
/// the haptic period.
struct StiffnessBound {
  double stiffness =
      0;  ///< K_max of the device with the smallest bound [N/m]; 0: unknown, because no device declares a damping
  double damping = 0;  ///< its b [N s/m]; of turning all in N m, rad
  int delay = 0;       ///< its d: 0 for a model, 1 for hardware, where a command acts one cycle later
  double period = 0;   ///< T [s]
  std::string role;    ///< its role
};
/// Of the devices of fingertips; where there are none, of all.
StiffnessBound stiffnessBound(const DeviceList& devices, const Plan& plan, const Scene& scene);

/// Share of K_max that a material may have: disturbances then die out, even if the hand lets go.
inline constexpr double kStableShare = 0.5;

/// The strongest sampled damper that the devices of a run render stably: B_max = 2 m cos(d pi / (2 d + 1)) / T
/// [LevinMay1976], which is 2 m / T without delay, with m the moving mass (Device::mass). Springs of wall and hand do
/// not change it for d = 0.
struct DampingBound {
  double damping = 0;  ///< B_max of the device with the smallest bound [N s/m]; 0: unknown, no device declares a mass
  double mass = 0;     ///< its m [kg]
  int delay = 0;       ///< its d
  double period = 0;   ///< T [s]
  std::string role;    ///< its role
};
DampingBound dampingBound(const DeviceList& devices, const Plan& plan, const Scene& scene);

/// Overrides that lower the damping of each touchable material to kStableShare of the bound, below which the speed dies
/// out without changing its sign from tick to tick. One warning W464 for each, with the bound.
std::vector<Override> boundedDampings(const Scene& scene, const DampingBound& bound, Diagnostics& diagnostics);

/// Overrides that lower the stiffness of the handle of each tool, in force and in turning (Device::turnDamping), to
/// kStableShare of the bound of its own device; empty: none is above. One warning W454 for each, with the bound.
std::vector<Override> boundedHandles(const DeviceList& devices, const Plan& plan, const Scene& scene,
                                     Diagnostics& diagnostics);

/// The same for each touchable material, and its friction law (attributes in N/m); none where all devices hold tools,
/// which feel the spring of their handles, whatever they touch.
std::vector<Override> boundedMaterials(const Scene& scene, const StiffnessBound& bound, Diagnostics& diagnostics);

}  // namespace presa
