#include "apps/experiment/simulate/studies.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <thread>

#include "apps/common/file_text.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/session_log.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using terminal::format;

enum class State { kNone, kBegun, kComplete };

State stateOf(const SessionFolder& folder) {
  if (!fs::exists(folder.journal())) return State::kNone;
  const Journal::Contents contents = Journal::read(folder.journal());
  if (contents.records.empty()) return State::kNone;
  return readLog(folder.journal(), contents.records).complete ? State::kComplete : State::kBegun;
}

std::string lastLineOf(const std::string& file) {
  std::istringstream in(contentsOf(file));
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

/// The running worker processes.
class Workers {
 public:
  explicit Workers(const StudiesPlan& plan) : plan_(plan) {}

  void start(const StudySession& session, const SessionFolder& folder, bool resume) {
    fs::create_directories(session.data);
    const std::string log = session.data + "/" + session.subject_id + ".log";
    std::vector<std::string> words = wordsFor(session, folder, resume);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    pid_t id = 0;
    const int error = ::posix_spawn(&id, "/proc/self/exe", &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start a session");
    running_[id] = {session.subject_id, log};
  }

  std::size_t size() const { return running_.size(); }

  struct Ended {
    int status = 0;
    std::string subject, log;
  };
  /// A process that has ended, if there is one.
  std::optional<Ended> reap() {
    int status = 0;
    const pid_t id = ::waitpid(-1, &status, WNOHANG);
    const auto found = running_.find(id);
    if (id <= 0 || found == running_.end()) return std::nullopt;
    Ended ended{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), found->second.subject,
                found->second.log};
    running_.erase(found);
    return ended;
  }
  void stopAll() const {
    for (const auto& [id, what] : running_) ::kill(id, SIGINT);
  }

 private:
  struct Running {
    std::string subject, log;
  };

  std::vector<std::string> wordsFor(const StudySession& session, const SessionFolder& folder, bool resume) const {
    if (resume) return {"presa-experiment", "resume", folder.path};
    std::vector<std::string> words{
        "presa-experiment", "run",    plan_.experiment_file, "--subject", session.subject_id,
        "--lockstep",       "--data", session.data,          "--seed",    std::to_string(session.seed)};
    if (!plan_.level.empty()) words.insert(words.end(), {"--simulated", plan_.level});
    if (!plan_.rig_file.empty()) words.insert(words.end(), {"--rig", plan_.rig_file});
    if (!plan_.recordings) words.emplace_back("--no-recording");
    return words;
  }

  const StudiesPlan& plan_;
  std::map<pid_t, Running> running_;
};

}  // namespace

std::vector<StudySession> sessionsOf(const StudiesPlan& plan, std::uint64_t first_seed) {
  std::vector<StudySession> all;
  std::size_t index = 0;
  for (int study = 1; study <= plan.studies; ++study) {
    for (int subject = 1; subject <= plan.subjects; ++subject) {
      if (!plan.shard.holds(index++)) continue;
      all.push_back({study, subject, plan.out + format("/study-%03d", study), format("S%02d", subject),
                     first_seed + static_cast<std::uint64_t>(study - 1)});
    }
  }
  return all;
}

StudiesOutcome runStudies(const StudiesPlan& plan, const std::vector<StudySession>& sessions) {
  const auto processors = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t jobs = plan.jobs > 0 ? static_cast<std::size_t>(plan.jobs) : processors;
  StudiesOutcome outcome;
  std::vector<std::pair<const StudySession*, State>> waiting;
  for (const StudySession& session : sessions) {
    const State state = stateOf(folderOf(session.data, session.subject_id, 1));
    if (state == State::kComplete)
      ++outcome.found;
    else
      waiting.emplace_back(&session, state);
  }
  terminal::JobProgress progress(waiting.size());
  Workers workers(plan);
  std::size_t next = 0;
  while (next < waiting.size() || workers.size() > 0) {
    if (terminal::JobProgress::interrupted() && !outcome.interrupted) {
      outcome.interrupted = true;
      next = waiting.size();
      workers.stopAll();
    }
    while (next < waiting.size() && workers.size() < jobs) {
      const auto& [session, state] = waiting[next++];
      workers.start(*session, folderOf(session->data, session->subject_id, 1), state == State::kBegun);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    while (const auto ended = workers.reap()) {
      if (ended->status == 0) {
        ++outcome.complete;
        fs::remove(ended->log);
      } else if (!outcome.interrupted) {
        outcome.failed.push_back(ended->log + ": " + lastLineOf(ended->log));
      }
      progress.done(ended->subject);
    }
    progress.show();
  }
  return outcome;
}

}  // namespace presa::experiment
