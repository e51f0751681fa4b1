#pragma once
#include "experiments/runner/definition/trial.h"
#include "framework/core/graph/port.h"
#include "framework/scene/surface_change.h"

namespace presa::experiment {

/// Tells the renderer that a phase of the trial has changed the friction of surfaces. It reads the trial's decision of
/// the previous tick, not data of this one, so it runs before the renderer while TrialObserver runs after it; the
/// change applies in the first tick of its phase. In the graph only when an experiment has such a phase. Thread:
/// haptic; nonblocking.
class SurfaceSwitch final : public Module {
 public:
  /// `trial` must outlive this object.
  explicit SurfaceSwitch(const Trial& trial) : Module("surface_switch", RateGroup::kHaptic), trial_(trial) {}

  void step(const Tick&) noexcept override { change_.value.happened = trial_.frictionChanged(); }
  std::vector<std::string> stages() const override { return {"change the surfaces when their phase has begun"}; }

 private:
  const Trial& trial_;
  Out<SurfaceChange> change_{*this, "surface_change"};
};

}  // namespace presa::experiment
