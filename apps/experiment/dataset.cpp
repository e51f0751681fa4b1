#include "apps/experiment/dataset.h"

#include <filesystem>
#include <map>
#include <set>

#include "apps/experiment/journal.h"
#include "apps/experiment/seal.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/checksum/checksum.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// Validates one session file by file.
class Validation {
 public:
  explicit Validation(const SessionFolder& folder) : folder_(folder) {}

  Verdict run() {
    Journal::Contents contents;
    try {
      contents = Journal::read(folder_.journal());
      log_ = readLog(folder_.journal(), contents.records);
    } catch (const InputError& error) {
      for (const Diagnostic& one : error.diagnostics().all()) alter(format(one));
      return verdict_;
    }
    verdict_.seal = contents.sum;
    known_.insert({kJournal, "trials.csv", "trials.json", kSignatureFile});
    if (contents.torn_bytes > 0)
      find(std::string(kJournal) + ": " + std::to_string(contents.torn_bytes) +
           " bytes of a record that was never finished");
    for (const auto& [name, sum] : contents.records.front().at("sha256").items()) checkSum(name, sum);
    for (const LoggedRun& run : log_.runs) checkRun(run);
    if (!log_.complete) find("the session is not finished: presa experiment resume goes on with it");
    const Json& end = contents.records.back();
    if (log_.complete && end.contains("sha256")) {
      for (const auto& [name, sum] : end.at("sha256").items()) checkSum(name, sum);
    }
    checkStrangers();
    noteTrials();
    return verdict_;
  }

 private:
  void find(const std::string& finding) { verdict_.findings.push_back(finding); }
  void alter(const std::string& finding) {
    verdict_.altered = true;
    find(finding);
  }

  void checkSum(const std::string& name, const std::string& sum) {
    known_.insert(name);
    if (!fs::exists(folder_.file(name))) return alter(name + ": is missing");
    if (sha256OfFile(folder_.file(name)) != sum) alter(name + ": was changed, its SHA-256 is not that of the log");
  }

  void checkRun(const LoggedRun& run) {
    ++verdict_.runs;
    for (const std::string& file : run.files()) known_.insert(file);
    if (run.outcome == Outcome::kDone && !run.practice && run.end.value("excluded", "").empty()) ++verdict_.trials;
    if (!run.end.is_object() || !run.end.contains("sha256")) return;
    for (const auto& [name, sum] : run.end.at("sha256").items()) checkSum(name, sum);
  }

  void checkStrangers() {
    for (const auto& entry : fs::directory_iterator(folder_.path)) {
      const std::string name = entry.path().filename().string();
      if (!known_.contains(name)) find(name + ": is not in the log");
    }
  }

  /// Notes the outcome of the last run of each trial, and why trials are excluded.
  void noteTrials() {
    std::map<int, const LoggedRun*> last;
    for (const LoggedRun& run : log_.runs) {
      if (!run.practice) last[run.number] = &run;
    }
    std::map<std::string, std::vector<int>> trials_of;
    for (const auto& [number, run] : last) {
      const std::string excluded = run->end.is_object() ? run->end.value("excluded", "") : "";
      if (!excluded.empty()) trials_of["excluded, " + excluded].push_back(number);
      if (run->outcome == Outcome::kSkipped) trials_of["skipped"].push_back(number);
      if (run->outcome == Outcome::kAborted && log_.complete)
        trials_of["given up, " + run->end.value("reason", "")].push_back(number);
    }
    for (const auto& [what, numbers] : trials_of) {
      std::string note = what + ": trial";
      for (const int number : numbers) note += " " + std::to_string(number);
      verdict_.notes.push_back(note);
    }
  }

  const SessionFolder& folder_;
  SessionLog log_;
  std::set<std::string> known_;
  Verdict verdict_;
};

}  // namespace

std::vector<SessionFolder> sessionsIn(const std::string& data) {
  std::set<fs::path> found;  // canonical paths: each session once
  std::error_code error;
  const fs::path top = fs::canonical(data, error);
  if (error) return {};
  if (fs::exists(top / kJournal)) found.insert(top);
  for (const auto& entry : fs::recursive_directory_iterator(top, error)) {
    if (entry.path().filename() == kJournal) found.insert(entry.path().parent_path());
  }
  const fs::path here = fs::current_path(error);
  std::vector<SessionFolder> sessions;
  for (const fs::path& folder : found) {
    const fs::path near = folder.lexically_relative(here);
    const bool below = !near.empty() && *near.begin() != "..";
    sessions.push_back({below ? near.string() : folder.string()});
  }
  return sessions;
}

Verdict validate(const SessionFolder& folder) { return Validation(folder).run(); }

}  // namespace presa::experiment
