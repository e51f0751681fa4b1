#include <algorithm>

#include "experiments/runner/definition/read_parts.h"

namespace presa::experiment {
namespace {

using xml::Element;

enum Code { kNothingChanges = 916, kNoSuchPhase = 917 };

/// The phase named by an attribute; E917 when there is none.
std::optional<std::size_t> phaseOf(const Element& element, const std::string& attribute, const Experiment& experiment,
                                   Diagnostics& diagnostics) {
  const std::vector<std::string> names = experiment.phaseNames();
  const auto found = std::find(names.begin(), names.end(), element.attribute(attribute));
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  diagnostics.error(
      kNoSuchPhase, element.where(attribute),
      "there is no phase " + quote(element.attribute(attribute)) + didYouMean(element.attribute(attribute), names));
  return std::nullopt;
}

}  // namespace

void readEvent(const Element& element, const SymbolTable& seen, const Experiment& experiment, Phase& phase,
               Diagnostics& diagnostics) {
  phase.changes_friction = element.attribute("event") == "change_friction";
  if (element.hasAttribute("event_when"))
    phase.event_when =
        Expression::compile(element.attribute("event_when"), seen, element.where("event_when"), diagnostics);
  if (phase.changes_friction && !experiment.surfaces_change)
    diagnostics.error(kNothingChanges, element.where("event"),
                      "phase " + quote(phase.name) +
                          " changes the friction of surfaces, but no touchable material of " + experiment.scene +
                          " has a friction to change to",
                      "give one <friction static=\"1.2\"><changed static=\"0.4\"/></friction>");
  if (phase.event_when && !phase.changes_friction)
    diagnostics.error(kNothingChanges, element.where("event_when"),
                      "phase " + quote(phase.name) + " has a condition for an event, but no event",
                      "add event=\"change_friction\"");
}

void readReactions(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  for (const Element& element : root.children("reaction")) {
    claimName(element, experiment, diagnostics);
    auto value =
        Expression::compile(element.attribute("value"), experiment.samples, element.where("value"), diagnostics);
    const auto baseline = phaseOf(element, "baseline", experiment, diagnostics);
    const auto phase = phaseOf(element, "phase", experiment, diagnostics);
    if (!value || !baseline || !phase) continue;
    if (*baseline >= *phase)
      diagnostics.error(kNoSuchPhase, element.where("baseline"),
                        "phase " + quote(element.attribute("baseline")) + " does not come before phase " +
                            quote(element.attribute("phase")) + ": there is nothing to compare with");
    Measure measure;
    measure.name = element.attribute("name");
    measure.unit = "s";
    measure.description = element.attribute("description");
    measure.reaction = Reaction{std::move(*value),
                                *baseline,
                                *phase,
                                element.number("threshold", 0),
                                element.number("sds", 5),
                                element.number("window", 0.2)};
    experiment.measures.push_back(std::move(measure));
  }
}

}  // namespace presa::experiment
