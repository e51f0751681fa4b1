#include "apps/experiment/analysis/psychometric_fit.h"

#include <map>

#include "framework/scene/xml/value_rule.h"

namespace presa::experiment::analysis {
namespace {

using statistics::StimulusLevel;

constexpr int kBandSteps = 12;

std::vector<StimulusLevel> levelsOf(const wanted::Psychometric& what, const Trials& trials, const Stimulus& stimulus,
                                    const std::vector<std::size_t>& rows) {
  std::map<double, StimulusLevel> levels;
  for (const std::size_t row : rows) {
    const double x = stimulus.at(trials.numbers.at(what.x)[row]);
    StimulusLevel& level = levels[x];
    level.x = x;
    ++level.trials;
    level.hits += trials.numbers.at(what.y)[row] != 0 ? 1 : 0;
  }
  std::vector<StimulusLevel> all;
  for (const auto& [x, level] : levels) all.push_back(level);
  return all;
}

Fit fitted(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus,
           const std::string& subject, const Group& group) {
  Fit fit{subject, group, levelsOf(what, context.trials, stimulus, group.rows), {}, {}};
  fit.result = statistics::fitPsychometric(fit.levels, what.model);
  if (!fit.result.fit || what.draws == 0) return fit;
  std::vector<double> proportions = bandOf(what.model);
  proportions.push_back(what.threshold);
  std::string name = "psychometric " + what.x + " " + what.y + " " + subject;
  for (const std::string& level : group.levels) name += " " + level;
  RandomStream random(context.seed(), name);
  fit.bootstrap = statistics::bootstrapPsychometric(fit.levels, what.model, *fit.result.fit, proportions, what.draws,
                                                    context.confidence(), random);
  return fit;
}

}  // namespace

std::optional<double> Stimulus::weber(const wanted::Psychometric& what,
                                      const statistics::PsychometricFunction& function,
                                      std::optional<double> standard) const {
  const bool of_difference = what.model.guess.has_value();
  const double location = function.location, jnd = function.jnd();
  const std::optional<double> threshold = function.threshold(what.threshold);
  if (column_) standard = axis_.standard;
  if (!standard || *standard == 0 || (of_difference && !threshold)) return std::nullopt;
  if (column_)
    return of_difference ? (valueAt(*threshold) - *standard) / *standard
                         : (valueAt(location + jnd) - valueAt(location - jnd)) / (2 * *standard);
  return (of_difference ? *threshold : jnd) / *standard;
}

std::vector<double> bandOf(const statistics::PsychometricModel& model) {
  const double lapse = model.lapse.value_or(model.lapse_max), low = model.guess.value_or(lapse), high = 1 - lapse;
  std::vector<double> proportions;
  for (int i = 1; i < kBandSteps; ++i) proportions.push_back(low + (high - low) * i / kBandSteps);
  return proportions;
}

std::vector<Fit> fitsOf(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus) {
  const Trials& trials = context.trials;
  std::vector<std::size_t> rows = trials.complete({what.x, what.y});
  const auto catches = trials.numbers.find("catch_trial");
  if (catches != trials.numbers.end()) std::erase_if(rows, [&](std::size_t row) { return catches->second[row] == 1; });
  std::vector<Fit> fits;
  for (const Group& group : groupsBy(context.experiment, trials, what.by, rows)) {
    if (trials.subjects.size() > 1) fits.push_back(fitted(what, context, stimulus, "all", group));
    for (std::size_t s = 0; s < trials.subjects.size(); ++s) {
      Group own{group.levels, {}};
      for (const std::size_t row : group.rows) {
        if (trials.rows[row].subject == s) own.rows.push_back(row);
      }
      if (!own.rows.empty()) fits.push_back(fitted(what, context, stimulus, trials.subjects[s], own));
    }
  }
  return fits;
}

}  // namespace presa::experiment::analysis
