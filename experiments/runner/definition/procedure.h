#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/runner/definition/expression.h"
#include "experiments/runner/psychophysics/adjustment.h"
#include "experiments/runner/psychophysics/axis.h"
#include "experiments/runner/psychophysics/constant_stimuli.h"
#include "experiments/runner/psychophysics/forced_choice.h"
#include "experiments/runner/psychophysics/interleaved.h"
#include "experiments/runner/psychophysics/quest_plus.h"

/// What a psychophysical method varies from trial to trial, what the participant is asked, and who answers in simulation.
/// Plain data, immutable after reading. Thread: any.
namespace presa::experiment {

/// One number or word of a factor's level, or of a stimulus, and the values of the scene that it sets.
struct Column {
  std::string name, unit;
  std::vector<std::string> paths;  ///< as after --set; may be empty
};

/// A number drawn anew for every trial, each between its bounds equally likely.
struct Vary {
  Column column;
  double least = 0, most = 0;
};

/// The value that the method chooses, and what goes with it. With two alternatives side by side the values of the second place
/// lie at `second_paths`.
struct StimulusAxis {
  struct Coupled {
    std::vector<std::string> paths, second_paths;
    Expression value;  ///< over the stimulus alone
  };
  Column column;
  std::vector<std::string> second_paths;
  psychophysics::Axis axis;
  std::vector<Coupled> coupled;
};

enum class Task {
  kYesNo,            ///< one stimulus, one question
  kTwoIntervals,     ///< 2IFC: standard and comparison one after the other, in either order
  kTwoAlternatives,  ///< 2AFC: side by side
  kAdjust            ///< standard, then what is to be set, again and again until it is confirmed
};

/// Who answers when no person is there: compares what a measure says of either stimulus, with the noise that gives the Weber
/// fraction; says so, since it is a model and not a person.
struct SimulatedObserver {
  std::vector<std::string> percept;  ///< measure; with two alternatives one for each place
  double weber = 0.1;                ///< at 75 % correct in two intervals or alternatives
  double spread = 0;                 ///< sd of the logarithm of the fraction between subjects
  double lapse = 0;                  ///< share of answers that are a guess
  double criterion = 0;              ///< yes/no: the percept at which yes and no are equally likely
};

using MethodPlan = std::variant<psychophysics::InterleavedPlan, psychophysics::ConstantStimuliPlan,
                                psychophysics::QuestPlusPlan, psychophysics::AdjustmentPlan>;

struct Procedure {
  Task task = Task::kTwoIntervals;
  psychophysics::Coding coding = psychophysics::Coding::kCorrect;
  bool asks_for_less = false;
  std::size_t balance_over = 8;
  double gap = 0;          ///< between intervals [s]
  std::size_t rounds = 1;  ///< adjustment: most presentations of what is to be set
  StimulusAxis stimulus;
  MethodPlan plan;
  std::optional<SimulatedObserver> observer;

  /// Presentations of one trial, at most.
  std::size_t presentations() const { return task == Task::kTwoIntervals ? 2 : task == Task::kAdjust ? 2 * rounds : 1; }
};

/// The method with its task around it, from its first trial. Throws std::invalid_argument naming every mistake.
std::unique_ptr<psychophysics::Method> makeMethod(const Procedure& procedure, std::uint64_t seed);
/// Trials until the method has finished, at most.
std::size_t mostTrials(const Procedure& procedure);
std::vector<std::string> mistakes(const Procedure& procedure);

}  // namespace presa::experiment
