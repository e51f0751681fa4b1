#include "experiments/faults/scene_faults.h"

namespace presa::faults {

std::vector<Fault> sceneFaults() {
  return {
      {9, "wall clock jumps", "no effect: nothing that runs reads it", {}, wallClockJumps},
      {10, "everything stands still for 2 to 20 s", "first force after it zero; latched", {}, standsStill},
      {12, "malformed scene", "an error with its place, or accepted; never half loaded", {}, malformedScene},
      {12, "entity expansion bomb", "refused", {}, entityBomb},
      {13, "corrupt mesh", "refused with the reason, or repaired with a warning", {}, corruptMesh},
      {14, "a body runs away", "frozen and reported, forces faded", {0.010, 0.025, false}, bodyRunsAway},
      {14, "the object is struck out of the grasp", "no step, no burst", {}, bodyStruck},
      {15, "stack of 50 bodies, masses of 1 to 10000", "dynamics late, every haptic tick runs", {}, overloadedDynamics},
      {21, "real-time scheduling refused", "hardware refused, or half the force; models go on", {}, realTimeRefused},
      {22, "stiffness above the bound", "half of the stable stiffness, with a warning", {}, tooStiff},
  };
}

}  // namespace presa::faults
