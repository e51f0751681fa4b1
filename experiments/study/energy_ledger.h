#pragma once
#include <memory>
#include <vector>

#include "experiments/study/study_run.h"

namespace presa {

/// Energy balance of a run: kinetic and potential energy plus the contact springs, against the work done by the hands.
/// A passive simulation never exceeds the energy it was given; any excess was created by the simulation.
/// Unit J. Thread: the observer's; no allocation after construction.
class EnergyLedger {
 public:
  explicit EnergyLedger(std::shared_ptr<const World> world);
  void observe(const HapticSample& sample) noexcept;

  /// Largest rise of (energy - work put in) above any earlier value.
  double created() const noexcept { return created_; }
  /// Largest |energy - work put in - energy at the start|: the drift of a conservative scene.
  double drift() const noexcept { return drift_; }

 private:
  double bodies(const ObjectState& objects) const noexcept;
  void close(double energy) noexcept;

  std::shared_ptr<const World> world_;
  std::vector<BodyMotion> last_;  ///< indexed as Scene::bodies; velocities at the end of the previous step
  std::vector<Vec3> p_WH_, f_H_W_;
  std::uint64_t version_ = 0;
  double work_ = 0, start_ = 0, lowest_ = 0, created_ = 0, drift_ = 0;
  bool ticked_ = false, stepped_ = false, open_ = false;
};

}  // namespace presa
