#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/device/phase_intent.h"
#include "framework/device/pointer_state.h"
#include "framework/scene/world.h"

namespace presa {

/// A property of a model that belongs in the data of a run, such as a trait of a simulated subject.
struct DeviceFact {
  std::string name,     ///< of the property: "motor_heat"
      unit;             ///< SI unit such as "N"; "1": none
  double value = 0;     ///< in `unit`
  bool of_run = false;  ///< drawn anew for each run; false: the same for the same seed and subject
};

/// A haptic device of one tool: pose out, wrench in; SI units, world frame W, H is the fingertip's centre (HIP).
/// read, write, rearm, see and point run on the haptic thread, do not allocate and block no longer than the device
/// exchange; open, reopen and close run on the main thread and may block. DeviceInput checks every sample that read()
/// returns, and an OutputStage bounds every wrench before write().
class Device {
 public:
  virtual ~Device() = default;
  /// Makes the device ready. Throws InputError with the exact reason when this fails.
  virtual void open() {}
  virtual void close() noexcept {}  ///< releases it; without effect when it is not open

  /// The sample for this tick; `valid` is false when there is none. A simulated finger advances to tick.time under the
  /// force of the last write: after a stall, ticks are skipped, or come without a write between them.
  virtual FingerInput read(const Tick& tick) noexcept = 0;
  /// Sends the wrench on the tool; the device holds it until the next write. The torque is zero for a driver whose
  /// rating has none.
  virtual void write(const Wrench& F_H_W, const Tick& tick) noexcept = 0;

  /// The user has re-armed the run: clears a latched fault, so that the device may try again. Called before read.
  virtual void rearm() noexcept {}

  /// Reconnects a lost device as open() does and leaves a connected one untouched. Main thread, while read and write
  /// continue. Gives up when `stop` is set. The device stays lost until a re-arm.
  virtual void reopen(const std::atomic<bool>& /*stop*/) {}

  /// True for a simulated hand that needs the bodies' poses; it gets them in see(), before read. False for hardware.
  virtual bool looks() const { return false; }
  /// Poses of this tick; only if looks().
  virtual void see(const ObjectState& /*objects*/, const Tick& /*tick*/) noexcept {}

  /// True if its samples are `oriented`. Constant.
  virtual bool measuresOrientation() const { return false; }

  /// Number of buttons that the user can press; their bits in FingerInput::buttons count from 0. Constant.
  virtual int buttons() const { return 0; }

  /// True for a finger moved with the mouse; it gets the pointer's state in point(), before read. False for hardware.
  virtual bool points() const { return false; }
  /// State of this tick; only if points().
  virtual void point(const PointerState& /*pointer*/, const Tick& /*tick*/) noexcept {}

  /// Name of the model that moves the finger, shown with all results: "simulated subject, level L1: a model, not a
  /// person". Empty: a person moves it.
  virtual std::string model() const { return {}; }
  /// Parameters of that model, for the data of the run.
  virtual std::vector<DeviceFact> facts() const { return {}; }
  /// Names of the phases of a scripted motion, indexed by FingerInput::phase; empty for a real hand.
  virtual std::vector<std::string> phases() const { return {}; }
  /// Start times of those phases, then the end of the last one [s]; empty for a real hand.
  virtual std::vector<double> phaseTimes() const { return {}; }
  /// What those phases are for, in the order of phases(); empty: nobody says.
  virtual std::vector<PhaseIntent> phaseIntents() const { return {}; }
  /// Viscous damping b of device plus hand for the stiffness bound K <= (b + B) / ((d + 1/2) T) [N s/m]; 0: unknown.
  virtual double damping() const { return 0; }
  /// The same for turning, of a device that renders torques: K <= b / ((d + 1/2) T) [N m s/rad]; 0: unknown, or the
  /// orientation does not yield to torque.
  virtual double turnDamping() const { return 0; }
  /// Mass m that the force moves, of device plus hand or less, for the damping bound B < 2 m / T [kg]; 0: unknown.
  virtual double mass() const { return 0; }
  /// Notes for the user, shown at start ("finger damping raised to 10 N s/m for 10 N/mm").
  virtual std::vector<std::string> notes() const { return {}; }
};

/// The devices of a run, in the order of the scene's roles. Opened and closed by the program's main thread.
using DeviceList = std::vector<std::unique_ptr<Device>>;

}  // namespace presa
