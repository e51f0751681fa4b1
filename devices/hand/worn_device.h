#pragma once
#include "devices/hand/hand.h"

namespace presa {

/// Base of a modelled device that a hand wears: the hand pushes, the device moves, the hand feels. Thread: as Device.
class WornDevice : public Device {
 public:
  explicit WornDevice(std::unique_ptr<Hand> hand) : hand_(std::move(hand)) {}

  void open() override { hand_->open(); }
  int buttons() const override { return hand_->buttons(); }
  bool looks() const override { return hand_->looks(); }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { hand_->see(objects, tick); }
  bool points() const override { return hand_->points(); }
  void point(const PointerState& pointer, const Tick& /*tick*/) noexcept override { hand_->point(pointer); }
  std::string model() const override { return hand_->model(); }
  std::vector<DeviceFact> facts() const override { return hand_->facts(); }
  std::vector<std::string> phases() const override { return hand_->phases(); }
  std::vector<double> phaseTimes() const override { return hand_->phaseTimes(); }
  std::vector<PhaseIntent> phaseIntents() const override { return hand_->phaseIntents(); }
  std::vector<std::string> notes() const override { return hand_->notes(); }
  double damping() const override { return hand_->damping(); }
  double mass() const override { return hand_->impedance().mass; }

 protected:
  /// The fingertip now, as the hand feels it.
  virtual Fingertip fingertip() const noexcept = 0;
  /// Moves the device by one period under this push.
  virtual void move(const HandPush& push, double period) noexcept = 0;

  /// Advances to `tick`; after a stall by more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) {
      move(hand_->live({at_.index, at_.time, tick.period}), tick.period);
      feel();
    }
    at_ = tick;
  }
  /// Tells the hand what it feels; call it where the device starts, and after a force that it feels at once.
  void feel() noexcept { hand_->feel(fingertip()); }
  /// The sample of a device that reports this position and velocity.
  FingerInput sample(const Vec3& p_WH, const Vec3& v_WH, const Tick& tick) const noexcept {
    FingerInput input{p_WH, v_WH, hand_->phase(tick.time), tick.time < hand_->lostAt()};
    input.buttons = hand_->pressed(tick.time);
    return input;
  }
  Hand& hand() noexcept { return *hand_; }
  const Hand& hand() const noexcept { return *hand_; }

 private:
  std::unique_ptr<Hand> hand_;
  Tick at_;  // time of the device
};

/// Inserts what the device is before what the hand is: "ARMS, HAND: no device, no person".
inline std::string modelOf(const std::string& device, const std::string& hand) {
  const std::size_t colon = hand.find(": ");
  if (colon == std::string::npos) return device + ": no device";
  return device + ", " + hand.substr(0, colon) + ": no device, " + hand.substr(colon + 2);
}

}  // namespace presa
