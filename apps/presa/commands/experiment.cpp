#include <cstdio>
#include <memory>

#include "apps/presa/commands/commands.h"
#include "apps/presa/experiment/dry_run.h"
#include "apps/presa/experiment/subject.h"
#include "framework/experiment/read.h"

namespace presa {
namespace {

struct DryRun {
  std::string file, subject = "S01", format = "text";
  int number = 0, session = 1;
};

int dryRun(const DryRun& a) {
  Diagnostics diagnostics;
  const experiment::Subject subject = experiment::subjectOf(a.subject, a.number, diagnostics);
  const auto experiment = experiment::readExperiment(a.file, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors() || !experiment) return kExitBadInput;
  const auto trials = experiment::planTrials(*experiment, subject.number, a.session);
  const std::string text = a.format == "json"  ? experiment::dryRunJson(*experiment, subject, a.session, trials)
                           : a.format == "csv" ? experiment::dryRunCsv(*experiment, trials)
                                               : experiment::dryRunText(*experiment, subject, a.session, trials);
  std::fputs(text.c_str(), stdout);
  return kExitOk;
}

void addDryRun(CLI::App& app, int& status) {
  auto a = std::make_shared<DryRun>();
  CLI::App* command = app.add_subcommand("dry-run", "List every trial with its order and seeds; nothing is run");
  command->add_option("EXPERIMENT", a->file, "experiment file")->required();
  command->add_option("--subject", a->subject, "pseudonym that ends in the subject's number")->capture_default_str();
  command->add_option("--number", a->number, "number of the subject, from 1 (default: the pseudonym's digits)")
      ->check(CLI::PositiveNumber);
  command->add_option("--session", a->session, "from 1")->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--format", a->format, "text, csv or json")
      ->check(CLI::IsMember({"text", "csv", "json"}))
      ->capture_default_str();
  command->footer("Example:  presa experiment dry-run experiments/grip_slip/experiment.xml --subject S02");
  command->callback([a, &status] { status = dryRun(*a); });
}

}  // namespace

void addExperiment(CLI::App& app, int& status) {
  CLI::App* command =
      app.add_subcommand("experiment", "Psychophysics: from an experiment's definition to its list of trials");
  command->require_subcommand(1);
  addDryRun(*command, status);
}

}  // namespace presa
