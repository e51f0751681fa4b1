#pragma once
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
  kOutputMagnitude = 1u << 1,  ///< clipped to the force limit
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

/// The last stage between the graph and the device of one finger:
///     finite -> magnitude -> energy -> thermal -> fade -> slew
/// For any command, the force sent is finite and at most `force`, changes by at most force_rate * period from one tick
/// to the next, and goes to zero after a latched fault, where it stays until a re-arm. The slew limit comes last, so
/// that no other stage can cause a step. Always present; no scene can leave it out.
/// Thread: haptic; nonblocking.
class OutputStage {
 public:
  explicit OutputStage(const OutputLimits& limits);

  /// How far the data behind the command can be trusted.
  enum class Trust : std::uint8_t {
    kGood,
    kFading,   ///< a little old: to zero within fade_out
    kDropped,  ///< too old, or no sample: to zero at the slew limit; returns softly (short gap: at that limit)
  };
  struct Input {
    Vec3 command = Vec3::Zero();  ///< wanted force on the finger, in W [N]
    Trust trust = Trust::kGood;
    bool stop = false;         ///< the run is ending: the force fades
    bool catch_up = false;     ///< catch-up tick, nothing is sent: the fade goes on, the force stays
    bool lost = false;         ///< the device is disconnected or its samples are implausible
    bool other_lost = false;   ///< the device of another finger is lost: the remaining ones must not push the hand
    bool resumed = false;      ///< the first tick after a gap (Tick::resumed)
    Vec3 p_WH = Vec3::Zero();  ///< position of the finger [m]
    Vec3 v_WH = Vec3::Zero();  ///< its velocity [m/s]
  };
  /// Returns the force to send, in W [N]. `period`: time since the last step, gaps included [s].
  Vec3 step(const Input& input, double period) noexcept;

  /// Clears every latched fault; the force comes back from zero with a soft start. A persisting cause latches again.
  void rearm() noexcept;

  std::uint32_t status() const noexcept { return status_; }
  const Vec3& last() const noexcept { return last_; }
  bool latched() const noexcept { return latches_ != 0; }
  /// Late samples are common: after a gap of at most this length the force comes back without a soft start [s].
  static constexpr double kShortGap = 3e-3;

  double heat() const noexcept { return budget_.heat(); }  ///< share of the heat that the continuous rating allows

 private:
  void latchFaults(const Input& input) noexcept;
  Vec3 clampMagnitude(Vec3 force, double max, OutputStatus sign) noexcept;
  Vec3 thermalLimit(const Vec3& force) noexcept;
  double fade(const Input& input, double period) noexcept;
  Vec3 slewLimit(const Vec3& force, double max) noexcept;

  OutputLimits limits_;
  ThermalBudget budget_;
  PassivityController energy_;
  Vec3 good_ = Vec3::Zero();  // last finite command
  Vec3 last_ = Vec3::Zero();  // last force sent
  double gain_ = 0;
  double gap_ = 0;  // time for which the command has been dropped [s]
  std::uint32_t latches_ = 0, status_ = 0;
  bool over_speed_ = false;  // over-speed at the last tick
};

}  // namespace presa
