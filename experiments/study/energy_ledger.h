#pragma once
#include <memory>
#include <vector>

#include "experiments/study/study_run.h"

namespace presa {

/// Where the energy of a run is: kinetic, potential and in the springs of the contacts, against the work that the hands
/// put in. A passive simulation never has more than it was given; what it has more, it made itself.
/// Unit J. Thread: the observer's; no allocation after construction.
class EnergyLedger {
 public:
  explicit EnergyLedger(std::shared_ptr<const World> world);
  void observe(const StudySample& sample) noexcept;

  /// Largest rise of (energy − work put in) from any earlier moment.
  double created() const noexcept { return created_; }
  /// Largest |energy − work put in − energy at the start|: drift of a scene that should conserve it.
  double drift() const noexcept { return drift_; }

 private:
  double bodies(const ObjectState& objects) const noexcept;
  void close(double energy) noexcept;

  std::shared_ptr<const World> world_;
  std::vector<BodyMotion> last_;  ///< as Scene::bodies; velocities at the end of the step before the newest
  std::vector<Vec3> p_WH_, f_H_W_;
  std::uint64_t version_ = 0;
  double work_ = 0, start_ = 0, lowest_ = 0, created_ = 0, drift_ = 0;
  bool ticked_ = false, stepped_ = false, open_ = false;
};

}  // namespace presa
