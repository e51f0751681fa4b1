#pragma once
#include <cstdint>

#include "framework/math/spatial.h"

namespace presa {

/// What the output stage had to do to a command (ForceCommand::status, sticky within a tick).
enum OutputStatus : std::uint32_t {
  kOutputClean = 0,
  kOutputNotFinite = 1u << 0,  ///< command was NaN or infinite: latched, force fades to zero for good
  kOutputMagnitude = 1u << 1,  ///< clipped to the force limit
  kOutputSlew = 1u << 2,       ///< changed slower than asked
  kOutputFading = 1u << 3,     ///< soft start, stop or recovery: scaled below 1
  kOutputWatchdog = 1u << 4,   ///< contact information too old: fading to zero
};

struct OutputLimits {
  double force = 8;          ///< magnitude [N]
  double force_rate = 1000;  ///< slew [N/s]
  double soft_start = 0.5;   ///< from zero to full force at start and after a watchdog [s]
  double fade_out = 0.02;    ///< from full force to zero [s]
};

/// The last thing between the graph and one finger: finite -> magnitude -> fade (watchdog, stop, soft start)
/// -> slew. Whatever the graph commands, what leaves is finite, at most `force`, changes by at most
/// force_rate * period from one that was sent to the next, and reaches zero after a latched fault. Always present; no scene
/// can leave it out.
/// Thread: haptic; nonblocking.
class OutputStage {
 public:
  explicit OutputStage(const OutputLimits& limits) : limits_(limits) {}

  struct Input {
    Vec3 command = Vec3::Zero();   ///< wanted force on the finger [N]
    bool information_old = false;  ///< the watchdog's verdict on the ages of what the command was made from
    bool stop = false;             ///< the run is ending
    bool held = false;             ///< nothing can be sent at this tick: time goes on, the force stays
  };
  Vec3 step(const Input& input, double period) noexcept;

  std::uint32_t status() const noexcept { return status_; }
  const Vec3& last() const noexcept { return last_; }
  bool latched() const noexcept { return latched_; }

 private:
  OutputLimits limits_;
  Vec3 good_ = Vec3::Zero();  // last finite command
  Vec3 last_ = Vec3::Zero();  // last force sent
  double gain_ = 0;
  bool latched_ = false;
  std::uint32_t status_ = 0;
};

}  // namespace presa
