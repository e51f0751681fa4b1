#include "experiments/runner/definition/read_parts.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "experiments/runner/definition/plan_size.h"
#include "experiments/runner/definition/read.h"
#include "experiments/runner/definition/row.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment {
namespace {

using xml::Element;

enum Code { kDuplicateName = 903, kWrongCount = 904, kNoSuchFactor = 905, kNoSuchMoment = 906, kImpossibleOrder = 907 };

/// Reports a name that is used twice.
class OneEach {
 public:
  OneEach(std::string kind, Diagnostics& diagnostics) : kind_(std::move(kind)), diagnostics_(diagnostics) {}
  void add(const Element& element) {
    const std::string name = element.attribute("name");
    const auto [found, is_new] = first_.try_emplace(name, element.where("name"));
    if (is_new) return;
    diagnostics_.error(kDuplicateName, element.where("name"), "a second " + kind_ + " is named " + quote(name),
                       "the first is in line " + std::to_string(found->second.line));
  }

 private:
  std::string kind_;
  Diagnostics& diagnostics_;
  std::map<std::string, SourceLocation> first_;
};

std::optional<Expression> readExpression(const Element& element, const std::string& attribute, const SymbolTable& names,
                                         Diagnostics& diagnostics) {
  if (!element.hasAttribute(attribute)) return std::nullopt;
  return Expression::compile(element.attribute(attribute), names, element.where(attribute), diagnostics);
}

Factor readFactor(const Element& element, Experiment& experiment, Diagnostics& diagnostics) {
  Factor factor{element.attribute("name"), element.boolean("between", false), {}, {}};
  for (const Element& column : element.children("column")) {
    claimName(column, experiment, diagnostics);
    factor.columns.push_back(
        {column.attribute("name"), column.attribute("unit"), xml::splitWords(column.attribute("path"))});
  }
  for (const Element& level : element.children("level")) {
    factor.levels.push_back(xml::splitWords(level.attribute("values")));
    if (factor.levels.back().size() == factor.columns.size()) continue;
    diagnostics.error(kWrongCount, level.where("values"),
                      "factor " + quote(factor.name) + " has " + std::to_string(factor.columns.size()) +
                          " columns, found " + std::to_string(factor.levels.back().size()) + " values");
  }
  return factor;
}

Design::Order orderOf(const std::string& name) {
  using Order = Design::Order;
  return name == "listed"                  ? Order::kListed
         : name == "random"                ? Order::kRandom
         : name == "latin_square"          ? Order::kLatinSquare
         : name == "balanced_latin_square" ? Order::kBalancedSquare
                                           : Order::kRandomRepeats;
}

// With one condition only, or with equal conditions throughout a block, each trial repeats the one before.
void checkRepeats(const Element& element, const Experiment& experiment, Diagnostics& diagnostics) {
  if (!experiment.design.no_immediate_repeat) return;
  std::size_t within = 1;
  for (const Factor& factor : experiment.factors) {
    if (!factor.between && factor.name != experiment.design.block_by) within *= factor.levels.size();
  }
  if (within >= 3 || (within == 2 && experiment.design.repeats == 1)) return;
  diagnostics.error(
      kImpossibleOrder, element.where("no_immediate_repeat"),
      "a block holds " + std::to_string(within) + " conditions, too few to keep repeats apart in any order",
      "at least 3 are needed");
}

/// A list such as "bodies fingertips"; the schema knows its words. "black" is none of them.
Sight sightOf(const std::string& words) {
  Sight sight{.bodies = false, .fingertips = false, .instruction = false, .question = false, .answers = false};
  const std::pair<const char*, bool*> all[] = {{"bodies", &sight.bodies},           {"fingertips", &sight.fingertips},
                                               {"instruction", &sight.instruction}, {"question", &sight.question},
                                               {"answers", &sight.answers},         {"measured", &sight.measured},
                                               {"fixation", &sight.fixation}};
  std::istringstream list(words);
  for (std::string word; list >> word;) {
    for (const auto& [name, seen] : all) *seen = *seen || word == name;
  }
  return sight;
}

}  // namespace

void claimName(const Element& element, Experiment& experiment, Diagnostics& diagnostics) {
  const std::string name = element.attribute("name");
  const bool taken = experiment.names.find(name) || experiment.samples.find(name) ||
                     std::find(kQualityNames.begin(), kQualityNames.end(), name) != kQualityNames.end() ||
                     std::find(kAnswerNames.begin(), kAnswerNames.end(), name) != kAnswerNames.end();
  if (taken)
    diagnostics.error(kDuplicateName, element.where("name"),
                      quote(name) + " is already the name of a sample, of a trial variable or of a column");
  experiment.names.add(name);
}

void readFactors(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  OneEach factors("factor", diagnostics);
  for (const Element& element : root.children("factor")) {
    factors.add(element);
    experiment.factors.push_back(readFactor(element, experiment, diagnostics));
  }
}

void readQualityNames(Experiment& experiment) {
  for (const std::string& name : kQualityNames) experiment.names.add(name);
}

void readDesign(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  const auto factors = root.children("factor");
  if (!checkPlanSize(experiment, factors.empty() ? root.where() : factors.front().where(), diagnostics)) return;
  for (const Element& element : root.children("design")) {
    Design& design = experiment.design;
    design.order = orderOf(element.attribute("order"));
    design.repeats = static_cast<int>(element.number("repeats", 1));
    design.block_by = element.attribute("block_by");
    design.no_immediate_repeat = element.boolean("no_immediate_repeat", false);
    design.practice = static_cast<int>(element.number("practice", 0));
    std::vector<std::string> names;
    for (const Factor& factor : experiment.factors) names.push_back(factor.name);
    if (!design.block_by.empty() && std::find(names.begin(), names.end(), design.block_by) == names.end())
      diagnostics.error(kNoSuchFactor, element.where("block_by"),
                        "there is no factor " + quote(design.block_by) + didYouMean(design.block_by, names));
    else if (checkPlanSize(experiment, element.where(), diagnostics))
      checkRepeats(element, experiment, diagnostics);
  }
  for (const Element& element : root.children("retry")) {
    experiment.retry.attempts = static_cast<int>(element.number("attempts", 3));
    experiment.retry.place = element.attribute("place") == "next" ? Retry::Place::kNext : Retry::Place::kEndOfBlock;
  }
  for (const Element& element : root.children("rest"))
    experiment.rest = {static_cast<int>(element.number("every", 0)), element.number("seconds", 60)};
}

void readParticipant(const Element& root, Experiment& experiment) {
  for (const Element& element : root.children("participant")) experiment.sees = sightOf(element.attribute("sees"));
}

void readPhases(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  OneEach names("phase", diagnostics);
  SymbolTable seen = experiment.samples;  // guards may use the condition too
  for (const Column& column : experiment.columns()) seen.add(column.name);
  for (const Element& element : root.children("phase")) {
    names.add(element);
    Phase phase;
    phase.name = element.attribute("name");
    phase.until = readExpression(element, "until", seen, diagnostics);
    phase.abort = readExpression(element, "abort", seen, diagnostics);
    phase.hold = element.number("hold", 0);
    phase.seconds = element.number("seconds", 1);
    const std::string fallback = element.hasAttribute("until") ? "abort" : "next";
    phase.on_timeout =
        element.attribute("on_timeout", fallback) == "abort" ? Phase::OnTimeout::kAbort : Phase::OnTimeout::kNext;
    phase.abort_reason = element.attribute("reason");
    phase.sees = element.hasAttribute("sees") ? sightOf(element.attribute("sees")) : experiment.sees;
    readEvent(element, seen, experiment, phase, diagnostics);
    experiment.phases.push_back(std::move(phase));
  }
}

void readTexts(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  std::vector<std::string> moments = experiment.phaseNames();
  moments.insert(moments.end(), {"start", "rest", "question", "answers", "end"});
  for (const Element& element : root.children("text")) {
    const std::string when = element.attribute("when");
    if (std::find(moments.begin(), moments.end(), when) == moments.end())
      diagnostics.error(kNoSuchMoment, element.where("when"),
                        "there is no phase " + quote(when) + didYouMean(when, moments),
                        "start, rest, question, answers, end, or the name of a phase");
    experiment.texts.push_back({when, element.attribute("language"), element.attribute("text")});
  }
}

void readWatch(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  SymbolTable columns;
  for (const Column& column : experiment.columns()) columns.add(column.name);
  for (const Element& element : root.children("watch")) {
    auto value = readExpression(element, "value", experiment.samples, diagnostics);
    auto line = readExpression(element, "line", columns, diagnostics);
    if (value)
      experiment.watch = Watch{element.attribute("name"), element.attribute("unit"), std::move(*value), std::move(line),
                               element.number("most", 1)};
  }
}

void readMeasures(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  OneEach names("measure", diagnostics);
  const std::vector<std::string> phases = experiment.phaseNames();
  for (const Element& element : root.children("measure")) {
    names.add(element);
    Measure measure{element.attribute("name"), element.attribute("unit"), element.attribute("description"), {}, {},
                    experiment.names.size()};
    measure.value = Expression::compile(element.attribute("value"), experiment.names, element.where("value"),
                                        diagnostics, &measure.aggregates, &experiment.samples, &phases);
    if (experiment.names.find(measure.name) && !element.flawed("name"))
      diagnostics.error(kDuplicateName, element.where("name"),
                        quote(measure.name) + " is a column or a quality figure already");
    experiment.names.add(measure.name);
    experiment.measures.push_back(std::move(measure));
  }
  for (const Element& element : root.children("exclude"))
    experiment.exclusions.push_back(
        {readExpression(element, "when", experiment.names, diagnostics), element.attribute("reason")});
}

}  // namespace presa::experiment
