#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/evidence.h"
#include "experiments/study/box_penetration.h"

namespace presa::cost {

/// What bodies that lie on each other do: overlap, keep moving, stray, fall out. From poses alone, so that every engine is
/// judged alike. Give it every dynamics step, in order.
class RestWatch {
 public:
  /// The windows are those of `evidence`.
  RestWatch(const World& world, const Evidence& evidence);
  void observe(const ObjectState& objects);
  /// Writes penetration, rest_energy and rest_drift where the scene has them.
  void finish(Evidence& evidence) const;
  /// First body that lies below everything fixed now; empty: none.
  std::string lost() const;

 private:
  double kineticEnergy(const ObjectState& objects) const;

  const World& world_;
  PenetrationCheck check_;
  double compared_from_, compared_to_, steady_from_, steady_to_;
  std::vector<std::size_t> free_;
  std::vector<Vec3> start_, last_;  ///< positions by free_: where the steady window began, and now
  double overlap_ = 0, deepest_ = 0, energy_ = 0, drift_ = 0;
  std::size_t pairs_ = 0, steps_ = 0, compared_ = 0;
};

}  // namespace presa::cost
