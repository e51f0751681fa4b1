#pragma once

namespace presa {

/// Keeps one processor for the haptic thread of a run in real time: no other thread of this process computes or draws
/// there, so that none delays a tick or empties its caches. Of the processors on which this process may run and that no
/// other Presa of this machine keeps, it is the one with the highest clock, among equals the last. Keeps none where the
/// process has only one, or where SCHED_FIFO is refused: the haptic thread must then be free to leave a processor that
/// another program uses. Thread: main.
class HapticProcessor {
 public:
  /// Binds the calling thread, and with it every thread that it starts from now on, to the other processors.
  HapticProcessor();
  ~HapticProcessor();  ///< gives the processor back; the calling thread may run anywhere again
  HapticProcessor(const HapticProcessor&) = delete;
  HapticProcessor& operator=(const HapticProcessor&) = delete;

  void bindCaller() const noexcept;  ///< to the kept processor; thread: the haptic one, before its first tick
  int number() const noexcept { return number_; }  ///< as the system counts; -1: none is kept

 private:
  int number_ = -1, claim_ = -1;
};

}  // namespace presa
