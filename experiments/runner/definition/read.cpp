#include "experiments/runner/definition/read.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <sstream>

#include "experiments/runner/definition/experiment_schema.h"
#include "experiments/runner/definition/presentation.h"
#include "experiments/runner/definition/read_parts.h"
#include "framework/input/folders.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/schema.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa::experiment {
namespace {

using xml::Element;

/// The file named by an attribute, relative to the experiment file; reports a path that may not be used.
std::string beside(const Element& root, const std::string& attribute, Diagnostics& diagnostics) {
  const std::filesystem::path folder = std::filesystem::path(root.where().file).parent_path();
  const std::string path = root.attribute(attribute);
  if (path.empty()) return {};
  const std::string file = (folder / path).lexically_normal().string();
  input::checkNamed(root.where(attribute), file, diagnostics);
  return file;
}

/// The rig to use: the one given by name, the one for a simulated subject, or the file's own.
std::string rigOf(const Element& root, const std::string& rig, const std::string& simulated, Diagnostics& diagnostics) {
  if (!rig.empty()) return rig;
  if (simulated.empty()) return beside(root, "rig", diagnostics);
  if (!root.hasAttribute("simulated_rig"))
    diagnostics.error(912, root.where(), "a simulated subject is asked for, and the experiment names no rig for one",
                      "add simulated_rig=\"FILE\" to <experiment>, a rig with driver simulated_subject");
  return beside(root, "simulated_rig", diagnostics);
}

void readHead(const Element& root, const std::string& file, Experiment& experiment, Diagnostics& diagnostics) {
  experiment.file = file;
  experiment.name = root.attribute("name");
  experiment.title = root.attribute("title");
  experiment.description = root.attribute("description");
  experiment.scene = beside(root, "scene", diagnostics);
  experiment.seed = static_cast<std::uint64_t>(root.number("seed", 1));
  for (const Element& set : root.children("set"))
    experiment.sets.push_back(set.attribute("path") + "=" + set.attribute("value"));
}

/// The models that move the devices in place of a person, joined when there are several.
std::string modelOf(const Loaded& loaded) {
  std::string all;
  for (const auto& device : loaded.devices) {
    const std::string model = device->model();
    if (all.find(model) == std::string::npos) all += (all.empty() ? "" : "; ") + model;
  }
  return all;
}

/// Loads scene and rig with the file's own overrides to find the available sample names.
void readSampleNames(Experiment& experiment, Diagnostics& diagnostics) {
  RunOptions options;
  options.person = SimulatedPerson{.level = experiment.level};
  const Loaded loaded = loadWorld({experiment.scene, experiment.rig, experiment.sets}, options, diagnostics);
  if (!loaded.world || diagnostics.hasErrors()) return;
  experiment.samples = sampleNames(loaded.world->scene);
  experiment.surfaces_change = loaded.world->scene.surfacesChange();
  experiment.scene_xml = loaded.world->scene.resolved_xml;
  experiment.model = modelOf(loaded);
  experiment.rig_xml = loaded.world->rig.resolved_xml;
}

/// Loads every condition of the first subjects that differ; reports each finding once.
void checkConditions(const Experiment& experiment, Diagnostics& diagnostics) {
  const std::size_t cells = cellsOf(experiment);
  std::set<std::string> told;
  for (std::size_t subject = 1; subject <= cells; ++subject) {
    for (const Condition& condition : conditionsOf(experiment, static_cast<int>(subject))) {
      PlannedTrial trial;
      trial.condition = condition;
      if (experiment.procedure) trial.stimulus = makeMethod(*experiment.procedure, experiment.seed)->next();
      for (const Presentation& presentation : presentationsOf(experiment, trial)) {
        Diagnostics found;
        loadWorld({experiment.scene, experiment.rig, presentation.sets}, {}, found);
        for (const Diagnostic& one : found.all()) {
          if (one.severity != Diagnostic::Severity::kError || !told.insert(format(one)).second) continue;
          diagnostics.error(one.code, one.where, one.message, one.help);
        }
      }
    }
  }
}

}  // namespace

const xml::Schema& experimentSchema() {
  static const xml::Schema compiled(experimentSchemaWith(schemas::experiment, manifests()));
  return compiled;
}

std::optional<Experiment> readExperiment(const std::string& file, const std::string& rig, Diagnostics& diagnostics,
                                         const std::string& simulated, std::uint64_t seed) {
  const auto document = xml::Document::load(file, diagnostics);
  if (!document || !document->validate(experimentSchema(), diagnostics)) return std::nullopt;
  document->writeDefaults(experimentSchema());
  Element root = document->root();
  if (seed != 0) root.setAttribute("seed", std::to_string(seed));
  Experiment experiment;
  readHead(root, file, experiment, diagnostics);
  experiment.rig = rigOf(root, rig, simulated, diagnostics);
  experiment.level = simulated;
  if (diagnostics.hasErrors()) return std::nullopt;  // a path that may not be used is not opened
  readSampleNames(experiment, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;  // later findings could be consequences of these
  readFactors(root, experiment, diagnostics);
  readVaried(root, experiment, diagnostics);
  readProcedure(root, experiment, diagnostics);
  readQualityNames(experiment);
  readDesign(root, experiment, diagnostics);
  readParticipant(root, experiment);
  readPhases(root, experiment, diagnostics);
  readTexts(root, experiment, diagnostics);
  readWatch(root, experiment, diagnostics);
  readReactions(root, experiment, diagnostics);
  readMeasures(root, experiment, diagnostics);
  readObserver(root, experiment, diagnostics);
  readAnalysis(root, experiment, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  checkConditions(experiment, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  experiment.resolved_xml = document->text();
  return experiment;
}

}  // namespace presa::experiment
