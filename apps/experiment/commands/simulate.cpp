#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/simulate/power.h"
#include "apps/experiment/simulate/studies.h"
#include "apps/experiment/simulate/variations.h"
#include "experiments/runner/definition/read.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

using namespace experiment;
namespace fs = std::filesystem;

/// Parses "2/8": shard 2 of 8.
void takeShard(const std::string& text, StudiesPlan& plan) {
  if (text.empty()) return;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d/%d%c", &plan.shard, &plan.shards, &rest) != 2 || plan.shard < 1 ||
      plan.shard > plan.shards)
    refuse(950, "--shard", "must be i/N with 1 <= i <= N, found " + quote(text),
           "--shard 1/4 on the first of four machines");
}

/// Writes the plan into the folder: the same command continues it, a different one is refused.
void claimFolder(const StudiesPlan& plan, const Experiment& experiment) {
  const std::string file = plan.out + "/plan.txt";
  const std::string text = "experiment " + experiment.name + "\nseed " + std::to_string(experiment.seed) + "\nlevel " +
                           plan.level + "\n" + experiment.resolved_xml + experiment.scene_xml + experiment.rig_xml;
  std::error_code error;
  fs::create_directories(plan.out, error);
  if (error) refuse(951, plan.out, "the folder cannot be made: " + error.message());
  if (!fs::exists(file)) return writeFileAtomically(file, text);
  if (contentsOf(file) != text)
    refuse(951, plan.out, "holds studies of another experiment, level or seed", "give another --out");
}

/// Runs the studies; an exit status when they are not all complete.
std::optional<int> complete(const StudiesPlan& plan, const Experiment& experiment) {
  claimFolder(plan, experiment);
  const StudiesOutcome outcome = runStudies(plan, sessionsOf(plan, experiment.seed));
  for (const std::string& failure : outcome.failed) std::fprintf(stderr, "presa: error: %s\n", failure.c_str());
  if (outcome.interrupted) {
    std::fprintf(stderr, "stopped; %zu sessions are complete, the same command continues\n",
                 outcome.complete + outcome.found);
    return kExitInterrupted;
  }
  std::printf("%zu sessions complete, %zu of them before, %zu failed\n%s\n", outcome.complete + outcome.found,
              outcome.found, outcome.failed.size(), experiment.model.c_str());
  if (!outcome.failed.empty()) return kExitFault;
  return std::nullopt;
}

/// Refuses what cannot be simulated.
std::optional<Experiment> readSimulated(const StudiesPlan& plan) {
  Diagnostics diagnostics;
  auto experiment = readExperiment(plan.experiment_file, plan.rig_file, diagnostics, plan.level);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (experiment && experiment->model.empty())
    refuse(952, plan.experiment_file, "its rig waits for a person",
           "--simulated L0, L1 or L2, or a --rig with simulated devices");
  return experiment;
}

/// Writes the rig of each variation and reads it, so that a mistake is found before anything is simulated.
std::vector<Experiment> readVariations(const std::vector<Variation>& variations, const std::string& rig_xml) {
  std::vector<Experiment> experiments;
  for (const Variation& variation : variations) {
    std::error_code error;
    fs::create_directories(variation.plan.out, error);
    if (error) refuse(951, variation.plan.out, "the folder cannot be made: " + error.message());
    writeFileAtomically(variation.plan.rig_file, rigWith(rig_xml, variation));
    auto experiment = readSimulated(variation.plan);
    if (!experiment) return {};
    claimFolder(variation.plan, *experiment);
    experiments.push_back(std::move(*experiment));
  }
  return experiments;
}

/// Simulates all variations; those with a failed session are not compared.
int simulateVariations(const StudiesPlan& plan, const Experiment& given, const std::vector<std::string>& settings) {
  const std::vector<Variation> variations = variationsOf(plan, settings);
  const std::vector<Experiment> experiments = readVariations(variations, given.rig_xml);
  if (experiments.empty()) return kExitBadInput;
  std::vector<Variation> whole;
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::printf("%s\n", variations[v].name().c_str());
    const auto status = complete(variations[v].plan, experiments[v]);
    if (status == kExitInterrupted) return *status;
    if (!status) whole.push_back(variations[v]);
  }
  if (plan.shards > 1) return whole.size() == variations.size() ? kExitOk : kExitFault;
  if (whole.empty() || !whole.front().key.empty()) return kExitFault;  // nothing to compare with
  const int status = reportVariations(plan.out, whole, given);
  return status == kExitOk && whole.size() < variations.size() ? kExitFault : status;
}

int simulate(StudiesPlan plan, const std::string& shard, const std::vector<std::string>& varied) {
  takeShard(shard, plan);
  plan.experiment_file = fs::absolute(plan.experiment_file).string();
  if (!plan.rig_file.empty()) plan.rig_file = fs::absolute(plan.rig_file).string();
  const auto experiment = readSimulated(plan);
  if (!experiment) return kExitBadInput;
  if (!varied.empty()) return simulateVariations(plan, *experiment, varied);
  if (const auto status = complete(plan, *experiment)) return *status;
  return plan.shards > 1 ? kExitOk : reportPower(plan, *experiment);
}

}  // namespace

void addSimulate(Command app, int& status) {
  auto plan = std::make_shared<StudiesPlan>();
  auto shard = std::make_shared<std::string>();
  auto varied = std::make_shared<std::vector<std::string>>();
  Command command = app.command(
      "simulate", "Many studies with simulated subjects: results and power to expect before any person comes");
  command.option("EXPERIMENT", plan->experiment_file, "experiment file").required().existingFile();
  command.option("--subjects", plan->subjects, "in each study").withinCount(1, 999).showDefault();
  command.option("--seeds", plan->studies, "studies; the first has the experiment's own seed, the next those after it")
      .withinCount(1, 999)
      .showDefault();
  command.option("--power", plan->power, "wanted power: the page says which tests reach it, and with how many subjects")
      .within(0.05, 1)
      .showDefault();
  Option level = command.option("--simulated", plan->level, "level of the simulated subjects: L0, L1 or L2")
                     .oneOf({"L0", "L1", "L2"});
  command.option("--rig", plan->rig_file, "rig with simulated devices instead").existingFile();
  command
      .option("--vary", *varied,
              "KEY=VALUE: simulate the studies again with this setting of every device of the rig, and compare "
              "(repeatable)")
      .oneValueEach()
      .excludes(level);
  command.option("--jobs", plan->jobs, "sessions at once (default: one per processor)").positive();
  command.option("--shard", *shard,
                 "i/N: only every N-th session from the i-th, to share the work between machines; afterwards put all "
                 "into one folder and run once more without --shard");
  command.flag("--recordings", plan->recordings, "keep every haptic tick too");
  command.option("--out", plan->out, "folder; the same command continues a stopped study").required();
  command.footer(
      "Exit status: 0 complete, 1 a session failed, 2 bad input, 130 Ctrl-C (the same command goes on).\n"
      "Example:  presa experiment simulate experiments/grip_slip/experiment.xml --simulated L1 --subjects 3 --seeds 20 "
      "--out power\n"
      "          presa experiment simulate experiments/grip_slip/experiment.xml --rig "
      "experiments/grip_slip/rig_percro.xml "
      "--vary without=encoders --vary without=friction --out hardware");
  command.action([plan, shard, varied, &status] { status = simulate(*plan, *shard, *varied); });
}

}  // namespace presa
