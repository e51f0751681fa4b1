#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "devices/simulated_subject/model/stand_alone.h"

namespace presa::subject {

/// The 27 cubes of the grip study, mass slowest, stiffness fastest.
std::vector<Cube> studyCubes();

/// All noise off, and no allowance for it: mechanics only.
Population withoutNoise(Level level);

struct StudyTrial {
  Trial trial;
  TrialResult result;
};

/// Seeds 1 … seeds, 3 subjects, each cube twice: 162 trials per seed.
std::vector<StudyTrial> runStudy(const Population& population, int seeds);

/// Median over the trials with a finite value of the quantity, for each level of the factor in ascending order.
std::vector<double> mediansBy(const std::vector<StudyTrial>& trials, const std::function<double(const Cube&)>& factor,
                              const std::function<double(const StudyTrial&)>& quantity);

/// Spearman's correlation of the mean grip with a factor, for each seed over its 162 trials.
std::vector<double> correlationsPerSeed(const std::vector<StudyTrial>& trials,
                                        const std::function<double(const Cube&)>& factor);

}  // namespace presa::subject
