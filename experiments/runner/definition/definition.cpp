#include "experiments/runner/definition/definition.h"

#include <algorithm>

namespace presa::experiment {

std::string headingOf(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + " [" + unit + "]";
}

std::vector<Column> Experiment::columns() const {
  std::vector<Column> all;
  for (const Factor& factor : factors) all.insert(all.end(), factor.columns.begin(), factor.columns.end());
  for (const Vary& vary : varied) all.push_back(vary.column);
  if (procedure) all.push_back(procedure->stimulus.column);
  return all;
}

std::vector<bool> Experiment::askedSamples() const {
  std::vector<bool> asked(samples.size(), false);
  const auto mark = [&](const std::optional<Expression>& expression) {
    if (expression) expression->markSlots(asked);
  };
  for (const Phase& phase : phases) {
    mark(phase.until);
    mark(phase.abort);
    mark(phase.event_when);
  }
  if (watch) watch->value.markSlots(asked);
  for (const Measure& measure : measures) {
    for (const Aggregate& aggregate : measure.aggregates) {
      mark(aggregate.condition);
      mark(aggregate.value);
    }
    if (measure.reaction) measure.reaction->value.markSlots(asked);
  }
  return asked;
}

bool Experiment::changesFriction() const {
  return std::any_of(phases.begin(), phases.end(), [](const Phase& phase) { return phase.changes_friction; });
}

std::vector<std::string> Experiment::phaseNames() const {
  std::vector<std::string> all;
  for (const Phase& phase : phases) all.push_back(phase.name);
  return all;
}

std::string Experiment::valueOf(const std::string& column, const Condition& condition) const {
  for (std::size_t f = 0; f < factors.size(); ++f) {
    for (std::size_t c = 0; c < factors[f].columns.size(); ++c) {
      if (factors[f].columns[c].name == column) return factors[f].levels[condition[f]][c];
    }
  }
  return {};
}

std::vector<std::string> Experiment::setsOf(const Condition& condition) const {
  std::vector<std::string> all = sets;
  for (std::size_t f = 0; f < factors.size(); ++f) {
    for (std::size_t c = 0; c < factors[f].columns.size(); ++c) {
      for (const std::string& path : factors[f].columns[c].paths)
        all.push_back(path + "=" + factors[f].levels[condition[f]][c]);
    }
  }
  return all;
}

std::string Experiment::textFor(const std::string& when, const std::string& language) const {
  const Text* first = nullptr;
  for (const Text& text : texts) {
    if (text.when != when) continue;
    if (text.language == language) return text.text;
    if (first == nullptr) first = &text;
  }
  return first == nullptr ? "" : first->text;
}

}  // namespace presa::experiment
