#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/device/pointer_state.h"
#include "framework/scene/world.h"

namespace presa {

/// A number that a device would have the data say of it.
struct DeviceFact {
  std::string name, unit;
  double value = 0;
  bool of_run = false;  ///< drawn anew for each run; else the same whenever seed and person are
};

/// A haptic device of one finger: position out, force in. read and write run on the haptic thread and
/// neither allocate nor block longer than the device exchange; open and close may do anything.
class Device {
 public:
  virtual ~Device() = default;
  /// Makes the device ready. Throws InputError with the exact reason when it cannot.
  virtual void open() {}
  virtual void close() noexcept {}

  /// The sample for this tick. A simulated finger moves on to tick.time under the force held since the last write: after a
  /// stall ticks come without a write between them, or not at all.
  virtual FingerInput read(const Tick& tick) noexcept = 0;
  /// Sends the force on the finger, held until the next write [N, world frame].
  virtual void write(const Vec3& f_H_W, const Tick& tick) noexcept = 0;

  /// Somebody has looked and forgives a latched fault: the device may try again. Called before read.
  virtual void rearm() noexcept {}

  /// Main thread, while read and write go on: opens again what was lost, as open() does; what was not is left alone. Gives up when
  /// `stop` is set. The device stays lost until a re-arm.
  virtual void reopen(const std::atomic<bool>& /*stop*/) {}

  /// A simulated hand that looks: asks for the bodies' poses in see(), called before read. No hardware does.
  virtual bool looks() const { return false; }
  virtual void see(const ObjectState& /*objects*/, const Tick& /*tick*/) noexcept {}

  /// A finger that somebody moves in the window: asks for the pointer's state in point(), called before read. No hardware does.
  virtual bool points() const { return false; }
  virtual void point(const PointerState& /*pointer*/, const Tick& /*tick*/) noexcept {}

  /// What moves the finger where no person does, to be shown with every number that comes of it: "simulated subject, level
  /// L1: a model, not a person"; empty: a person.
  virtual std::string model() const { return {}; }
  /// What there is to know of that model: its traits.
  virtual std::vector<DeviceFact> facts() const { return {}; }
  /// Names of the phases that FingerInput::phase counts; empty for a real hand.
  virtual std::vector<std::string> phases() const { return {}; }
  /// Start times of those phases [s], one more for the end; empty for a real hand.
  virtual std::vector<double> phaseTimes() const { return {}; }
  /// Viscous damping b of device plus hand that the stiffness bound K <= (b + B) / ((d + 1/2) T) may count on [N s/m].
  virtual double damping() const { return 0; }
  /// Lines worth telling the user at start ("finger damping raised to 10 N s/m for 10 N/mm").
  virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace presa
