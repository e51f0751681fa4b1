#include <algorithm>
#include <array>

#include "experiments/runner/definition/plugin_method.h"
#include "experiments/runner/definition/read_parts.h"
#include "framework/scene/manifest.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment {
namespace {

using namespace psychophysics;
using xml::Element;

enum Code { kNoMethod = 908, kImpossibleMethod = 909 };

std::size_t countOf(const Element& element, const std::string& name, double fallback) {
  return static_cast<std::size_t>(element.number(name, fallback));
}

std::vector<double> spanOf(const Element& element, const std::string& name) {
  const std::vector<double> given = element.numbers(name);
  if (given.size() != 3 || !(given[2] >= 1 && given[2] <= 1000)) return {};
  const auto count = static_cast<std::size_t>(given[2]);
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(count == 1 ? given[0] : given[0] + (given[1] - given[0]) * double(i) / double(count - 1));
  return values;
}

std::vector<double> levelsOf(const Element& element, const StimulusAxis& stimulus) {
  std::vector<double> levels = element.numbers("values");
  for (double& level : levels) level = stimulus.axis.levelAt(level);
  return levels;
}

InterleavedPlan staircasesOf(const Element& element) {
  StaircaseRule rule;
  rule.start = element.number("start", 0);
  rule.steps_up = element.numbers("steps");
  rule.change_after = countOf(element, "change_after", 4);
  rule.down = countOf(element, "down", 3);
  rule.down_up_ratio = element.number("ratio", 0.7393);
  rule.one_down_first = element.boolean("one_down_first", false);
  rule.min = element.number("min", 0);
  rule.max = element.number("max", rule.max);
  rule.stop_reversals = countOf(element, "stop_reversals", 0);
  rule.stop_trials = countOf(element, "stop_trials", 0);
  const std::size_t copies = countOf(element, "copies", 1);
  InterleavedPlan plan;
  plan.tracks = element.attribute("sides", "above") == "both" ? onBothSides(rule, copies)
                                                              : std::vector<StaircaseRule>(copies, rule);
  plan.catch_rate = element.number("catch_rate", 0);
  plan.catch_level = element.number("catch_level", 0);
  return plan;
}

QuestPlusPlan questOf(const Element& element, const StimulusAxis& stimulus) {
  QuestPlusPlan plan;
  plan.levels = levelsOf(element, stimulus);
  plan.grid.threshold.values = spanOf(element, "threshold");
  plan.grid.spread.values = spanOf(element, "spread");
  plan.grid.lapse.values = element.numbers("lapse");
  if (plan.grid.lapse.values.empty()) plan.grid.lapse.values = {0.02};
  plan.grid.guess.reset();
  if (element.hasAttribute("guess")) plan.grid.guess = element.number("guess", 0.5);
  plan.stop_trials = countOf(element, "stop_trials", 0);
  plan.stop_sd = element.number("stop_sd", 0);
  return plan;
}

AdjustmentPlan adjustmentOf(const Element& element) {
  AdjustmentPlan plan;
  plan.nearest = element.number("nearest", 0);
  plan.farthest = element.number("farthest", 0);
  plan.trials = countOf(element, "trials", 0);
  plan.coarse = element.number("coarse", 0);
  plan.fine = element.number("fine", 0);
  plan.confirmations = countOf(element, "confirmations", 1);
  return plan;
}

constexpr std::array kMethods{"staircase", "constant_stimuli", "quest_plus", "adjustment"};

/// The plug-in that brings this element of a procedure, or null.
const Manifest* pluginOf(const std::string& element) {
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind != PluginKind::kMethod) continue;
    if (std::ranges::find(manifest.elements, element, &Manifest::Element::name) != manifest.elements.end())
      return &manifest;
  }
  return nullptr;
}

PluginElement pluginElementOf(const Element& method, const Manifest& manifest) {
  PluginElement element{manifest.name, method.name(), kNoBody, {}, method.where(), manifest.kind, -1};
  for (const std::string& name : method.attributeNames()) element.attributes[name] = method.attribute(name);
  return element;
}

/// Makes the method once, so that a mistake that only its library knows is found before any trial.
void checkPluginMethod(const PluginElement& element, const Procedure& procedure, Diagnostics& diagnostics) {
  try {
    makePluginMethod(element, procedure.stimulus.axis, RandomStream(1, "method"));
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.diagnostics().all())
      diagnostics.error(one.code, one.where, one.message, one.help);
  }
}

/// Reads the method; reports when there is none or more than one.
void readMethod(const Element& element, Procedure& procedure, Diagnostics& diagnostics) {
  std::vector<Element> found;
  for (const char* name : kMethods) {
    for (const Element& method : element.children(name)) found.push_back(method);
  }
  for (const Element& child : element.children()) {
    if (pluginOf(child.name()) != nullptr) found.push_back(child);
  }
  if (found.size() != 1) {
    diagnostics.error(kNoMethod, (found.empty() ? element : found.back()).where(),
                      "<procedure> needs one method, found " + std::to_string(found.size()),
                      "staircase, constant_stimuli, quest_plus, adjustment, or one of a plug-in (presa plugins)");
    return;
  }
  const Element& method = found.front();
  if (method.name() == "staircase") procedure.plan = staircasesOf(method);
  if (method.name() == "constant_stimuli")
    procedure.plan = ConstantStimuliPlan{levelsOf(method, procedure.stimulus), countOf(method, "per_level", 0),
                                         countOf(method, "per_block", 1)};
  if (method.name() == "quest_plus") procedure.plan = questOf(method, procedure.stimulus);
  if (method.name() == "adjustment") procedure.plan = adjustmentOf(method);
  if (const Manifest* manifest = pluginOf(method.name())) {
    procedure.plan = pluginElementOf(method, *manifest);
    checkPluginMethod(std::get<PluginElement>(procedure.plan), procedure, diagnostics);
  }
  for (const std::string& mistake : mistakes(procedure)) diagnostics.error(kImpossibleMethod, method.where(), mistake);
}

void readStimulus(const Element& element, Procedure& procedure, Diagnostics& diagnostics) {
  StimulusAxis& stimulus = procedure.stimulus;
  stimulus.column = {element.attribute("name"), element.attribute("unit"), xml::splitWords(element.attribute("path"))};
  stimulus.second_paths = xml::splitWords(element.attribute("second_path"));
  const std::string axis = element.attribute("axis", "linear");
  stimulus.axis = {axis == "ln_ratio"  ? psychophysics::Unit::kLnRatio
                   : axis == "decibel" ? psychophysics::Unit::kDecibel
                                       : psychophysics::Unit::kLinear,
                   element.number("standard", 0)};
  const bool two_places = procedure.task == Task::kTwoAlternatives;
  const auto checkPlaces = [&](const Element& where, std::size_t second) {
    if ((second > 0) == two_places) return;
    diagnostics.error(kImpossibleMethod, where.where("second_path"),
                      two_places ? "2afc needs the path of the second place too" : "only 2afc has a second place");
  };
  checkPlaces(element, stimulus.second_paths.size());
  for (const Element& with : element.children("with")) {
    auto value = Expression::compile(with.attribute("value"), SymbolTable({stimulus.column.name}), with.where("value"),
                                     diagnostics);
    checkPlaces(with, xml::splitWords(with.attribute("second_path")).size());
    if (value)
      stimulus.coupled.push_back(
          {xml::splitWords(with.attribute("path")), xml::splitWords(with.attribute("second_path")), std::move(*value)});
  }
}

Task taskOf(const std::string& name) {
  return name == "yes_no"   ? Task::kYesNo
         : name == "2afc"   ? Task::kTwoAlternatives
         : name == "adjust" ? Task::kAdjust
                            : Task::kTwoIntervals;
}

}  // namespace

void readVaried(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  for (const Element& element : root.children("vary")) {
    Vary vary{{element.attribute("name"), element.attribute("unit"), xml::splitWords(element.attribute("path"))},
              element.number("least", 0),
              element.number("most", 0)};
    if (!(vary.max > vary.min)) diagnostics.error(kImpossibleMethod, element.where("most"), "most must be above least");
    claimName(element, experiment, diagnostics);
    experiment.varied.push_back(std::move(vary));
  }
}

void readProcedure(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  for (const Element& element : root.children("procedure")) {
    Procedure procedure;
    procedure.task = taskOf(element.attribute("task"));
    procedure.coding = element.attribute("coding", "correct") == "greater" ? Coding::kGreater : Coding::kCorrect;
    procedure.asks_for_less = element.attribute("asks_for", "more") == "less";
    procedure.balance_over = countOf(element, "balance_over", 8);
    procedure.gap = element.number("gap", 0.5);
    procedure.rounds = countOf(element, "rounds", 20);
    for (const Element& stimulus : element.children("stimulus")) {
      readStimulus(stimulus, procedure, diagnostics);
      claimName(stimulus, experiment, diagnostics);
    }
    readMethod(element, procedure, diagnostics);
    experiment.procedure = std::move(procedure);
  }
}

void readObserver(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  for (const Element& procedure : root.children("procedure")) {
    for (const Element& element : procedure.children("simulated_observer")) {
      SimulatedObserver observer{xml::splitWords(element.attribute("percept")), element.number("weber", 0.1),
                                 element.number("spread", 0), element.number("lapse", 0),
                                 element.number("criterion", 0)};
      const std::size_t wanted = experiment.procedure->task == Task::kTwoAlternatives ? 2 : 1;
      if (observer.percept.size() != wanted)
        diagnostics.error(kImpossibleMethod, element.where("percept"),
                          "found " + std::to_string(observer.percept.size()) + " measures, this task needs " +
                              (wanted == 2 ? "two, one for each place" : "one"));
      if (experiment.procedure->task == Task::kYesNo && !(observer.criterion > 0))
        diagnostics.error(kImpossibleMethod, element.where("criterion"), "yes_no needs a criterion above 0");
      for (const std::string& name : observer.percept) {
        if (!experiment.names.find(name))
          diagnostics.error(kImpossibleMethod, element.where("percept"),
                            "there is no measure " + quote(name) + didYouMean(name, experiment.names.all()));
      }
      experiment.procedure->observer = std::move(observer);
    }
  }
}

}  // namespace presa::experiment
