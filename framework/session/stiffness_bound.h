#pragma once
#include <vector>

#include "framework/device/device_modules.h"
#include "framework/scene/load.h"
#include "framework/session/plan.h"

namespace presa {

/// The stiffest sampled wall that the devices of a run bear: K_max = b / ((d + 1/2) T) [GilHulin2009, ColgateSchenkel1997], b the
/// damping that a device claims (Device::damping), d the samples that its force comes late.
struct StiffnessBound {
  double stiffness =
      0;  ///< K_max of the device that bears least [N/m]; 0: no device claims any damping, nothing is known
  double damping = 0;  ///< its b [N s/m]
  int delay = 0;       ///< its d: 0 where it is a model, 1 where commands go to hardware and act a cycle later
  double period = 0;   ///< T [s]
  std::string role;    ///< that it plays
};
StiffnessBound stiffnessBound(const DeviceList& devices, const Plan& plan, const Scene& scene);

/// Share of K_max that a material may have: with it every disturbance dies out, and the hand may let go.
inline constexpr double kStableShare = 0.5;

/// Brings each material that fingers can touch down to kStableShare of the bound; empty: none is above. One warning W454 for
/// each, with the bound.
std::vector<Override> boundedMaterials(const Scene& scene, const StiffnessBound& bound, Diagnostics& diagnostics);

}  // namespace presa
