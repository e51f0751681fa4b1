#include <cstdio>
#include <memory>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/options/command_line.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/driver.h"
#include "apps/studies/cost/plan.h"
#include "apps/studies/cost/report.h"
#include "apps/studies/cost/tables.h"
#include "apps/studies/cost/verdict.h"
#include "apps/studies/cost/work_plots.h"

namespace presa {
namespace {

struct Arguments {
  cost::Request request;
  int jobs = 0;
  bool resume = false, instructions = false;
  std::string apply;  ///< scene to write where the default is beaten; empty: none
};

std::string commandLine(const Arguments& a) {
  std::string line = "presa cost " + a.request.input;
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) line += std::string(" ") + option + " '" + value + "'";
  };
  if (!a.request.rig.empty()) line += " --rig " + a.request.rig;
  add("--knob", a.request.factors);
  add("--metric", a.request.metrics);
  add("--set", a.request.sets);
  if (a.request.duration > 0) line += " --for " + std::to_string(a.request.duration);
  if (a.request.seed > 0) line += " --seed " + std::to_string(a.request.seed);
  if (a.request.quick) line += " --quick";
  return line;
}

int runCost(Arguments a) {
  Diagnostics diagnostics;
  const cost::Study study = cost::planStudy(a.request, diagnostics);
  if (!a.apply.empty()) cost::checkApply(a.apply, study, diagnostics);
  if (!study.folder.empty() && !diagnostics.hasErrors()) cost::checkFolder(study.folder, diagnostics);
  std::fputs(diagnostics.text().c_str(), stderr);
  if (diagnostics.hasErrors()) return kExitBadInput;

  cost::Result result = cost::runStudy(study, {a.jobs, a.resume, a.instructions});
  result.command = commandLine(a);
  if (result.interrupted) {
    std::fprintf(stderr, "stopped; finished runs are kept in %s, continue with: %s --out %s --resume\n",
                 study.folder.c_str(), result.command.c_str(), study.folder.c_str());
    return kExitInterrupted;
  }
  writeFileAtomically(study.folder + "/cost.json", cost::toJsonText(result));
  writeFileAtomically(study.folder + "/cost.csv", cost::toCsv(result));
  writeFileAtomically(study.folder + "/report.html", cost::reportHtml(result));
  if (const std::string picture = cost::frontPicture(result); !picture.empty())
    writeFileAtomically(study.folder + "/front.svg", picture);
  const cost::Verdict verdict = cost::verdictOf(result);
  std::printf("%s.\n", verdict.headline.c_str());
  for (const std::string& text : verdict.details) std::printf("%s\n", text.c_str());
  for (const std::string& text : cost::sentences(result)) std::printf("%s\n", text.c_str());
  if (!a.apply.empty()) std::printf("%s\n", cost::applyBetter(result, a.apply).c_str());
  std::printf("%s/report.html\n", study.folder.c_str());
  return kExitOk;
}

}  // namespace

void addCost(Command app, int& status) {
  auto a = std::make_shared<Arguments>();
  Command command =
      app.command("cost", "Show what accuracy costs in time: many settings of a scene against a fine reference");
  command.option("SCENE", a->request.input, "scene file, or a study such as experiments/accuracy_cost/cube_grasp.xml")
      .required();
  command
      .option("--knob", a->request.factors,
              "NAME=VALUE,VALUE…: what to vary; several make a grid. NAME is dynamics_rate, law, …\n"
              "or a path as after --set (default: a sweep of what the scene uses)")
      .oneValueEach();
  command.option("--metric", a->request.metrics, "error to show (default: all that the scene has)").oneValueEach();
  command.option("--out", a->request.out,
                 "folder for report.html, front.svg, cost.csv and cost.json (default: cost_NAME)");
  command.option("--apply", a->apply,
                 "where a setting beats the default in all that the study judges: write the scene with its values to "
                 "FILE,\n"
                 "comments and layout kept; elsewhere say so and write nothing (exit status 0)");
  command.option("--jobs", a->jobs, "watched runs at a time (default: one per processor); timed runs go alone")
      .positive();
  command.flag("--resume", a->resume, "keep the runs that an interrupted study has made");
  command.flag("--instructions", a->instructions,
               "count instructions too (valgrind; about 50 times the time of a run)");
  command.flag("--quick", a->request.quick, "few settings, two repeats: below a minute for a small scene");
  command.option("--rig", a->request.rig, "rig file instead of the scene's own");
  command.option("--set", a->request.sets, "PATH=VALUE for all settings; may be repeated").oneValueEach();
  command.option("--seed", a->request.seed, "seed of every random stream").positive();
  command
      .option("--for", a->request.duration, "simulated seconds (default: to the end of the scripted motion, else 10)")
      .positive();
  command.footer(
      "Exit status: 0 done, 1 the reference could not be run, 2 bad input (nothing was run), 130 Ctrl-C (kept for "
      "--resume).\n"
      "A setting beats the default if it is no dearer (within 5 %), as accurate in every judged error, and 1.3 times\n"
      "better in one or in cost, or more accurate in all. Judged are the errors with a <front> in the study.\n"
      "Example:  presa cost config/scenes/cube.xml --knob dynamics_rate=100,200,500 --knob coupling=soft,explicit");
  command.action([a, &status] { status = runCost(*a); });
}

}  // namespace presa
