#include "apps/common/cluster/array_run.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <thread>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/slurm.h"
#include "apps/common/terminal/job_progress.h"

namespace presa::slurm {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPoll = std::chrono::milliseconds(500);       // of few parts
constexpr auto kPollOfPart = std::chrono::milliseconds(10);  // of many, for each: Slurm's controller serves others, too
constexpr auto kLongestPoll = std::chrono::seconds(15);
// between the end of a task and its last file on the disk of this machine
constexpr auto kPatience = std::chrono::seconds(5);

class Follow {
 public:
  Follow(const ArrayRun& run, std::vector<int> parts)
      : run_(run), parts_(std::move(parts)), progress_(parts_.size()), script_(run.folder + "/tasks.sh") {}

  ArrayEnd run() {
    writeScript();
    for (const int part : parts_) tries_[part] = 0;
    std::vector<int> open = parts_;
    std::string array = submitted(open);
    run_.on_taken();
    while (!open.empty() && !end_.interrupted) {
      std::vector<int> lost = follow(array, open);
      open.clear();
      for (const int part : lost) (tries_[part]++ < run_.retries ? open : end_.failed).push_back(part);
      if (!open.empty() && !submittedAgain(open, array)) break;
    }
    progress_.finish();
    return end_;
  }

 private:
  std::string submitted(const std::vector<int>& parts) const {
    return submit({script_, run_.name, run_.folder + "/task_", parts, run_.options});
  }
  bool submittedAgain(const std::vector<int>& parts, std::string& array) {
    try {
      array = submitted(parts);
      return true;
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "presa: Slurm refuses to take failed parts again: %s\n", error.what());
      end_.failed.insert(end_.failed.end(), parts.begin(), parts.end());
      return false;
    }
  }
  /// Until then, or Ctrl-C.
  void sleep(Clock::duration time) {
    for (const auto end = Clock::now() + time; Clock::now() < end && !terminal::JobProgress::interrupted();)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  void writeScript() const {
    writeFileAtomically(
        script_, "#!/bin/bash\necho \"part $SLURM_ARRAY_TASK_ID, job $SLURM_ARRAY_JOB_ID, on $(hostname)\"\nexec " +
                     run_.command("$SLURM_ARRAY_TASK_ID") + "\n");
  }

  /// Until none of these parts is left in the queue; returns those that are not done then.
  std::vector<int> follow(const std::string& array, std::vector<int> parts) {
    auto vanished = Clock::time_point::max();
    while (true) {
      std::erase_if(parts, [&](int part) {
        const bool done = run_.is_done(part);
        if (done) progress_.done("shards");
        return done;
      });
      if (parts.empty()) return parts;
      if (terminal::JobProgress::interrupted()) {
        end_.interrupted = true;
        if (!cancel(array))
          std::fprintf(stderr, "array %s is still in the queue: scancel %s\n", array.c_str(), array.c_str());
        return {};
      }
      const auto left = tasksLeft(array);
      const bool queued = !left || std::ranges::any_of(parts, [&](int part) { return left->contains(part); });
      if (queued)
        vanished = Clock::time_point::max();
      else if (vanished == Clock::time_point::max())
        vanished = Clock::now();
      else if (Clock::now() - vanished > kPatience)
        return parts;
      progress_.show();
      sleep(std::clamp<Clock::duration>(kPollOfPart * parts.size(), kPoll, kLongestPoll));
    }
  }

  const ArrayRun& run_;
  const std::vector<int> parts_;
  terminal::JobProgress progress_;
  const std::string script_;
  std::map<int, int> tries_;  // by part
  ArrayEnd end_;
};

}  // namespace

std::string logOf(const ArrayRun& run, int part) { return run.folder + "/task_" + std::to_string(part) + ".log"; }

ArrayEnd runArray(const ArrayRun& run) {
  std::vector<int> open;
  for (int part = 1; part <= run.parts; ++part)
    if (!run.is_done(part)) open.push_back(part);
  return open.empty() ? ArrayEnd{} : Follow(run, std::move(open)).run();
}

}  // namespace presa::slurm
