#include <unistd.h>

#include <cstdio>
#include <memory>
#include <system_error>

#include <nlohmann/json.hpp>

#include "apps/common/findings_json.h"
#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/dataset.h"
#include "apps/experiment/dry_run.h"
#include "apps/experiment/session.h"
#include "experiments/runner/definition/read.h"

namespace presa {
namespace {

using namespace experiment;

/// The operator's display and the language of the texts.
struct OperatorChoice {
  std::string kind = "auto", language = "en";
};

struct SessionArguments {
  std::string file, rig, simulated, data, subject = "S01", format = "text";
  int number = 0, session = 1;
  bool lockstep = false, realtime = false, no_recording = false, window = false;
  std::uint64_t seed = 0;
  OperatorChoice operator_choice;
};

int dryRun(const SessionArguments& a) {
  Diagnostics diagnostics;
  const Subject subject = subjectOf(a.subject, a.number, diagnostics);
  const auto experiment = readExperiment(a.file, a.rig, diagnostics, a.simulated, a.seed);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors() || !experiment) return kExitBadInput;
  const auto trials = previewTrials(*experiment, subject.number, a.session);
  const std::string text = a.format == "json"  ? dryRunJson(*experiment, subject, a.session, trials)
                           : a.format == "csv" ? dryRunCsv(*experiment, trials)
                                               : dryRunText(*experiment, subject, a.session, trials);
  std::fputs(text.c_str(), stdout);
  return kExitOk;
}

/// "auto" selects the terminal display for a real-time session on a terminal, and one line of progress otherwise.
std::unique_ptr<Operator> operatorFor(const SubjectSession& session, const std::string& kind) {
  if (kind == "window") return windowOperator();
  const bool watched = kind == "terminal" || (kind == "auto" && session.start().realtime &&
                                              ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0);
  return watched ? terminalOperator() : silentOperator(session.trials().left());
}

/// Runs the remaining trials of a session and prints how it ended.
int runToEnd(SubjectSession& session, const OperatorChoice& choice) {
  SubjectSession::End end = SubjectSession::End::kStopped;
  try {
    const auto person = operatorFor(session, choice.kind);
    end = session.run(*person, choice.language);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s%s is complete up to there; when this is fixed: presa experiment resume %s\n",
                 error.diagnostics().text().c_str(), session.folder().journal().c_str(), session.folder().path.c_str());
    return kExitFault;
  } catch (const std::system_error& error) {
    std::fprintf(
        stderr, "presa: error: %s\n%s is complete up to there; when the disk is in order: presa experiment resume %s\n",
        error.what(), session.folder().journal().c_str(), session.folder().path.c_str());
    return kExitFault;
  }
  const TrialSource& trials = session.trials();
  if (end == SubjectSession::End::kFault) {
    std::fprintf(stderr, "presa: error: %s\nthe trial is marked and will be repeated: presa experiment resume %s\n",
                 session.fault().c_str(), session.folder().path.c_str());
    return kExitFault;
  }
  if (end == SubjectSession::End::kStopped) {
    std::fprintf(stderr, "stopped; %zu trials are left, continue with: presa experiment resume %s\n", trials.left(),
                 session.folder().path.c_str());
    return kExitInterrupted;
  }
  std::printf("%zu trials done, %zu given up, in %d runs: %s\n", trials.done(), trials.missing(), session.runsMade(),
              session.folder().file("trials.csv").c_str());
  if (!session.start().model.empty()) std::printf("%s\n", session.start().model.c_str());
  return kExitOk;
}

int run(const SessionArguments& a) {
  Diagnostics diagnostics;
  const Subject subject = subjectOf(a.subject, a.number, diagnostics);
  const auto experiment = readExperiment(a.file, a.rig, diagnostics, a.simulated, a.seed);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors() || !experiment) return kExitBadInput;
  const bool realtime = a.realtime || (!a.lockstep && (a.simulated.empty() || a.window));
  auto session = SubjectSession::begin(*experiment,
                                       {a.file, a.rig, subject, a.session, realtime, a.simulated, experiment->model,
                                        experiment->seed, !a.no_recording, a.window},
                                       a.data);
  return runToEnd(session, a.operator_choice);
}

/// Resumes the one unfinished session below a folder.
int resume(const std::string& data, const OperatorChoice& choice) {
  struct Open {
    SessionFolder folder;
    SessionStart start;
  };
  std::vector<Open> open;
  bool unreadable = false;
  for (const SessionFolder& folder : sessionsIn(data)) {
    try {
      const Journal::Contents contents = Journal::read(folder.journal());
      if (contents.records.empty()) continue;  // the session never began; `run` begins it
      const SessionLog log = readLog(folder.journal(), contents.records);
      if (!log.complete) open.push_back({folder, log.start});
    } catch (const InputError& error) {
      std::fputs(error.diagnostics().text().c_str(), stderr);  // the other sessions can still be resumed
      unreadable = true;
    }
  }
  if (open.empty() && unreadable) return kExitBadInput;  // an unreadable session may be unfinished
  if (open.empty()) {
    std::printf("%s: no session is left to finish\n", data.c_str());
    return kExitOk;
  }
  if (open.size() > 1) {
    std::fprintf(stderr, "%zu sessions are not finished, name one:\n", open.size());
    for (const Open& one : open) std::fprintf(stderr, "  presa experiment resume %s\n", one.folder.path.c_str());
    return kExitBadInput;
  }
  Diagnostics diagnostics;
  const auto& [folder, start] = open[0];
  const auto experiment = readExperiment(folder.named(start.experiment_file), folder.named(start.rig_file), diagnostics,
                                         start.simulated, start.seed);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!experiment) return kExitBadInput;
  auto session = SubjectSession::resume(*experiment, open[0].folder);
  return runToEnd(session, choice);
}

void addWho(Command command, SessionArguments& a) {
  command.option("EXPERIMENT", a.file, "experiment file").required();
  command.option("--subject", a.subject, "pseudonym that ends in the subject's number").showDefault();
  command.option("--number", a.number, "number of the subject, from 1 (default: the pseudonym's digits)").positive();
  command.option("--session", a.session, "from 1").positive().showDefault();
  command.option("--seed", a.seed, "instead of the experiment's own").positive();
  Option rig = command.option("--rig", a.rig, "rig file instead of the experiment's");
  command.option("--simulated", a.simulated, "a model instead of a person, at level L0, L1 or L2")
      .oneOf({"L0", "L1", "L2"})
      .excludes(rig);
}

void addOperator(Command command, OperatorChoice& choice) {
  command.option("--operator", choice.kind, "the operator's display: auto, terminal, window or none")
      .oneOf({"auto", "terminal", "window", "none"})
      .showDefault();
  command.option("--language", choice.language, "of the texts for the participant").showDefault();
}

void addDryRun(Command app, int& status) {
  auto a = std::make_shared<SessionArguments>();
  Command command = app.command("dry-run", "List every trial with its order and seeds; nothing is run");
  addWho(command, *a);
  command.option("--format", a->format, "text, csv or json").oneOf({"text", "csv", "json"}).showDefault();
  command.footer("Example:  presa experiment dry-run experiments/grip_slip/experiment.xml --subject S02");
  command.action([a, &status] { status = dryRun(*a); });
}

/// `presa check` asks for experiments with this. Its findings go to stderr as text, or not at all, and to stdout as
/// JSON.
int checkExperiment(const std::string& file, const std::string& rig, bool as_text) {
  Diagnostics diagnostics;
  readExperiment(file, rig, diagnostics);
  if (as_text) std::fputs(diagnostics.text().c_str(), stderr);
  std::printf("%s\n", findingsJson(file, "experiment", diagnostics).dump().c_str());
  return diagnostics.hasErrors() ? kExitBadInput : kExitOk;
}

void addCheckExperiment(Command app, int& status) {
  auto file = std::make_shared<std::string>(), rig = std::make_shared<std::string>();
  auto report = std::make_shared<std::string>("text");
  Command command =
      app.command("check", "Find everything that is wrong with an experiment (presa check does the same)");
  command.option("EXPERIMENT", *file, "experiment file").required();
  command.option("--rig", *rig, "rig file instead of the experiment's");
  command.option("--report", *report, "text: findings to stderr, too; json: only as JSON to stdout")
      .oneOf({"text", "json"})
      .showDefault();
  command.footer("Exit status: 0 good, 2 otherwise.");
  command.action([=, &status] { status = checkExperiment(*file, *rig, *report == "text"); });
}

void addRunSession(Command app, int& status) {
  auto a = std::make_shared<SessionArguments>();
  Command command = app.command("run", "Run a session; every trial is on disk before the next begins");
  addWho(command, *a);
  command.named("--subject").required();
  command.option("--data", a->data, "folder of the dataset; the session goes to DATA/sub-ID/ses-N").required();
  Option lockstep = command.flag("--lockstep", a->lockstep,
                                 "virtual time, as fast as it goes (default with --simulated, but not with --window)");
  command.flag("--realtime", a->realtime, "against the clock (default for a person)").excludes(lockstep);
  command.flag("--no-recording", a->no_recording, "keep the row of each trial, not every haptic tick");
  command.flag("--window", a->window,
               "a window for the participant: scene, fingertips, instructions, nothing that is measured "
               "(<participant sees> of the experiment says otherwise); the operator's view stays in the terminal");
  addOperator(command, a->operator_choice);
  command.footer(
      "Exit status: 0 complete, 1 disk, device or dynamics failed, 2 bad input (nothing was run), 130 Ctrl-C (after 1 "
      "and 130 go on with resume).\n"
      "Example:  presa experiment run experiments/grip_slip/experiment.xml --subject S01 --data data");
  command.action([a, &status] { status = run(*a); });
}

void addResume(Command app, int& status) {
  auto folder = std::make_shared<std::string>();
  auto choice = std::make_shared<OperatorChoice>();
  Command command = app.command("resume", "Finish a session that was stopped or killed");
  addFolder(command, *folder);
  addOperator(command, *choice);
  command.action([folder, choice, &status] { status = resume(*folder, *choice); });
}

}  // namespace

void addSessionCommands(Command app, int& status) {
  addDryRun(app, status);
  addCheckExperiment(app, status);
  addRunSession(app, status);
  addResume(app, status);
}

}  // namespace presa
