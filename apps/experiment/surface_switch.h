#pragma once
#include "experiments/runner/definition/trial.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/surface_change.h"

namespace presa::experiment {

/// Tells rendering that the surfaces have changed. It reads what the trial decided in the tick before, which is no data of this
/// one: so it stands before rendering and the tap behind it, and the change is there in the first tick of its phase.
/// Only where an experiment has such a phase. Thread: haptic, the trial's own; nonblocking.
class SurfaceSwitch final : public Module {
 public:
  /// `trial` outlives it.
  explicit SurfaceSwitch(const Trial& trial) : Module("surface_switch", RateGroup::kHaptic), trial_(trial) {}

  void step(const Tick&) noexcept override { change_.value.happened = trial_.frictionChanged(); }
  std::vector<std::string> stages() const override { return {"change the surfaces when their phase has begun"}; }

 private:
  const Trial& trial_;
  Out<SurfaceChange> change_{*this, "surface_change"};
};

}  // namespace presa::experiment
