#pragma once
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace presa::faults {

/// Tells a machine that runs nobody from a supervisor that is late by itself. On each processor a thread of higher
/// priority than the supervisor's notes the time as often as the supervisor writes and does nothing else: where it has a
/// gap, the machine (a host that takes the processor away, an interrupt) ran nobody there.
/// Thread: main. Starts threads: not while a program is forked.
class Witness {
 public:
  Witness();
  ~Witness();
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;

  /// Ends the threads; their notes remain.
  void stop();
  /// After stop: time within [begin, end] in which some processor ran no witness [s].
  double heldUp(std::int64_t begin_ns, std::int64_t end_ns) const;

  static constexpr double kPeriod = 0.25e-3;  ///< of the notes, and of the supervisor's writes [s]
  static constexpr double kGap = 0.5e-3;      ///< a longer pause is no jitter of a wake-up [s]

 private:
  static constexpr std::size_t kNotes = 40'000;  // ten seconds
  struct Notes {
    std::vector<std::int64_t> at_ns;
    std::size_t count = 0;
  };
  void watch(int processor, Notes& notes) const;

  std::atomic<bool> stop_{false};
  std::vector<Notes> notes_;  // by processor
  std::vector<std::jthread> threads_;
};

}  // namespace presa::faults
