#pragma once
#include <optional>
#include <string>

#include "apps/common/terminal/job_progress.h"
#include "framework/geometry/long_work.h"

namespace presa::terminal {

/// During its lifetime work on geometry that takes long shows its progress on stderr (JobProgress), and Ctrl-C ends it by
/// WorkStopped. Without such work, signals do what they did. Thread: main; one at a time.
class LoadProgress {
 public:
  LoadProgress() : listener_([this](const std::string& what, double share) { return tell(what, share); }) {}

 private:
  static constexpr std::size_t kPercent = 100;
  bool tell(const std::string& what, double share);

  std::optional<JobProgress> progress_;  // while something is worked on
  std::size_t told_ = 0;
  LongWorkListener listener_;
};

}  // namespace presa::terminal
