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
#include "framework/scene/plugin_element.h"

/// The psychophysical procedure of an experiment: method, stimulus, task, and the simulated observer for dry runs.
/// Plain data, immutable after reading. Thread: any.
namespace presa::experiment {

/// One number or word of a factor's level or of a stimulus, with the scene values that it sets.
struct Column {
  std::string name, unit;
  std::vector<std::string> paths;  ///< scene paths as for --set; may be empty
};

/// A number drawn anew for every trial, uniformly between its bounds.
struct Vary {
  Column column;
  double min = 0, max = 0;
};

/// The value chosen by the method, with further scene values coupled to it. With two alternatives side by side,
/// `second_paths` set the second place.
struct StimulusAxis {
  struct Coupled {
    std::vector<std::string> paths, second_paths;
    Expression value;  ///< over the stimulus value alone
  };
  Column column;
  std::vector<std::string> second_paths;
  psychophysics::Axis axis;
  std::vector<Coupled> coupled;
};

using psychophysics::Task;

/// A model that answers in place of a participant. It compares the measured percepts of the two stimuli, with noise set
/// by the Weber fraction.
struct SimulatedObserver {
  std::vector<std::string> percept;  ///< measure; with two alternatives one for each place
  double weber = 0.1;                ///< Weber fraction at 75 % correct in two intervals or alternatives
  double spread = 0;                 ///< between subjects: sd of ln(Weber fraction)
  double lapse = 0;                  ///< proportion of answers that are guesses
  double criterion = 0;              ///< yes/no: the percept at which both answers are equally likely
};

/// The last one is the element of a method that a plug-in brings.
using MethodPlan = std::variant<psychophysics::InterleavedPlan, psychophysics::ConstantStimuliPlan,
                                psychophysics::QuestPlusPlan, psychophysics::AdjustmentPlan, PluginElement>;

struct Procedure {
  Task task = Task::kTwoIntervals;
  psychophysics::Coding coding = psychophysics::Coding::kCorrect;
  bool asks_for_less = false;
  std::size_t balance_over = 8;
  double gap = 0;          ///< between intervals [s]
  std::size_t rounds = 1;  ///< adjustment: max number of adjustable presentations
  StimulusAxis stimulus;
  MethodPlan plan;
  std::optional<SimulatedObserver> observer;

  /// Presentations of one trial, at most.
  std::size_t presentations() const { return task == Task::kTwoIntervals ? 2 : task == Task::kAdjust ? 2 * rounds : 1; }
};

/// The method wrapped in its task, at its first trial. Throws std::invalid_argument that lists every
/// mistake; InputError for a plug-in that cannot make its method.
std::unique_ptr<psychophysics::Method> makeMethod(const Procedure& procedure, std::uint64_t seed);
/// Upper bound on the trials until the method has finished.
std::size_t maxTrials(const Procedure& procedure);
std::vector<std::string> mistakes(const Procedure& procedure);

}  // namespace presa::experiment
