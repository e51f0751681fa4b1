#include "apps/experiment/session_log.h"

#include <array>
#include <filesystem>

#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

constexpr int kFormat = 1;
constexpr std::array<const char*, 4> kOutcomes{"done", "aborted", "interrupted", "skipped"};

Outcome outcomeOf(const Json& record) {
  const auto name = record.at("outcome").get<std::string>();
  for (std::size_t i = 0; i < kOutcomes.size(); ++i) {
    if (name == kOutcomes[i]) return static_cast<Outcome>(i);
  }
  throw std::out_of_range("no outcome " + name);
}

/// A log names files of its own folder only, without a path.
void checkFileName(const std::string& name) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    throw std::runtime_error("it names " + quote(name) + ", which is no file of its own folder");
}

void checkFiles(const Json& record) {
  if (record.contains("files")) {
    for (const Json& name : record.at("files")) checkFileName(name);
  }
  if (record.contains("sha256")) {
    for (const auto& [name, sum] : record.at("sha256").items()) checkFileName(name);
  }
}

void take(const Json& record, SessionLog& log) {
  checkFiles(record);
  const auto event = record.at("event").get<std::string>();
  if (event == "trial_begin") {
    log.runs.push_back({record.at("trial"),
                        record.at("attempt"),
                        record.at("run"),
                        record.at("practice"),
                        Outcome::kInterrupted,
                        record,
                        {}});
  } else if (event == "trial_end") {
    if (log.runs.empty()) throw std::out_of_range("a trial ends before one began");
    log.runs.back().outcome = outcomeOf(record);
    log.runs.back().end = record;
  } else if (event == "end") {
    log.complete = true;
  }
}

}  // namespace

const char* toString(Outcome outcome) { return kOutcomes[static_cast<std::size_t>(outcome)]; }

std::vector<std::string> SessionFolder::filesOf(const PlannedTrial& trial, int run, std::size_t presentations) {
  const std::string name = terminal::format("%s-%03d_run-%d", trial.practice ? "practice" : "trial", trial.number, run);
  if (presentations == 1) return {name + ".h5"};
  std::vector<std::string> files;
  for (std::size_t i = 1; i <= presentations; ++i) files.push_back(name + "_interval-" + std::to_string(i) + ".h5");
  return files;
}

std::optional<psychophysics::Response> LoggedRun::response() const {
  if (!end.is_object() || !end.contains("response")) return std::nullopt;
  return psychophysics::Response{.chosen = end.at("response").at("chosen"), .value = end.at("response").at("value")};
}

std::string SessionFolder::named(const std::string& relative) const {
  if (relative.empty()) return {};
  return (std::filesystem::absolute(path) / relative).lexically_normal().string();
}

SessionFolder folderOf(const std::string& data, const std::string& subject, int session) {
  return {data + "/sub-" + subject + "/ses-" + std::to_string(session)};
}

Json toJson(const SessionStart& start) {
  return {{"event", "start"},           {"format", kFormat},           {"experiment_file", start.experiment_file},
          {"rig_file", start.rig_file}, {"subject", start.subject.id}, {"number", start.subject.number},
          {"session", start.session},   {"realtime", start.realtime},  {"simulated", start.simulated},
          {"model", start.model},       {"seed", start.seed},          {"recording", start.recording},
          {"window", start.window}};
}

SessionLog readLog(const std::string& file, const std::vector<Json>& records) {
  if (records.empty()) refuse(924, file, "holds no record: the session never began, delete the folder and run it anew");
  SessionLog log;
  try {
    const Json& start = records.front();
    if (start.at("event") != "start") refuse(924, file, "does not begin with the start of a session");
    if (start.at("format").get<int>() > kFormat)
      refuse(924, file, "is of format " + start.at("format").dump() + ", this version of Presa knows 1");
    log.start = {start.at("experiment_file"),
                 start.at("rig_file"),
                 {start.at("subject"), start.at("number")},
                 start.at("session"),
                 start.at("realtime"),
                 start.at("simulated"),
                 start.at("model"),
                 start.value("seed", std::uint64_t{0}),
                 start.value("recording", true),
                 start.value("window", false)};
    for (const Json& record : records) take(record, log);
  } catch (const std::exception& error) {
    if (dynamic_cast<const InputError*>(&error) != nullptr) throw;
    refuse(924, file, std::string("is not the log of a session: ") + error.what());
  }
  return log;
}

}  // namespace presa::experiment
