#pragma once
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/psychometric.h"

/// Psychometric functions fitted to a dataset; psychometric.cpp makes a section of them.
namespace presa::experiment::analysis {

/// Meaning of the x axis: the stimulus itself, or the level that a psychophysical method chose.
class Stimulus {
 public:
  Stimulus(const wanted::Psychometric& what, const Experiment& experiment) {
    if (what.x != "level" || !experiment.procedure) return;
    column_ = experiment.procedure->stimulus.column;
    axis_ = experiment.procedure->stimulus.axis;
    folded_ = experiment.procedure->coding == psychophysics::Coding::kCorrect;
  }
  /// The stimulus column, set when a method chose the level; otherwise x is the stimulus itself.
  const std::optional<Column>& column() const { return column_; }
  double valueAt(double level) const { return axis_.valueAt(level); }
  /// True when answers are right or wrong, without a side: levels below the standard are mirrored to above it.
  bool folded() const { return folded_; }
  double at(double x) const { return folded_ ? std::abs(x) : x; }
  /// Weber fraction: the increment divided by the standard. The increment is a difference x, or half the distance
  /// between two x.
  std::optional<double> weber(const wanted::Psychometric& what, const statistics::PsychometricFunction& function,
                              std::optional<double> standard) const;

 private:
  std::optional<Column> column_;
  bool folded_ = false;
  psychophysics::Axis axis_;
};

/// Trials of one subject, or of all, in one group, with their fit.
struct Fit {
  std::string subject;  ///< "all": all subjects together
  Group group;
  std::vector<statistics::StimulusLevel> levels;
  statistics::PsychometricResult result;
  std::optional<statistics::PsychometricBootstrap> bootstrap;  ///< thresholds at bandOf(), then the requested one
};
/// Fits of each group: all subjects together, if there are several, then each subject. Catch trials are left out.
std::vector<Fit> fitsOf(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus);

/// Proportions at which the bootstrap computes the curve's interval: between the asymptotes at the largest lapse rate.
std::vector<double> bandOf(const statistics::PsychometricModel& model);

/// "Psychometric function: proportion of right answers over ln(mu_s / standard)", in the words of the figure's axes.
std::string titleOf(const wanted::Psychometric& what, const Context& context);

/// Figure of the answers, the curves and their intervals: a row per subject, a column per group. With many subjects
/// only all of them together are drawn.
std::string figureOf(const wanted::Psychometric& what, const Context& context, const std::vector<Fit>& fits);

}  // namespace presa::experiment::analysis
