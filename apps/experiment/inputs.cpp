#include "apps/experiment/inputs.h"

#include <filesystem>
#include <set>
#include <system_error>

#include "experiments/runner/definition/order.h"
#include "framework/record/checksum/checksum.h"
#include "framework/scene/load.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMissing = "none";

std::vector<Override> overridesOf(const std::vector<std::string>& sets) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) {
    const std::size_t equals = set.find('=');
    overrides.push_back({set.substr(0, equals), set.substr(equals + 1)});
  }
  return overrides;
}

/// Absolute paths without duplicates. The experiment has been read before, so its files are valid.
std::set<std::string> filesOf(const Experiment& experiment, int subject_number) {
  Diagnostics ignored;
  std::set<std::string> files;
  std::string rig = experiment.rig;
  for (const Condition& condition : conditionsOf(experiment, subject_number)) {
    const Scene scene = loadScene(experiment.scene, overridesOf(experiment.setsOf(condition)), ignored);
    for (const std::string& file : filesNamedBy(scene)) files.insert(file);
    if (rig.empty()) rig = scene.default_rig;
  }
  if (rig.empty()) return files;
  for (const std::string& file : filesNamedBy(loadRig(rig, ignored))) files.insert(file);
  return files;
}

/// Path relative to the experiment's folder: a dataset holds no paths of a machine.
std::string nameOf(const std::string& file, const Experiment& experiment) {
  const fs::path folder = fs::absolute(experiment.file).lexically_normal().parent_path();
  return fs::path(file).lexically_relative(folder).string();
}

std::string sumNow(const std::string& file) { return fs::exists(file) ? sha256OfFile(file) : kMissing; }

}  // namespace

Json inputSums(const Experiment& experiment, int subject_number) {
  Json sums = Json::object();
  for (const std::string& file : filesOf(experiment, subject_number))
    sums[nameOf(file, experiment)] = sha256OfFile(file);
  return sums;
}

void checkInputs(const Experiment& experiment, int subject_number, const Json& sums) {
  Diagnostics diagnostics;
  const char* const help = "a session is finished with the files that it began with";
  for (const std::string& file : filesOf(experiment, subject_number)) {
    if (sums.value(nameOf(file, experiment), "") != sumNow(file))
      diagnostics.error(936, {file, 0, 0}, "is not the file that the session began with", help);
  }
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
}

}  // namespace presa::experiment
