#pragma once
#include <string>
#include <vector>

#include "experiments/runner/definition/definition.h"

namespace presa::experiment {

/// One trial as planned. What was aborted is planned again under the same `number` with the next `attempt`.
struct PlannedTrial {
  int number = 0;  ///< from 1; practice trials count from 1 by themselves
  int block = 0;   ///< from 1; 0: practice
  bool practice = false;
  int repeat = 0;  ///< from 1: how often the subject meets this condition with this trial
  int attempt = 1;
  Condition condition;
  std::uint64_t seed = 0;                             ///< of every random stream within the trial
  std::optional<psychophysics::Stimulus> stimulus{};  ///< what a method asks for
};

/// Every condition of a subject: all combinations of the factors, between-subject ones at the subject's level.
std::vector<Condition> conditionsOf(const Experiment& experiment, int subject_number);

/// How many combinations of between-subject levels there are; subjects fill them in turn.
std::size_t cellsOf(const Experiment& experiment);

/// All trials of a subject's session in the order in which they are to be run; the same for the same arguments on every
/// machine. Subjects are counted from 1: the number picks the level of a between-subject factor and, within
/// it, with the session, the row of a square.
std::vector<PlannedTrial> planTrials(const Experiment& experiment, int subject_number, int session);

/// Rows of a Latin square over n items: each item once in each row and each column. The balanced one has n rows for even n, 2n
/// for odd n, and each item directly after each other one equally often [Williams 1949].
std::vector<std::vector<std::size_t>> latinSquare(std::size_t n);
std::vector<std::vector<std::size_t>> balancedSquare(std::size_t n);

}  // namespace presa::experiment
