#include "apps/common/cluster/array_run.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include "apps/common/atomic_file.h"
#include "apps/common/cluster/slurm.h"
#include "apps/common/shell.h"
#include "apps/common/terminal/job_progress.h"

namespace presa::slurm {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPoll = std::chrono::milliseconds(500);
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
    while (!open.empty() && !end_.interrupted) {
      const std::string array = submit(script_, open, run_.options);
      std::vector<int> lost = follow(array, open);
      open.clear();
      for (const int part : lost) (tries_[part]++ < run_.retries ? open : end_.failed).push_back(part);
    }
    progress_.finish();
    return end_;
  }

 private:
  void writeScript() const {
    std::string script = "#!/bin/bash\n#SBATCH --job-name=" + run_.name + "\n#SBATCH --output=" + run_.folder +
                         "/task_%a.log\n#SBATCH --open-mode=append\n";
    writeFileAtomically(script_, script + "exec " + run_.command("$SLURM_ARRAY_TASK_ID") + "\n");
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
        cancel(array);
        end_.interrupted = true;
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
      std::this_thread::sleep_for(kPoll);
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
