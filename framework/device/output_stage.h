#pragma once
#include <algorithm>
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/device/output_limits.h"
#include "framework/device/passivity_controller.h"
#include "framework/device/thermal_budget.h"

namespace presa {

/// Changes that the output stage made to a command (ForceCommand::status, sticky within a tick).
enum OutputStatus : std::uint32_t {
  kOutputClean = 0,
  kOutputNotFinite = 1u << 0,  ///< command was NaN or infinite: latched
  kOutputMagnitude = 1u << 1,  ///< clipped to the force or the torque limit
  kOutputSlew = 1u << 2,       ///< changed slower than asked
  kOutputFading = 1u << 3,     ///< soft start, stop or recovery: scaled by less than 1
  kOutputWatchdog = 1u << 4,   ///< contact information too old, or no sample of the finger: to zero
  kOutputLost = 1u << 5,       ///< device disconnected or reporting implausible samples: latched
  kOutputSpeed = 1u << 6,      ///< over-speed: the force was accelerating a hand that was too fast: latched
  kOutputWarm = 1u << 7,       ///< limited below the command because the motors are warm
  kOutputOverload = 1u << 8,   ///< above the continuous rating, which the rig wants recorded, not limited
  kOutputDamped = 1u << 9,     ///< the passivity controller dissipated energy
  kOutputOther = 1u << 10,     ///< the device of another finger is lost: latched
  kOutputGap = 1u << 11,       ///< no tick ran for longer than Executor::kGap: latched
};
/// Latched faults: each takes the force to zero until a re-arm.
inline constexpr std::uint32_t kOutputLatches =
    kOutputNotFinite | kOutputLost | kOutputSpeed | kOutputOther | kOutputGap;

/// The latched fault in words; null: none.
inline const char* latchedFault(std::uint32_t status) noexcept {
  if ((status & kOutputNotFinite) != 0) return "the commanded force was not a number";
  if ((status & kOutputLost) != 0) return "device disconnected or reporting implausible samples";
  if ((status & kOutputSpeed) != 0) return "over-speed: the force was accelerating a hand that was already too fast";
  if ((status & kOutputOther) != 0) return "the device of another finger is lost";
  if ((status & kOutputGap) != 0) return "the program or the whole machine was suspended";
  return nullptr;
}

/// The last stage between the graph and the device of one tool. Force and torque pass the same steps, each with limits
/// of its own:
///     finite -> magnitude -> energy -> thermal -> fade -> slew
/// For any command, the force sent is finite and at most `force`, changes by at most force_rate * period from one tick
/// to the next, likewise the torque, and both go to zero after a latched fault, where they stay until a re-arm. The
/// slew limit comes last, so that no other stage can cause a step. Always present; no scene can leave it out.
/// Thread: haptic; nonblocking.
class OutputStage {
 public:
  explicit OutputStage(const OutputLimits& limits);  ///< starts at zero force, with a soft start

  /// How far the data behind the command can be trusted.
  enum class Trust : std::uint8_t {
    kGood,
    kFading,   ///< a little old: to zero within fade_out
    kDropped,  ///< too old, or no sample: to zero at the slew limit; returns softly (short gap: at that limit)
  };
  /// All that one step depends on.
  struct Input {
    Wrench command = {};           ///< wanted wrench on the tool, in W
    Trust trust = Trust::kGood;    ///< of the data behind `command`
    bool stop = false;             ///< the run is ending: the force fades
    bool catch_up = false;         ///< catch-up tick, nothing is sent: the fade goes on, the force stays
    bool lost = false;             ///< the device is disconnected or its samples are implausible
    bool other_lost = false;       ///< the device of another finger is lost: the remaining ones must not push the hand
    bool resumed = false;          ///< the first tick after a gap (Tick::resumed)
    Vec3 p_WH = Vec3::Zero();      ///< position of the finger [m]
    Vec3 v_WH = Vec3::Zero();      ///< its velocity [m/s]
    Vec3 w_WT = Vec3::Zero();      ///< angular velocity of an oriented tool [rad/s]
    Quat q_WT = Quat::Identity();  ///< its orientation
  };
  /// Returns the wrench to send, in W. `period`: time since the last step, gaps included [s].
  const Wrench& step(const Input& input, double period) noexcept;

  /// Clears every latched fault; the force comes back from zero with a soft start. A persisting cause latches again.
  void rearm() noexcept;

  std::uint32_t status() const noexcept { return status_; }  ///< OutputStatus bits of the last step
  const Wrench& last() const noexcept { return last_; }      ///< wrench of the last step, in W
  bool latched() const noexcept { return latches_ != 0; }    ///< a latched fault holds the force at zero
  /// Late samples are common: after a gap of at most this length the force comes back without a soft start [s].
  static constexpr double kShortGap = 3e-3;

  /// Share of the heat that the continuous ratings allow: of the forces or of the torques, whichever is larger.
  double heat() const noexcept { return std::max(force_.budget.heat(), torque_.budget.heat()); }

 private:
  /// Limits and state of the force, or of the torque.
  struct Part {
    double max, rate, continuous;
    ThermalBudget budget;
    PassivityController energy;
  };
  /// Where the tool is, in the coordinate in which a part does work.
  struct Motion {
    const Vec3 &x, &v;
  };
  void latchFaults(const Input& input) noexcept;
  Vec3 bounded(Part& part, const Vec3& wanted, const Vec3& last, const Motion& motion, double period) noexcept;
  Vec3 clampMagnitude(Vec3 force, double max, OutputStatus sign) noexcept;
  Vec3 thermalLimit(const Part& part, const Vec3& force, const Vec3& last) noexcept;
  double fade(const Input& input, double period) noexcept;
  Vec3 slewLimit(const Vec3& force, const Vec3& last, double max) noexcept;
  void stepTorque(const Input& input, double gain, double period) noexcept;

  OutputLimits limits_;
  Part force_, torque_;
  Wrench good_;                   // last finite command
  Wrench last_;                   // last wrench sent
  Quat q_WT_ = Quat::Identity();  // orientation at the last tick
  Vec3 turned_ = Vec3::Zero();    // rotation so far [rad]
  double gain_ = 0;
  double gap_ = 0;  // time for which the command has been dropped [s]
  std::uint32_t latches_ = 0, status_ = 0;
  bool over_speed_ = false;  // over-speed at the last tick
};

}  // namespace presa
