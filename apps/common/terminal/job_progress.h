#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/common/terminal/interruption.h"

namespace presa::terminal {

/// Progress of many jobs on stderr, with the remaining time: one refreshed line on a terminal, elsewhere a plain line
/// for every tenth of the jobs, at most every two seconds. During its lifetime Ctrl-C and SIGTERM are noted instead of ending the process. Thread: main; one
/// at a time.
class JobProgress {
 public:
  explicit JobProgress(std::size_t jobs);
  ~JobProgress() { finish(); }
  JobProgress(const JobProgress&) = delete;
  JobProgress& operator=(const JobProgress&) = delete;

  void done(const std::string& what);
  void more(std::size_t jobs) { jobs_ += jobs; }
  void fewer(std::size_t jobs) { jobs_ -= jobs; }
  /// Sets the expected remaining time; without it, every job is assumed to last as long as those before.
  void expect(double seconds_left);
  void show();
  void finish();
  static bool interrupted() noexcept { return Interruption::came(); }

 private:
  static constexpr std::size_t kNever = ~std::size_t{0};
  std::size_t jobs_, done_ = 0;
  std::string last_;
  bool terminal_, shown_ = false;
  std::int64_t start_ns_, next_ns_ = 0;
  std::size_t said_tenths_ = kNever;  ///< of the jobs, where there is no terminal
  double expected_end_ = -1;          ///< [s] since the start; negative: unknown
  Interruption interruption_;
};

}  // namespace presa::terminal
