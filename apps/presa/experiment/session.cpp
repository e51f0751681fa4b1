#include "apps/presa/experiment/session.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "apps/presa/atomic_file.h"
#include "apps/presa/experiment/conduct.h"
#include "apps/presa/experiment/dry_run.h"
#include "apps/presa/experiment/inputs.h"
#include "apps/presa/experiment/trial_table.h"
#include "apps/presa/machine.h"
#include "apps/presa/terminal/job_progress.h"
#include "apps/presa/terminal/text.h"
#include "apps/presa/version.h"
#include "framework/checksum/checksum.h"
#include "framework/diagnostics/refuse.h"
#include "framework/experiment/row.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// For people only: nothing is computed from it, so that a clock that jumps does no harm.
std::string utcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::vector<std::pair<const char*, const std::string*>> documentsOf(const Experiment& experiment) {
  return {{"experiment.xml", &experiment.resolved_xml},
          {"scene.xml", &experiment.scene_xml},
          {"rig.xml", &experiment.rig_xml}};
}

std::string contentsOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A process that died before its first record leaves an empty log: nothing to overwrite.
Journal createJournal(const SessionFolder& folder) {
  if (!fs::exists(folder.journal())) return Journal::create(folder.journal());
  Journal::Contents contents;
  Journal journal = Journal::reopen(folder.journal(), contents);
  if (!contents.records.empty()) return Journal::create(folder.journal());  // says that it is there
  return journal;
}

/// On the disk, and under its name: what the log says of a file must hold after a power cut too.
void syncFile(const std::string& path, int flags = 0) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  const int error = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot write " + path);
}
void syncFolder(const fs::path& folder) { syncFile(folder.string(), O_DIRECTORY); }

Json conditionOf(const Experiment& experiment, const PlannedTrial& trial) {
  Json condition = Json::object();
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns)
      condition[column.name] = experiment.valueOf(column.name, trial.condition);
  }
  return condition;
}

Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json factsJson(const std::vector<DeviceFact>& facts) {
  Json all = Json::object();
  for (const DeviceFact& fact : facts) all[fact.name] = {{"value", fact.value}, {"unit", fact.unit}};
  return all;
}

std::size_t presentationsPerTrial(const Experiment& experiment) {
  return experiment.procedure ? experiment.procedure->presentations() : 1;
}

Json stimulusOf(const psychophysics::Stimulus& stimulus) {
  return {{"level", stimulus.level},
          {"track", stimulus.track},
          {"standard_place", stimulus.standard_place},
          {"catch_trial", stimulus.kind == psychophysics::TrialKind::kCatch}};
}

Json phasesOf(const Experiment& experiment, const TrialResult& result) {
  Json phases = Json::object();
  for (std::size_t p = 0; p < result.phases.size(); ++p) {
    const Trial::Stretch& stretch = result.phases[p];
    phases[experiment.phases[p].name] = {numberOrNull(stretch.begin < 0 ? NAN : stretch.begin),
                                         numberOrNull(stretch.end < 0 ? NAN : stretch.end)};
  }
  return phases;
}

}  // namespace

SubjectSession::SubjectSession(const Experiment& experiment, SessionFolder folder, SessionLog log, Journal journal)
    : experiment_(experiment),
      folder_(std::move(folder)),
      log_(std::move(log)),
      journal_(std::move(journal)),
      trials_(makeTrialSource(experiment, log_.start.subject.number, log_.start.session)) {
  if (!experiment.procedure) return;
  if (log_.start.realtime || !experiment.procedure->observer) refuse(928, experiment.file, "nobody can answer");
  respondent_ = simulatedRespondent(experiment, log_.start.subject.number);
}

SubjectSession SubjectSession::begin(const Experiment& experiment, const SessionStart& start, const std::string& data) {
  SessionFolder folder = folderOf(data, start.subject.id, start.session);
  std::error_code error;
  fs::create_directories(folder.path, error);
  if (error) refuse(925, folder.path, "the folder cannot be made: " + error.message());
  Journal journal = createJournal(folder);
  removeHalfWritten(folder.path);
  for (const auto& [name, text] : documentsOf(experiment)) writeFileAtomically(folder.file(name), *text);
  syncFolder(folder.path);
  syncFolder(fs::path(folder.path).parent_path());
  Json record = toJson(start);
  record["experiment"] = experiment.name;
  record["seed"] = experiment.seed;
  if (!start.model.empty()) record["traits"] = factsJson(traitsOf(experiment, start.subject.number));
  record["presa"] = kVersion;
  record["utc"] = utcNow();
  record["machine"] = Json::object();
  for (const auto& [name, value] : machineFacts()) record["machine"][name] = value;
  for (const auto& [name, text] : documentsOf(experiment)) record["sha256"][name] = sha256OfFile(folder.file(name));
  record["inputs"] = inputSums(experiment, start.subject.number);
  journal.append(record);
  return {experiment, std::move(folder), {start, {}, false}, std::move(journal)};
}

SubjectSession SubjectSession::resume(const Experiment& experiment, const SessionFolder& folder) {
  Journal::Contents contents;
  Journal journal = Journal::reopen(folder.journal(), contents);
  for (const auto& [name, text] : documentsOf(experiment)) {
    if (contentsOf(folder.file(name)) != *text)
      refuse(926, folder.file(name), "differs from what the files say now",
             "a session is finished with the files that it began with");
  }
  SubjectSession session(experiment, folder, readLog(folder.journal(), contents.records), std::move(journal));
  checkInputs(experiment, session.log_.start.subject.number, contents.records.front().at("inputs"));
  Json record{{"event", "resume"}, {"presa", kVersion}, {"utc", utcNow()}, {"torn_bytes", contents.torn_bytes}};
  session.journal_.append(record);
  for (LoggedRun& run : session.log_.runs) {
    if (run.end.is_null()) {
      run.end = {{"event", "trial_end"}, {"outcome", toString(Outcome::kInterrupted)}, {"reason", "the process ended"}};
      if (&run == &session.log_.runs.back()) session.journal_.append(run.end);
    }
    const PlannedTrial* planned = session.trials_->next();
    if (planned == nullptr || planned->number != run.number || planned->practice != run.practice ||
        planned->attempt != run.attempt || run.begin.value("seed", "") != std::to_string(planned->seed) ||
        (planned->stimulus && run.begin.at("stimulus") != stimulusOf(*planned->stimulus)))
      refuse(927, folder.journal(),
             "run " + std::to_string(run.run) + " of trial " + std::to_string(run.number) +
                 " is not what this version of Presa would have run there",
             "finish the session with the version that began it: it is named in the first line");
    session.trials_->finish(run.outcome, run.response());
  }
  removeHalfWritten(folder.path);
  session.writeTable();
  return session;
}

LoggedRun& SubjectSession::beginRun(const PlannedTrial& trial) {
  const auto before = std::count_if(log_.runs.begin(), log_.runs.end(), [&](const LoggedRun& run) {
    return run.number == trial.number && run.practice == trial.practice;
  });
  const int run = static_cast<int>(before) + 1;
  Json record{{"event", "trial_begin"},
              {"trial", trial.number},
              {"practice", trial.practice},
              {"block", trial.block},
              {"repeat", trial.repeat},
              {"attempt", trial.attempt},
              {"run", run},
              {"condition", conditionOf(experiment_, trial)},
              {"seed", std::to_string(trial.seed)},
              {"files", SessionFolder::filesOf(trial, run, presentationsPerTrial(experiment_))},
              {"utc", utcNow()}};
  if (trial.stimulus) record["stimulus"] = stimulusOf(*trial.stimulus);
  journal_.append(record);
  log_.runs.push_back({trial.number, trial.attempt, run, trial.practice, Outcome::kInterrupted, record, {}});
  return log_.runs.back();
}

void SubjectSession::endRun(LoggedRun& run, const PlannedTrial& trial, const Conducted& result) {
  run.outcome = result.outcome;
  run.end = {{"event", "trial_end"},
             {"outcome", toString(run.outcome)},
             {"reason", result.reason},
             {"excluded", result.excluded}};
  std::vector<std::vector<double>> values;
  double simulated = 0, wall = 0;
  std::uint64_t ticks = 0;
  for (const TrialResult& shown : result.presented) {
    run.end["phases"].push_back(phasesOf(experiment_, shown));
    if (!shown.facts.empty()) run.end["model"].push_back(factsJson(shown.facts));
    values.push_back(shown.values);
    simulated += shown.simulated_seconds;
    wall += shown.wall_seconds;
    ticks += shown.ticks;
  }
  const std::vector<RowColumn> columns = rowColumns(experiment_);
  const std::vector<double> row = rowValues(experiment_, trial, values, result.response);
  for (std::size_t i = 0; i < columns.size(); ++i) run.end["values"][columns[i].name] = numberOrNull(row[i]);
  if (result.response) run.end["response"] = {{"chosen", result.response->chosen}, {"value", result.response->value}};
  run.end["simulated_s"] = simulated;
  run.end["wall_s"] = wall;
  run.end["ticks"] = ticks;
  run.end["faults"] = result.presented.back().faults;
  for (const std::string& name : run.files()) {
    if (!fs::exists(folder_.file(name))) continue;
    syncFile(folder_.file(name));
    run.end["sha256"][name] = sha256OfFile(folder_.file(name));
  }
  syncFolder(folder_.path);
  journal_.append(run.end);
  trials_->finish(run.outcome, run.response());
}

void SubjectSession::writeTable() const {
  writeFileAtomically(folder_.file("trials.csv"), trialTable(experiment_, log_));
  writeFileAtomically(folder_.file("trials.json"), tableColumnsJson(experiment_));
}

SubjectSession::End SubjectSession::run() {
  terminal::JobProgress progress(trials_->left());
  const Span expected = durationOf(experiment_);
  int in_vain = 0;  // aborts in a row
  while (const PlannedTrial* next = trials_->next()) {
    const PlannedTrial trial = *next;
    LoggedRun& run = beginRun(trial);
    std::vector<std::string> files;
    for (const std::string& name : run.files()) files.push_back(folder_.file(name));
    TrialSetting setting;
    setting.realtime = log_.start.realtime;
    setting.subject = log_.start.subject.number;
    setting.stop = terminal::JobProgress::interrupted;
    const std::size_t left = trials_->left();
    setting.on_time = [&](double time) {
      if (setting.realtime) progress.expect(static_cast<double>(left) * expected.least - time);
      progress.show();
    };
    Conducted result = conduct(experiment_, trial, files, setting, respondent_.get());
    if (const auto* method = trials_->method(); method != nullptr && result.response)
      result.response->positive = result.response->chosen == method->responseFor(true).chosen;
    endRun(run, trial, result);
    writeTable();
    if (!result.presented.back().faults.empty()) return End::kFault;
    if (result.outcome == Outcome::kInterrupted) return End::kStopped;
    in_vain = result.outcome == Outcome::kAborted ? in_vain + 1 : 0;
    // a method cannot go on without an answer
    if (experiment_.procedure && in_vain >= experiment_.retry.attempts) return End::kFault;
    if (trials_->left() == left) progress.more(1);  // it comes again
    progress.done(terminal::format("trial %d", trial.number) + (result.reason.empty() ? "" : ": " + result.reason));
  }
  progress.finish();
  if (!log_.complete) {
    Json record{{"event", "end"}, {"utc", utcNow()}};
    for (const char* name : {"trials.csv", "trials.json"}) record["sha256"][name] = sha256OfFile(folder_.file(name));
    journal_.append(record);
  }
  log_.complete = true;
  return End::kComplete;
}

}  // namespace presa::experiment
