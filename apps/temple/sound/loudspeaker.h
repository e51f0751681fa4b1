#pragma once
#include <sys/types.h>

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "apps/temple/sound/stone_sound.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// Plays hits as they happen through aplay, a program of its own that reads samples. A thread of its own writes them, a
/// little ahead of the clock; a player that stops or lags loses sound and delays nobody. Thread: main.
class Loudspeaker {
 public:
  Loudspeaker();
  ~Loudspeaker();
  Loudspeaker(const Loudspeaker&) = delete;
  Loudspeaker& operator=(const Loudspeaker&) = delete;

  /// True where aplay is installed and the system has a device that plays.
  static bool available();
  /// E963: aplay is not installed.
  static void check(Diagnostics& diagnostics);
  /// Plays a hit at once, whatever its time.
  void play(const Hit& hit);

 private:
  void write();

  int stream_ = -1;
  pid_t player_ = -1;
  std::atomic<bool> ends_{false};
  std::mutex mutex_;
  std::vector<Hit> waiting_;
  std::thread writer_;
};

}  // namespace presa::temple
