#pragma once
#include <sys/types.h>

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "framework/sound/strike.h"

namespace presa::sound {

/// Plays strikes as they happen through aplay, a program of its own that reads samples. A thread of its own writes
/// them, a little ahead of the clock; a player that stops or lags loses sound and delays nobody. Thread: the owner's.
class Loudspeaker {
 public:
  Loudspeaker();
  ~Loudspeaker();
  Loudspeaker(const Loudspeaker&) = delete;
  Loudspeaker& operator=(const Loudspeaker&) = delete;

  /// True where aplay is installed and the system has a device that plays.
  static bool available();
  /// Name of the program that plays, which must be on the PATH.
  static constexpr const char* kPlayer = "aplay";
  /// The player could not be started, or has ended.
  bool hasGone() const noexcept { return gone_; }
  /// Plays a strike at once, whatever its time.
  void play(const Strike& strike);

 private:
  void write();

  int stream_ = -1;
  pid_t player_ = -1;
  std::atomic<bool> ends_{false}, gone_{false};
  std::mutex mutex_;
  std::vector<Strike> waiting_;
  std::thread writer_;
};

}  // namespace presa::sound
