#include <filesystem>
#include <memory>

#include "apps/experiment/commands/experiment_commands.h"
#include "apps/experiment/simulate/shards.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa {
namespace {

using namespace experiment;

/// The options that say what is simulated, but for --out.
void addSimulationOptions(Command command, Simulation& wanted) {
  StudiesPlan& plan = wanted.plan;
  command.option("EXPERIMENT", plan.experiment_file, "experiment file").existingFile();
  command.option("--subjects", plan.subjects, "in each study").withinCount(1, 999).showDefault();
  command.option("--seeds", plan.studies, "studies; the first has the experiment's own seed, the next those after it")
      .withinCount(1, 999)
      .showDefault();
  command.option("--power", plan.power, "wanted power: the page says which tests reach it, and with how many subjects")
      .within(0.05, 1)
      .showDefault();
  Option level = command.option("--simulated", plan.level, "level of the simulated subjects: L0, L1 or L2")
                     .oneOf({"L0", "L1", "L2"});
  command.option("--rig", plan.rig_file, "rig with simulated devices instead").existingFile();
  command
      .option("--vary", wanted.varied,
              "KEY=VALUE: simulate the studies again with this setting of every device of the rig, and compare "
              "(repeatable)")
      .oneValueEach()
      .excludes(level);
  command.flag("--recordings", plan.recordings, "keep every haptic tick too");
}

/// The parser cannot require these: `merge` and `submit` do without.
void requireAll(const Simulation& wanted) {
  Diagnostics diagnostics;
  const auto require = [&](const std::string& value, const char* what) {
    if (value.empty())
      diagnostics.error(123, {"presa experiment simulate", 0, 0}, std::string(what) + " is missing",
                        "presa experiment simulate --help lists its options");
  };
  require(wanted.plan.experiment_file, "EXPERIMENT");
  require(wanted.plan.out, "--out");
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
}

Simulation withAbsolutePaths(Simulation wanted) {
  StudiesPlan& plan = wanted.plan;
  plan.experiment_file = std::filesystem::absolute(plan.experiment_file).string();
  if (!plan.rig_file.empty()) plan.rig_file = std::filesystem::absolute(plan.rig_file).string();
  return wanted;
}

void addMerge(Command simulate, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    std::vector<std::string> folders;
    std::string out;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      simulate.command("merge", "Bring the shards of simulated studies together: the same results as on one machine");
  command.option("FOLDER", a->folders, "folders that presa experiment simulate --shard I/N wrote, one for each I")
      .required();
  command.option("--out", a->out, "folder for all sessions and the results").required();
  command.footer(
      "Exit status: 0 complete, 1 a session failed, 2 bad input, 130 Ctrl-C (the same command goes on).\n"
      "Example:  for i in 1 2; do presa experiment simulate experiments/grip_slip/experiment.xml --simulated L1 "
      "--shard $i/2 --out part_$i; done\n"
      "          presa experiment simulate merge part_1 part_2 --out power");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = mergeShards(a->folders, a->out);
  });
}

void addSubmit(Command simulate, const std::shared_ptr<bool>& chosen, int& status) {
  struct Arguments {
    Simulation wanted;
    cluster::SubmitOptions cluster;
  };
  auto a = std::make_shared<Arguments>();
  Command command =
      simulate.command("submit", "Run simulated studies on a Slurm cluster: shards as a job array, then the merge");
  addSimulationOptions(command, a->wanted);
  command.named("EXPERIMENT").required();
  command.option("--out", a->wanted.plan.out, "folder, seen by all nodes").required();
  cluster::addSubmitOptions(command, a->cluster);
  command.footer(
      "Exit status: 0 complete, 1 a shard never finished, 2 bad input or no cluster, 130 Ctrl-C (the array is "
      "cancelled; --resume goes on).\n"
      "Example:  presa experiment simulate submit experiments/grip_slip/experiment.xml --simulated L1 --seeds 200 "
      "--slurm --tasks 16 --out /scratch/power");
  command.action([a, chosen, &status] {
    *chosen = true;
    status = submitShards(withAbsolutePaths(a->wanted), a->cluster);
  });
}

}  // namespace

void addSimulate(Command app, int& status) {
  auto wanted = std::make_shared<Simulation>();
  auto other = std::make_shared<bool>(false);  // another command follows
  Command command = app.command(
      "simulate", "Many studies with simulated subjects: results and power to expect before any person comes");
  addSimulationOptions(command, *wanted);
  command.option("--jobs", wanted->plan.jobs, "sessions at once (default: one per processor)").positive();
  command
      .each(
          "--shard", [wanted](const std::string& text) { wanted->plan.shard = cluster::shardFrom(text); },
          "run one of N parts of the sessions, into a folder of its own; presa experiment simulate merge brings all N "
          "together")
      .checked(cluster::shardTrouble, "I/N");
  command.option("--out", wanted->plan.out, "folder; the same command continues a stopped study");
  command.footer(
      "Exit status: 0 complete, 1 a session failed, 2 bad input, 130 Ctrl-C (the same command goes on).\n"
      "Example:  presa experiment simulate experiments/grip_slip/experiment.xml --simulated L1 --subjects 3 --seeds 20 "
      "--out power\n"
      "          presa experiment simulate experiments/grip_slip/experiment.xml --rig "
      "experiments/grip_slip/rig_percro.xml "
      "--vary without=encoders --vary without=friction --out hardware");
  addMerge(command, other, status);
  addSubmit(command, other, status);
  command.action([wanted, command, other, &status] {
    if (*other) return;
    requireAll(*wanted);
    status =
        command.given("--shard") ? simulateShard(withAbsolutePaths(*wanted)) : simulate(withAbsolutePaths(*wanted));
  });
}

}  // namespace presa
