#pragma once
#include <string>
#include <vector>

#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// One trial as planned. An aborted trial is planned again with the same `number` and the next `attempt`.
struct PlannedTrial {
  int number = 0;  ///< from 1; practice trials have their own count from 1
  int block = 0;   ///< from 1; 0: practice
  bool practice = false;
  int repeat = 0;  ///< from 1: how often the subject has met this condition, this trial included
  int attempt = 1;
  Condition condition;
  std::uint64_t seed = 0;                             ///< seed of every random stream within the trial
  std::optional<psychophysics::Stimulus> stimulus{};  ///< the stimulus chosen by a method
};

/// Every condition of a subject: all combinations of the factors, with between-subject factors fixed at the subject's
/// level.
std::vector<Condition> conditionsOf(const Experiment& experiment, int subject_number);

/// Number of combinations of between-subject levels; subjects are assigned to them in turn.
std::size_t cellsOf(const Experiment& experiment);

/// All trials of a subject's session in running order; the same arguments give the same plan on every machine. Subjects
/// count from 1. The number selects the level of each between-subject factor and, together with the session, the row of
/// a Latin square.
std::vector<PlannedTrial> planTrials(const Experiment& experiment, int subject_number, int session);

/// Rows of a Latin square over n items: each item once in each row and each column. The balanced one has n rows for even n, 2n
/// for odd n, and each item directly after each other one equally often [Williams 1949].
std::vector<std::vector<std::size_t>> latinSquare(std::size_t n);
std::vector<std::vector<std::size_t>> balancedSquare(std::size_t n);

}  // namespace presa::experiment
