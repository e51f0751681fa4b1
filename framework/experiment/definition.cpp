#include "framework/experiment/definition.h"

namespace presa::experiment {

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
