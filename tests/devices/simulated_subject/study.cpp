#include "tests/devices/simulated_subject/study.h"

#include <cmath>
#include <map>

#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/means.h"

namespace presa::subject {

std::vector<Cube> studyCubes() {
  std::vector<Cube> cubes;
  for (const double mass : {0.1, 0.2, 0.4}) {
    for (const auto& [mu_s, mu_d] : {std::pair{0.4, 0.3}, {0.8, 0.6}, {1.2, 1.1}}) {
      for (const double stiffness : {500.0, 1000.0, 2000.0}) cubes.push_back({mass, mu_s, mu_d, stiffness});
    }
  }
  return cubes;
}

Population withoutNoise(Level level) {
  Population population(level);
  population.silence();
  return population;
}

std::vector<StudyTrial> runStudy(const Population& population, int seeds) {
  std::vector<StudyTrial> trials;
  const std::vector<Cube> cubes = studyCubes();
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(seeds); ++seed) {
    for (std::uint64_t subject = 0; subject < 3; ++subject) {
      const SubjectParameters parameters = population.draw(seed, subject);
      for (std::uint64_t number = 0; number < 2 * cubes.size(); ++number) {
        const Trial trial{.cube = cubes[number % cubes.size()],
                          .seed = seed,
                          .subject = subject,
                          .trial = number,
                          .resolution = drawResolution(seed, subject, number)};
        trials.push_back({trial, StandAlone(parameters, trial).run()});
      }
    }
  }
  return trials;
}

std::vector<double> mediansBy(const std::vector<StudyTrial>& trials, const std::function<double(const Cube&)>& factor,
                              const std::function<double(const StudyTrial&)>& quantity) {
  std::map<double, std::vector<double>> groups;
  for (const StudyTrial& trial : trials) {
    if (const double value = quantity(trial); std::isfinite(value)) groups[factor(trial.trial.cube)].push_back(value);
  }
  std::vector<double> medians;
  for (const auto& [level, values] : groups) medians.push_back(statistics::median(values).value());
  return medians;
}

std::vector<double> correlationsPerSeed(const std::vector<StudyTrial>& trials,
                                        const std::function<double(const Cube&)>& factor) {
  std::map<std::uint64_t, std::pair<std::vector<double>, std::vector<double>>> seeds;
  for (const StudyTrial& trial : trials) {
    auto& [levels, grips] = seeds[trial.trial.seed];
    levels.push_back(factor(trial.trial.cube));
    grips.push_back(trial.result.grip);
  }
  std::vector<double> correlations;
  for (const auto& [seed, samples] : seeds)
    correlations.push_back(statistics::spearman(samples.first, samples.second).value_or(NAN));
  return correlations;
}

}  // namespace presa::subject
