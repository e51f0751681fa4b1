#include "apps/presa/experiment/dataset.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "framework/checksum/checksum.h"
#include "framework/diagnostics/diagnostics.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// Findings of one session, collected file by file.
class Validation {
 public:
  explicit Validation(const SessionFolder& folder) : folder_(folder) {}

  Verdict run() {
    Journal::Contents contents;
    try {
      contents = Journal::read(folder_.journal());
      log_ = readLog(folder_.journal(), contents.records);
    } catch (const InputError& error) {
      for (const Diagnostic& one : error.diagnostics().all()) find(format(one));
      return verdict_;
    }
    known_.insert({"journal.jsonl", "trials.csv", "trials.json"});
    if (contents.torn_bytes > 0)
      find("journal.jsonl: " + std::to_string(contents.torn_bytes) + " bytes of a record that was never finished");
    for (const auto& [name, sum] : contents.records.front().at("sha256").items()) checkSum(name, sum);
    for (const LoggedRun& run : log_.runs) checkRun(run);
    if (!log_.complete) find("the session is not finished: presa experiment resume goes on with it");
    checkTable();
    checkStrangers();
    return verdict_;
  }

 private:
  void find(const std::string& finding) { verdict_.findings.push_back(finding); }

  void checkSum(const std::string& name, const std::string& sum) {
    known_.insert(name);
    if (!fs::exists(folder_.file(name))) return find(name + ": is missing");
    if (sha256OfFile(folder_.file(name)) != sum) find(name + ": was changed, its SHA-256 is not that of the log");
  }

  void checkRun(const LoggedRun& run) {
    ++verdict_.runs;
    const auto file = run.begin.at("file").get<std::string>();
    known_.insert(file);
    if (run.outcome == Outcome::kDone && !run.practice && run.end.value("excluded", "").empty()) ++verdict_.trials;
    if (run.end.is_object() && run.end.contains("sha256")) checkSum(file, run.end.at("sha256"));
  }

  // one row per run and the heading
  void checkTable() {
    std::ifstream in(folder_.file("trials.csv"));
    if (!in) return find("trials.csv: is missing");
    const auto lines = std::count(std::istreambuf_iterator<char>(in), {}, '\n');
    if (static_cast<std::size_t>(lines) != log_.runs.size() + 1)
      find("trials.csv: has " + std::to_string(lines - 1) + " rows, the log " + std::to_string(log_.runs.size()));
  }

  void checkStrangers() {
    for (const auto& entry : fs::directory_iterator(folder_.path)) {
      const std::string name = entry.path().filename().string();
      if (!known_.contains(name)) find(name + ": is not in the log");
    }
  }

  const SessionFolder& folder_;
  SessionLog log_;
  std::set<std::string> known_;
  Verdict verdict_;
};

}  // namespace

std::vector<SessionFolder> sessionsIn(const std::string& data) {
  std::vector<SessionFolder> found;
  std::error_code error;
  if (fs::exists(data + "/journal.jsonl")) found.push_back({data});
  for (const auto& entry : fs::recursive_directory_iterator(data, error)) {
    if (entry.path().filename() == "journal.jsonl" && entry.path().parent_path() != fs::path(data))
      found.push_back({entry.path().parent_path().string()});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return found;
}

Verdict validate(const SessionFolder& folder) { return Validation(folder).run(); }

}  // namespace presa::experiment
