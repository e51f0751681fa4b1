#pragma once
#include <cstdint>

#include "framework/core/math/spatial.h"
#include "framework/device/output_limits.h"
#include "framework/device/passivity_controller.h"
#include "framework/device/thermal_budget.h"

namespace presa {

/// What the output stage had to do to a command (ForceCommand::status, sticky within a tick).
enum OutputStatus : std::uint32_t {
  kOutputClean = 0,
  kOutputNotFinite = 1u << 0,  ///< command was NaN or infinite: latched
  kOutputMagnitude = 1u << 1,  ///< clipped to the force limit
  kOutputSlew = 1u << 2,       ///< changed slower than asked
  kOutputFading = 1u << 3,     ///< soft start, stop or recovery: scaled below 1
  kOutputWatchdog = 1u << 4,   ///< contact information too old, or no sample of the finger: to zero
  kOutputLost = 1u << 5,       ///< the device is gone or says what cannot be: latched
  kOutputSpeed = 1u << 6,      ///< the device pushed a hand on that was too fast already: latched
  kOutputWarm = 1u << 7,       ///< held below the wish: the motors are warm
  kOutputOverload = 1u << 8,   ///< past the continuous rating where the rig wants that recorded, not limited
  kOutputDamped = 1u << 9,     ///< the passivity controller took energy back
  kOutputOther = 1u << 10,     ///< another finger's device is lost: latched
  kOutputGap = 1u << 11,       ///< no tick ran for longer than a hand can be left alone: latched
};
/// Each takes the force to zero, and only a re-arm lets it come back.
inline constexpr std::uint32_t kOutputLatches =
    kOutputNotFinite | kOutputLost | kOutputSpeed | kOutputOther | kOutputGap;

/// What latched, in words; null: nothing.
inline const char* latchedFault(std::uint32_t status) noexcept {
  if ((status & kOutputNotFinite) != 0) return "the commanded force was not a number";
  if ((status & kOutputLost) != 0) return "its device is gone, or says what cannot be";
  if ((status & kOutputSpeed) != 0) return "its device pushed a hand on that was too fast already";
  if ((status & kOutputOther) != 0) return "another finger's device is lost";
  if ((status & kOutputGap) != 0) return "the program or the whole machine stood still";
  return nullptr;
}

/// The last thing between the graph and one finger:
///     finite -> magnitude -> energy -> thermal -> fade -> slew
/// Whatever the graph commands, what leaves is finite, at most `force`, changes by at most force_rate * period from one that was
/// sent to the next, and goes to zero after a latched fault, where it stays until re-armed. Slew stands last, so that nothing above can
/// make a step. Always present; no scene can leave it out.
/// Thread: haptic; nonblocking.
class OutputStage {
 public:
  explicit OutputStage(const OutputLimits& limits);

  /// How far what the command was made from can be trusted.
  enum class Trust : std::uint8_t {
    kGood,
    kFading,  ///< a little old: to zero within fade_out
    kDropped,  ///< too old, or no sample at all: to zero as fast as slew allows; back softly, at the slew limit after a short gap
  };
  struct Input {
    Vec3 command = Vec3::Zero();  ///< wanted force on the finger [N]
    Trust trust = Trust::kGood;
    bool stop = false;        ///< the run is ending
    bool held = false;        ///< nothing can be sent at this tick: time goes on, the force stays
    bool lost = false;        ///< the device is gone or not to be believed
    bool other_lost = false;  ///< that of another finger is: who lost one finger must not be pushed about by the others
    bool resumed = false;     ///< the first tick after a gap (Tick::resumed)
    Vec3 p_WH = Vec3::Zero();  ///< of the finger [m]
    Vec3 v_WH = Vec3::Zero();  ///< [m/s]
  };
  /// `period`: since the step before [s]; after a gap that is all of it.
  Vec3 step(const Input& input, double period) noexcept;

  /// Out of every latched fault, from zero force and softly. A cause that is still there latches again at once.
  void rearm() noexcept;

  std::uint32_t status() const noexcept { return status_; }
  const Vec3& last() const noexcept { return last_; }
  bool latched() const noexcept { return latches_ != 0; }
  /// A late sample is nothing unusual: a gap no longer than this one dips into the force and does not start it anew [s].
  static constexpr double kShortGap = 3e-3;

  double heat() const noexcept { return budget_.heat(); }  ///< as a share of what the continuous rating allows

 private:
  void judge(const Input& input) noexcept;
  Vec3 bounded(Vec3 force, double most, OutputStatus sign) noexcept;
  Vec3 cooled(const Vec3& force) noexcept;
  double fade(const Input& input, double period) noexcept;
  Vec3 slewed(const Vec3& force, double most) noexcept;

  OutputLimits limits_;
  ThermalBudget budget_;
  PassivityController energy_;
  Vec3 good_ = Vec3::Zero();  // last finite command
  Vec3 last_ = Vec3::Zero();  // last force sent
  double gain_ = 0;
  double gap_ = 0;  // for how long the command is dropped [s]
  std::uint32_t latches_ = 0, status_ = 0;
  bool hurrying_ = false;  // pushed a hand that was too fast, at the last tick
};

}  // namespace presa
