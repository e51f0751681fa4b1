#include "devices/hand/planned_finger.h"

#include <cmath>

#include "devices/hand/finger_plant.h"
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

class PlannedFingerDevice final : public Device {
 public:
  explicit PlannedFingerDevice(PlannedFinger finger)
      : finger_(std::move(finger)),
        hand_(std::make_unique<SideMotion>(*finger_.plan, finger_.side), finger_.settings.impedance.stiffness),
        plant_(finger_.settings.impedance, finger_.period) {
    plant_.reset(hand_.motion().at(0).p_WT);
  }

  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { finger_.plan->see(objects, tick.time); }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return {plant_.position(), plant_.velocity(), finger_.plan->phase(), true};
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    force_ = F_H_W.f;
  }

  std::vector<std::string> phases() const override { return finger_.phases; }
  std::string model() const override { return finger_.model; }
  double damping() const override { return finger_.settings.impedance.damping; }
  double mass() const override { return finger_.settings.impedance.mass; }
  std::vector<std::string> notes() const override { return finger_.settings.notes; }

 private:
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      Vec3 force = force_;
      const MotionTarget target = hand_.live(at_.time, tick.period, plant_.position(), force_, force);
      plant_.step(target.p_WT, target.v_WT, force);
    }
    at_ = tick;
  }

  PlannedFinger finger_;
  ScriptedHand hand_;
  FingerPlant plant_;
  Tick at_;
  Vec3 force_ = Vec3::Zero();  // [N] force of the device since the last write
};

}  // namespace

std::unique_ptr<Device> makePlannedFinger(PlannedFinger finger) {
  return std::make_unique<PlannedFingerDevice>(std::move(finger));
}

}  // namespace presa
