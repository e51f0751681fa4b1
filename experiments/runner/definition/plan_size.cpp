#include "experiments/runner/definition/plan_size.h"

#include <cmath>
#include <cstdio>

#include "experiments/runner/definition/procedure.h"

namespace presa::experiment {
namespace {

enum Code { kTooLarge = 694 };

/// Without a fraction up to 1e15, where a double still holds whole numbers exactly.
std::string numberText(double count) {
  char text[64];
  std::snprintf(text, sizeof text, count < 1e15 ? "%.0f" : "%.3g", count);
  return text;
}

/// "3 x 60 x 60"
std::string productText(const Experiment& experiment) {
  std::string text;
  for (const Factor& factor : experiment.factors)
    text += (text.empty() ? "" : " x ") + std::to_string(factor.levels.size());
  return text;
}

}  // namespace

PlanSize planSize(const Experiment& experiment) {
  PlanSize size;
  double of_subject = 1;
  for (const Factor& factor : experiment.factors) {
    const auto levels = static_cast<double>(factor.levels.size());
    size.conditions *= levels;
    if (!factor.between) of_subject *= levels;
  }
  const double each = experiment.procedure ? static_cast<double>(maxTrials(*experiment.procedure)) : 1;
  size.trials = of_subject * experiment.design.repeats * each + experiment.design.practice;
  return size;
}

bool checkPlanSize(const Experiment& experiment, const SourceLocation& where, Diagnostics& diagnostics) {
  const PlanSize size = planSize(experiment);
  if (size.conditions > kMaxConditions) {
    diagnostics.error(kTooLarge, where,
                      "the factors make " + numberText(size.conditions) + " conditions (" + productText(experiment) +
                          "), at most " + numberText(kMaxConditions) + " are possible",
                      "let the method choose among many values (<constant_stimuli>, <vary>), or take fewer levels");
    return false;
  }
  if (size.trials <= kMaxTrialsOfSession) return true;
  diagnostics.error(kTooLarge, where,
                    "a session would have " + numberText(size.trials) + " trials, at most " +
                        numberText(kMaxTrialsOfSession) + " are possible",
                    "several sessions, each with fewer repeats, fit people better");
  return false;
}

}  // namespace presa::experiment
