#include "apps/studies/cost/cost_command.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/common/exit_status.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/shard.h"
#include "apps/studies/cost/shard_commands.h"
#include "apps/studies/cost/study_arguments.h"
#include "framework/core/schedule/clock.h"

namespace presa {
namespace cost {
namespace {

/// One part of a study, for `presa cost merge`.
int runPart(const Arguments& a, const Study& study) {
  const Shard& shard = *a.request.shard;
  const std::string name = textOf(shard);
  std::filesystem::remove(study.folder + "/shard.json");
  if (!runShard(study, shard, {a.jobs, a.resume, a.instructions}))
    return interrupted(study.folder, commandLine(a) + " --shard " + name + " --out " + study.folder + " --resume");
  writeShard(study, a.request, a.instructions);
  std::size_t settings = 0;
  for (std::size_t i = 0; i < study.settings.size(); ++i) settings += shard.holds(i) ? 1 : 0;
  std::printf("Shard %s: %zu of %zu settings. When all shards are there: presa cost merge FOLDER…\n%s\n", name.c_str(),
              settings, study.settings.size(), study.folder.c_str());
  return kExitOk;
}

/// The study's own work is what a machine does for it beside the runs.
void tellOwnWork(const Result& result, double seconds) {
  constexpr double kWorthTelling = 10;  // [s]
  if (result.runs_seconds < kWorthTelling) return;
  const double own = seconds - result.runs_seconds;
  std::fprintf(stderr, "%zu runs took %.1f s, planning, comparing and writing %.1f s (%.1f %%).\n", result.runs,
               result.runs_seconds, own, 100 * own / result.runs_seconds);
}

int runCost(Arguments a) {
  const std::int64_t begin = monotonicNs();
  Diagnostics diagnostics;
  requireScene(a, diagnostics);
  if (a.request.shard && !a.apply.empty())
    diagnostics.error(123, {"--apply", 0, 0}, "needs the whole study, found --shard",
                      "presa cost merge … --apply FILE");
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  const Study study = planStudy(a.request, diagnostics);
  if (!a.apply.empty()) checkApply(a.apply, study, diagnostics);
  if (!study.folder.empty() && !diagnostics.hasErrors()) checkFolder(study, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;
  if (a.request.shard) return runPart(a, study);

  Result result = runStudy(study, {a.jobs, a.resume, a.instructions});
  result.command = commandLine(a);
  if (result.interrupted) return interrupted(study.folder, result.command + " --out " + study.folder + " --resume");
  const int status = writeResults(result, a.apply);
  tellOwnWork(result, 1e-9 * static_cast<double>(monotonicNs() - begin));
  return status;
}

}  // namespace
}  // namespace cost

void addCost(Command app, int& status) {
  auto a = std::make_shared<cost::Arguments>();
  auto other = std::make_shared<bool>(false);  // another command follows
  Command command =
      app.command("cost", "Show what accuracy costs in time: many settings of a scene against a fine reference");
  cost::addStudyOptions(command, a);
  command.option("--jobs", a->jobs, "watched runs at a time (default: one per processor); timed runs go alone")
      .positive();
  command
      .each(
          "--shard", [a](const std::string& text) { a->request.shard = cluster::shardFrom(text); },
          "make the runs of one of N parts of the study; presa cost merge brings all N together")
      .checked(cluster::shardTrouble, "I/N");
  command.flag("--resume", a->resume, "keep the runs that an interrupted study has made");
  command.footer(
      "Exit status: 0 done, 1 the reference could not be run or the disk is full, 2 bad input (nothing was run),\n"
      "130 Ctrl-C (kept for --resume).\n"
      "A setting beats the default if it is no dearer (within 5 %), as accurate in every judged error, and 1.3 times\n"
      "better in one or in cost, or more accurate in all. Judged are the errors with a <front> in the study.\n"
      "latency [s] delays each command on its way to the finger; haptic_jitter, collision_jitter and dynamics_jitter\n"
      "SHARE[:PERIODS] make a thread late in a share of the times that it wakes up. No such setting beats the "
      "default.\n"
      "Example:  presa cost config/scenes/cube.xml --knob dynamics_rate=100,200,500 --knob coupling=soft,explicit");
  cost::addMerge(command, other, status);
  cost::addSubmit(command, other, status);
  command.action([a, other, &status] {
    if (!*other) status = cost::runCost(*a);
  });
}

}  // namespace presa
