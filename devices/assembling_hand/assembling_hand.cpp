#include <cmath>

#include "devices/assembling_hand/planner.h"
#include "framework/hand/finger_plant.h"
#include "framework/hand/hand_settings.h"
#include "framework/hand/scripted_hand.h"
#include "framework/plan/plugin.h"
#include "framework/schedule/rates.h"

namespace presa::assembling {
namespace {

/// One side of the pair's plan, as a motion.
class SideMotion final : public Motion {
 public:
  SideMotion(const Planner& planner, double side) : planner_(planner), side_(side) {
    phase_names = Planner::phaseNames();
  }

  MotionTarget at(double time) const noexcept override {
    const PairTarget pair = planner_.at(time), rate = planner_.rate(time);
    const Vec3 along(std::cos(pair.yaw), std::sin(pair.yaw), 0), across(-along.y(), along.x(), 0);
    MotionTarget target;
    target.p_WT = pair.centre + side_ * pair.gap * along;
    target.v_WT = rate.centre + side_ * (rate.gap * along + pair.gap * rate.yaw * across);
    target.phase = planner_.phase();
    if (pair.grip > 0) {
      target.inward_W = -side_ * along;
      target.grip = pair.grip;
    }
    return target;
  }

 private:
  const Planner& planner_;
  double side_;
};

class AssemblingFinger final : public Device {
 public:
  AssemblingFinger(std::unique_ptr<Planner> planner, double side, HandSettings settings, double period)
      : planner_(std::move(planner)),
        hand_(std::make_unique<SideMotion>(*planner_, side), settings.impedance.stiffness),
        damping_(settings.impedance.damping),
        plant_(settings.impedance, period),
        notes_(std::move(settings.notes)) {
    plant_.reset(hand_.motion().at(0).p_WT);
  }

  bool looks() const override { return true; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { planner_->see(objects, tick.time); }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return {plant_.position(), plant_.velocity(), planner_->phase(), true};
  }
  void write(const Vec3& f_H_W, const Tick& tick) noexcept override {
    advance(tick);
    force_ = f_H_W;
  }

  std::vector<std::string> phases() const override { return Planner::phaseNames(); }
  std::string model() const override { return "fingers that assemble by a plan: no person"; }
  double damping() const override { return damping_; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      Vec3 force = force_;
      const MotionTarget target = hand_.live(at_.time, tick.period, plant_.position(), force_, force);
      plant_.step(target.p_WT, target.v_WT, force);
    }
    at_ = tick;
  }

  std::unique_ptr<Planner> planner_;
  ScriptedHand hand_;
  double damping_;
  FingerPlant plant_;
  std::vector<std::string> notes_;
  Tick at_;
  Vec3 force_ = Vec3::Zero();  // [N] held by the device since the last write
};

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  refuseUnknownSettings(binding, {"side", "mass", "stiffness", "damping"}, diagnostics);
  const double side = sideOf(binding, diagnostics);
  HandSettings settings = readImpedance(binding, world, 0, {}, diagnostics);
  if (!world.scene.assembly) {
    diagnostics.error(448, binding.where,
                      "role '" + binding.role + "': the scene has no <assembly>, so there is nothing to put together",
                      "another driver, or a scene with an <assembly> (modules/assembly/README.md)");
  }
  if (diagnostics.errorCount() > before) return nullptr;
  double fingertip = 0;
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role == binding.role) fingertip = role.fingertip_radius;
  }
  return std::make_unique<AssemblingFinger>(std::make_unique<Planner>(std::make_shared<const World>(world), fingertip),
                                            side, std::move(settings),
                                            RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{
    .name = "assembling_hand",
    .summary = "one of two simulated fingertips that put a scene's assembly together by themselves",
    .create = create};

}  // namespace
}  // namespace presa::assembling

PRESA_DEVICE_PLUGIN(presa::assembling::kPlugin)
