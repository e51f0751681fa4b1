#include "apps/studies/cost/study_arguments.h"

#include <cstdio>
#include <filesystem>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/apply.h"
#include "apps/studies/cost/report.h"
#include "apps/studies/cost/tables.h"
#include "apps/studies/cost/verdict.h"
#include "apps/studies/cost/work_plots.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::cost {

namespace fs = std::filesystem;

void addStudyOptions(Command command, const std::shared_ptr<Arguments>& a) {
  command.option("SCENE", a->request.input, "scene file, or a study such as experiments/accuracy_cost/cube_grasp.xml");
  command
      .option("--knob", a->request.factors,
              "NAME=VALUE,VALUE…: what to vary; several make a grid. NAME is dynamics_rate, law, latency, …\n"
              "or a path as after --set (default: a sweep of what the scene uses)")
      .oneValueEach();
  command.option("--metric", a->request.metrics, "error to show (default: all that the scene has)").oneValueEach();
  command.option("--out", a->request.out,
                 "folder for report.html, front.svg, cost.csv, runs.csv and cost.json (default: cost_NAME)");
  command.option("--apply", a->apply,
                 "where a setting beats the default in all that the study judges: write the scene with its values to "
                 "FILE,\n"
                 "comments and layout kept; elsewhere say so and write nothing (exit status 0)");
  command.flag("--instructions", a->instructions,
               "count instructions too (valgrind; about 50 times the time of a run)");
  command.flag("--quick", a->request.quick,
               "few settings, two repeats: some seconds; with many bodies a coarser reference");
  command.option("--rig", a->request.rig, "rig file instead of the scene's own");
  command.option("--set", a->request.sets, "PATH=VALUE for all settings; may be repeated").oneValueEach();
  command.option("--seed", a->request.seed, "seed of every random stream").positive();
  command
      .option("--for", a->request.duration, "simulated seconds (default: to the end of the scripted motion, else 10)")
      .positive();
}

std::vector<std::string> wordsOf(const Arguments& a) {
  const Request& request = a.request;
  const auto absolute = [](const std::string& file) { return fs::absolute(file).lexically_normal().string(); };
  std::vector<std::string> words{"cost", absolute(request.input)};
  const auto add = [&](const char* option, const std::string& value) { words.insert(words.end(), {option, value}); };
  if (!request.rig.empty()) add("--rig", absolute(request.rig));
  for (const std::string& factor : request.factors) add("--knob", factor);
  for (const std::string& metric : request.metrics) add("--metric", metric);
  for (const std::string& set : request.sets) add("--set", set);
  if (request.duration > 0) add("--for", xml::numberText(request.duration));
  if (request.seed > 0) add("--seed", std::to_string(request.seed));
  if (request.quick) words.emplace_back("--quick");
  if (a.instructions) words.emplace_back("--instructions");
  return words;
}

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

void requireScene(const Arguments& a, Diagnostics& diagnostics) {
  if (a.request.input.empty())
    diagnostics.error(123, {"presa cost", 0, 0}, "SCENE is missing: scene file, or a study",
                      "presa cost --help lists its options");
}

int writeResults(const Result& result, const std::string& apply) {
  const std::string& folder = result.study.folder;
  writeFileAtomically(folder + "/cost.json", toJsonText(result));
  writeFileAtomically(folder + "/cost.csv", toCsv(result));
  writeFileAtomically(folder + "/runs.csv", toRunsCsv(result));
  writeFileAtomically(folder + "/report.html", reportHtml(result));
  if (const std::string picture = frontPicture(result); !picture.empty())
    writeFileAtomically(folder + "/front.svg", picture);
  const Verdict verdict = verdictOf(result);
  std::printf("%s.\n", verdict.headline.c_str());
  for (const std::string& text : verdict.details) std::printf("%s\n", text.c_str());
  for (const std::string& text : sentences(result)) std::printf("%s\n", text.c_str());
  if (!apply.empty()) std::printf("%s\n", applyBetter(result, apply).c_str());
  std::printf("%s/report.html\n", folder.c_str());
  return kExitOk;
}

int interrupted(const std::string& folder, const std::string& command) {
  std::fprintf(stderr, "stopped; finished runs are kept in %s, continue with: %s\n", folder.c_str(), command.c_str());
  return kExitInterrupted;
}

}  // namespace presa::cost
