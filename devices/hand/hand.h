#pragma once
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "devices/hand/motion.h"
#include "framework/core/schedule/tick.h"
#include "framework/device/device.h"

namespace presa {

/// What one finger of a hand feels of the thimble that it wears. Frame W.
struct Fingertip {
  Vec3 p_WH = Vec3::Zero();   ///< [m]
  Vec3 v_WH = Vec3::Zero();   ///< [m/s]
  Vec3 f_H_W = Vec3::Zero();  ///< force of the device on the fingertip [N]
};

/// What the hand does with the fingertip for one period, with the impedance (m, k, b) of Hand::impedance, frame W:
///   m x'' = k (p_WT - x) + b (v_WT - x') + force of the device + force_W + carry_W + grip_W, summed in this order.
struct HandPush {
  Vec3 p_WT = Vec3::Zero(), v_WT = Vec3::Zero();
  Vec3 force_W = Vec3::Zero();  ///< wanted by the motion [N]
  Vec3 carry_W = Vec3::Zero();  ///< slow correction that carries a load [N]
  Vec3 grip_W = Vec3::Zero();   ///< along the line of the grip [N]

  /// All forces on the fingertip, where `device` is that of the device.
  Vec3 with(const Vec3& device) const noexcept { return device + force_W + carry_W + grip_W; }
};

/// One finger of a simulated hand, or of a hand led by the mouse. Any modelled device may be worn by it: the device
/// moves the fingertip and tells what it feels. Several fingers may be one hand.
/// feel, live, see and point run on the haptic thread and allocate nothing; the others on the main thread.
class Hand {
 public:
  virtual ~Hand() = default;
  /// Throws InputError when the hand cannot work in this run.
  virtual void open() {}
  virtual FingerImpedance impedance() const = 0;
  /// Of the hand [N s/m], as Device::damping.
  virtual double damping() const { return impedance().damping; }
  virtual Vec3 start() const = 0;  ///< fingertip at time 0, frame W [m]

  /// The fingertip at this moment; called whenever its state or the force on it has changed.
  virtual void feel(const Fingertip& tip) noexcept = 0;
  /// What the hand does from `tick` on, for one period.
  virtual HandPush live(const Tick& tick) noexcept = 0;

  virtual int phase(double /*time*/) const noexcept { return -1; }                   ///< FingerInput::phase
  virtual std::uint32_t pressed(double /*time*/) const noexcept { return 0; }        ///< FingerInput::buttons
  virtual double lostAt() const { return std::numeric_limits<double>::infinity(); }  ///< rehearses a lost device [s]
  /// Where the fingertip will be at which times, as far as it is known before the run.
  struct Place {
    double time = 0;
    Vec3 p_WT = Vec3::Zero();
  };
  virtual std::vector<Place> path() const { return {{0, start()}}; }

  // as in Device
  virtual int buttons() const { return 0; }
  virtual bool looks() const { return false; }
  virtual void see(const ObjectState& /*objects*/, const Tick& /*tick*/) noexcept {}
  virtual bool points() const { return false; }
  virtual void point(const PointerState& /*pointer*/) noexcept {}
  virtual std::string model() const { return {}; }
  virtual std::vector<DeviceFact> facts() const { return {}; }
  virtual std::vector<std::string> phases() const { return {}; }
  virtual std::vector<double> phaseTimes() const { return {}; }
  virtual std::vector<PhaseIntent> phaseIntents() const { return {}; }
  virtual std::vector<std::string> notes() const { return {}; }
};
using HandList = std::vector<std::unique_ptr<Hand>>;

}  // namespace presa
