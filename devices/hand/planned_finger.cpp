#include "devices/hand/planned_finger.h"

#include <cmath>

#include "devices/hand/scripted_hand.h"

namespace presa {
namespace {

/// One finger of a pair plan as a motion.
class SideMotion final : public Motion {
 public:
  SideMotion(const PairPlan& plan, double side) : plan_(plan), side_(side) {}

  MotionTarget at(double time) const noexcept override {
    const PairTarget pair = plan_.at(time), rate = plan_.rate(time);
    const Vec3 along(std::cos(pair.yaw), std::sin(pair.yaw), 0), across(-along.y(), along.x(), 0);
    MotionTarget target;
    target.p_WT = pair.centre + side_ * pair.gap * along;
    target.v_WT = rate.centre + side_ * (rate.gap * along + pair.gap * rate.yaw * across);
    target.phase = plan_.phase();
    if (pair.grip > 0) {
      target.inward_W = -side_ * along;
      target.grip = pair.grip;
    }
    return target;
  }

 private:
  const PairPlan& plan_;
  double side_;
};

/// The hand along the motion that the plan becomes.
class PlannedHand final : public ScriptedHand {
 public:
  explicit PlannedHand(PlannedFinger finger)
      : ScriptedHand(alongPlan(finger)),
        plan_(std::move(finger.plan)),
        phases_(std::move(finger.phases)),
        model_(std::move(finger.model)) {}

  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { plan_->see(objects, tick.time); }
  int phase(double /*time*/) const noexcept override { return plan_->phase(); }
  std::vector<Place> path() const override { return Hand::path(); }  // nobody knows it before the run
  std::string model() const override { return model_; }
  std::vector<std::string> phases() const override { return phases_; }

 private:
  static HandSettings alongPlan(PlannedFinger& finger) {
    finger.settings.motion = std::make_unique<SideMotion>(*finger.plan, finger.side);
    finger.settings.lost_at = std::numeric_limits<double>::infinity();
    return std::move(finger.settings);
  }

  std::unique_ptr<PairPlan> plan_;
  std::vector<std::string> phases_;
  std::string model_;
};

}  // namespace

std::unique_ptr<Hand> makePlannedFinger(PlannedFinger finger) {
  return std::make_unique<PlannedHand>(std::move(finger));
}

}  // namespace presa
