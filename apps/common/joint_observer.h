#pragma once
#include "apps/common/joint_log.h"
#include "framework/record/haptic_observer.h"

namespace presa {

/// Logs the joints of a scene at the end of each dynamics step. Read the log after the run.
class JointObserver final : public HapticObserver {
 public:
  explicit JointObserver(JointLog& log) : HapticObserver("joint_observer"), log_(log) {}

  void observe(const HapticSample& sample) noexcept override {
    if (sample.objects == nullptr || sample.objects_version == version_) return;
    version_ = sample.objects_version;
    const ObjectState& state = *sample.objects;
    const double span = state.time_end - state.time_begin;
    if (!(span > 0) || state.bodies.size() < log_.scene().bodies.size()) return;
    if (first_) log_.add(state.time_begin, 0, [&](std::size_t body) { return state.bodies[body].X_WB_begin; });
    first_ = false;
    log_.add(state.time_end, span, [&](std::size_t body) { return state.bodies[body].X_WB_end; });
  }
  std::vector<std::string> stages() const override { return {"log the positions of the joints"}; }

 private:
  JointLog& log_;
  std::uint64_t version_ = 0;
  bool first_ = true;
};

}  // namespace presa
