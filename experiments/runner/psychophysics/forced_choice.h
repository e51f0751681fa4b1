#pragma once
#include <map>
#include <memory>
#include <vector>

#include "experiments/runner/psychophysics/method.h"
#include "framework/core/math/random.h"

namespace presa::psychophysics {

enum class Task {
  kYesNo,            ///< one stimulus, one question
  kTwoIntervals,     ///< 2IFC: standard and comparison one after the other, in either order
  kTwoAlternatives,  ///< 2AFC: side by side
  kAdjust            ///< the standard, then the adjustable comparison, until confirmed; not a forced choice
};

struct ForcedChoicePlan {
  Task task = Task::kTwoIntervals;
  /// Meaning of a correct answer: a comparison above the standard was called the greater one, one below it the smaller
  /// one (at level 0, where both are equal: the greater one). For yes/no: "yes" at any level but 0.
  Coding coding = Coding::kCorrect;
  bool asks_for_less = false;  ///< the question asks for the smaller value: "which was more slippery?" for friction
  /// Number of trials of one track over which the standard is equally often in each place; rounded up to even, > 0. For
  /// constant stimuli use the trials per level for an exact balance. Small numbers let a participant predict the place.
  std::size_t balance_over = 8;
};

/// Wraps a method in a task: chooses the place of the standard and derives from the chosen place whether the answer was
/// positive. It owns the method; run and replay the trials through this object only.
class ForcedChoice final : public Method {
 public:
  /// Throws std::invalid_argument without a method, with a method of adjustment or the task kAdjust, or when
  /// `balance_over` is 0.
  ForcedChoice(std::unique_ptr<Method> method, ForcedChoicePlan plan, const RandomStream& stream);

  const Method& method() const noexcept { return *method_; }
  Response responseFor(bool positive) const override;

 private:
  void update(Trial& trial) override;
  std::optional<Stimulus> choose() override;
  Stimulus again(const Stimulus& discarded) override;
  bool isPositive(const Stimulus& stimulus, int chosen) const;
  int drawPlace(std::size_t track);

  std::unique_ptr<Method> method_;
  ForcedChoicePlan plan_;
  RandomStream stream_;
  std::map<std::size_t, std::vector<int>> places_left_;  ///< by track, the next one at the back
};

}  // namespace presa::psychophysics
