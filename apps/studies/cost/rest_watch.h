#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/evidence.h"
#include "experiments/study/box_penetration.h"

namespace presa::cost {

/// Measures resting bodies: overlap of boxes, residual kinetic energy, drift, bodies that fell out of the scene. Uses
/// poses only, so that all engines are judged alike. Call observe() with every dynamics step, in order.
class RestWatch {
 public:
  /// `evidence` provides the time windows.
  RestWatch(const World& world, const Evidence& evidence);
  void observe(const ObjectState& objects);
  /// Writes penetration, rest_energy and rest_drift if they apply to the scene.
  void finish(Evidence& evidence) const;
  /// Name of the first body that is now below all fixed boxes; empty: none.
  std::string lost() const;

 private:
  double kineticEnergy(const ObjectState& objects) const;

  const World& world_;
  PenetrationCheck check_;
  double compared_from_, compared_to_, steady_from_, steady_to_;
  std::vector<std::size_t> free_;
  std::vector<Vec3> start_, last_;  ///< positions in the order of free_: at the start of the steady window, and now [m]
  double overlap_ = 0, deepest_ = 0, energy_ = 0, drift_ = 0;
  std::size_t pairs_ = 0, steps_ = 0, compared_ = 0;
};

}  // namespace presa::cost
