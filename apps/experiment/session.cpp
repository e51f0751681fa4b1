#include "apps/experiment/session.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "apps/common/machine.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/experiment/inputs.h"
#include "apps/experiment/operator/operator_console.h"
#include "apps/experiment/session_records.h"
#include "apps/experiment/trial_table.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/checksum.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// Makes absolute paths in a document relative to `folder`: a dataset holds no paths of a machine.
std::string withoutRoot(std::string xml, const fs::path& folder) {
  const std::string mark = "=\"/";
  for (std::size_t at = xml.find(mark); at != std::string::npos; at = xml.find(mark, at + 1)) {
    const std::size_t begin = at + 2, end = xml.find('"', begin);
    if (end == std::string::npos) break;
    xml.replace(begin, end - begin, fs::path(xml.substr(begin, end - begin)).lexically_relative(folder).string());
  }
  return xml;
}

fs::path absolute(const std::string& path) { return fs::absolute(path).lexically_normal(); }

/// Names and texts of the session's copies of experiment, scene and rig.
std::vector<std::pair<const char*, std::string>> documentsOf(const Experiment& experiment) {
  const fs::path folder = absolute(experiment.file).parent_path();
  return {{"experiment.xml", withoutRoot(experiment.resolved_xml, folder)},
          {"scene.xml", withoutRoot(experiment.scene_xml, folder)},
          {"rig.xml", withoutRoot(experiment.rig_xml, folder)}};
}

/// Creates the log. An empty log, left by a process that died before its first record, is reused.
Journal createJournal(const SessionFolder& folder) {
  if (!fs::exists(folder.journal())) return Journal::create(folder.journal());
  Journal::Contents contents;
  Journal journal = Journal::reopen(folder.journal(), contents);
  if (!contents.records.empty()) return Journal::create(folder.journal());  // throws E920: the log exists
  return journal;
}

/// Forces a file or folder to disk: the log's statement about a file must hold after a power cut.
void syncFile(const std::string& path, int flags = 0) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  const int error = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot write " + path);
}
void syncFolder(const fs::path& folder) { syncFile(folder.string(), O_DIRECTORY); }

}  // namespace

SubjectSession::SubjectSession(const Experiment& experiment, SessionFolder folder, SessionLog log, Journal journal)
    : experiment_(experiment),
      folder_(std::move(folder)),
      log_(std::move(log)),
      journal_(std::move(journal)),
      trials_(makeTrialSource(experiment, log_.start.subject.number, log_.start.session)) {}

SubjectSession SubjectSession::begin(const Experiment& experiment, SessionStart start, const std::string& data) {
  SessionFolder folder = folderOf(data, start.subject.id, start.session);
  for (std::string* file : {&start.experiment_file, &start.rig_file}) {
    if (!file->empty()) *file = absolute(*file).lexically_relative(absolute(folder.path)).string();
  }
  std::error_code error;
  fs::create_directories(folder.path, error);
  if (error) refuse(925, folder.path, "the folder cannot be made: " + error.message());
  Journal journal = createJournal(folder);
  removeHalfWritten(folder.path);
  for (const auto& [name, text] : documentsOf(experiment)) writeFileAtomically(folder.file(name), text);
  syncFolder(folder.path);
  syncFolder(fs::path(folder.path).parent_path());
  Json record = toJson(start);
  record["experiment"] = experiment.name;
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
    if (contentsOf(folder.file(name)) != text)
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
        (planned->stimulus && run.begin.at("stimulus") != stimulusJson(*planned->stimulus)))
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
  const Json record = trialBegin(experiment_, trial, run, log_.start.recording);
  journal_.append(record);
  log_.runs.push_back({trial.number, trial.attempt, run, trial.practice, Outcome::kInterrupted, record, {}});
  return log_.runs.back();
}

void SubjectSession::endRun(LoggedRun& run, const PlannedTrial& trial, const Conducted& result) {
  run.outcome = result.outcome;
  run.end = trialEnd(experiment_, trial, result);
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

std::unique_ptr<Respondent> SubjectSession::respondentFor(OperatorConsole& console) const {
  if (!experiment_.procedure) return nullptr;
  if (!log_.start.model.empty() && experiment_.procedure->observer)
    return simulatedRespondent(experiment_, log_.start.subject.number);
  if (console.person().silent())
    refuse(928, experiment_.file, "its trials ask a question, and there is nobody to answer it",
           log_.start.model.empty() ? "--operator terminal" : "add a <simulated_observer> to its <procedure>");
  return keyboardRespondent(experiment_, console.person(), console.desk(), console.language());
}

Conducted SubjectSession::conductOne(const PlannedTrial& trial, const LoggedRun& run, OperatorConsole& console,
                                     Respondent* respondent) const {
  std::vector<std::string> files;
  for (const std::string& name : run.files()) files.push_back(folder_.file(name));
  TrialSetting setting;
  setting.realtime = log_.start.realtime;
  setting.subject = log_.start.subject.number;
  setting.live = console.live();
  setting.window = log_.start.window;
  setting.language = console.language();
  setting.stop = [&] { return console.ending() != Operator::Request::kNone; };
  setting.on_time = [&](double time) { console.look(time); };
  Conducted result = conduct(experiment_, trial, files, setting, respondent);
  if (const auto* method = trials_->method(); method != nullptr && result.response)
    result.response->positive = result.response->chosen == method->responseFor(true).chosen;
  if (result.outcome == Outcome::kInterrupted && console.ending() == Operator::Request::kSkip) {
    result.outcome = Outcome::kSkipped;
    result.reason = "skipped by the operator";
  }
  if (result.outcome == Outcome::kInterrupted && console.ending() == Operator::Request::kRepeat)
    result.reason = "the operator repeats it";
  return result;
}

SubjectSession::End SubjectSession::run(Operator& person, const std::string& language) {
  ParticipantDesk desk(experiment_, language, log_.start.window);
  OperatorConsole console(experiment_, log_.start, language, person, desk, [&](const std::string& text) {
    journal_.append({{"event", "note"}, {"text", text}, {"utc", utcNow()}});
  });
  const std::unique_ptr<Respondent> respondent = respondentFor(console);
  if (trials_->next() != nullptr && !console.welcome()) return End::kStopped;
  int in_vain = 0;  // consecutive aborts
  while (const PlannedTrial* next = trials_->next()) {
    const PlannedTrial trial = *next;
    console.begin(trial, *trials_);
    LoggedRun& run = beginRun(trial);
    const Conducted result = conductOne(trial, run, console, respondent.get());
    endRun(run, trial, result);
    writeTable();
    if (!result.presented.back().faults.empty()) return End::kFault;
    const bool again = result.outcome == Outcome::kInterrupted && console.ending() == Operator::Request::kRepeat;
    if (result.outcome == Outcome::kInterrupted && !again) return End::kStopped;
    in_vain = result.outcome == Outcome::kAborted ? in_vain + 1 : 0;
    // a psychophysical method needs an answer to continue
    if (experiment_.procedure && in_vain >= experiment_.retry.attempts) return End::kFault;
    const std::string what =
        terminal::format("trial %d", trial.number) + (result.reason.empty() ? "" : ": " + result.reason);
    if (!console.between(what, *trials_)) return End::kStopped;
  }
  if (!log_.complete) {
    Json record{{"event", "end"}, {"utc", utcNow()}};
    for (const char* name : {"trials.csv", "trials.json"}) record["sha256"][name] = sha256OfFile(folder_.file(name));
    journal_.append(record);
  }
  log_.complete = true;
  return End::kComplete;
}

}  // namespace presa::experiment
