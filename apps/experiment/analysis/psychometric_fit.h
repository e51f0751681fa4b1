#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/psychometric.h"

/// Psychometric functions of a dataset, before they become a section.
namespace presa::experiment::analysis {

/// What the numbers of x mean.
class Stimulus {
 public:
  Stimulus(const wanted::Psychometric& what, const Experiment& experiment) {
    if (what.x != "level" || !experiment.procedure) return;
    column_ = experiment.procedure->stimulus.column;
    axis_ = experiment.procedure->stimulus.axis;
    folded_ = experiment.procedure->coding == psychophysics::Coding::kCorrect;
  }
  /// Set where a method chose the level; else x is the stimulus itself.
  const std::optional<Column>& column() const { return column_; }
  double valueAt(double level) const { return axis_.valueAt(level); }
  /// Right or wrong knows no side: levels below the standard lie as far above it.
  bool folded() const { return folded_; }
  double at(double x) const { return folded_ ? std::abs(x) : x; }
  /// What is added to the standard, as a share of it: a difference x, or half the distance between two x.
  std::optional<double> weber(const wanted::Psychometric& what, const statistics::PsychometricFunction& function,
                              std::optional<double> standard) const;

 private:
  std::optional<Column> column_;
  bool folded_ = false;
  psychophysics::Axis axis_;
};

/// Trials of one subject, or of all, in one group, with their fit.
struct Fit {
  std::string subject;  ///< "all": of all
  Group group;
  std::vector<statistics::StimulusLevel> levels;
  statistics::PsychometricResult result;
  std::optional<statistics::PsychometricBootstrap> bootstrap;  ///< thresholds at bandOf(), then the one asked for
};
/// By group: all subjects together, where there are several, then each. Catch trials count in none.
std::vector<Fit> fitsOf(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus);

/// Proportions at which a bootstrap is asked for the curve's interval: inside the asymptotes at the largest lapse.
std::vector<double> bandOf(const statistics::PsychometricModel& model);

/// Answers, curves and their intervals: a row per subject, a column per group; of many subjects all together.
std::string figureOf(const wanted::Psychometric& what, const Context& context, const std::vector<Fit>& fits);

}  // namespace presa::experiment::analysis
