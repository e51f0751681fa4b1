#pragma once
#include <map>
#include <memory>
#include <vector>

#include "framework/core/math/random.h"
#include "experiments/runner/psychophysics/method.h"

namespace presa::psychophysics {

enum class Task {
  kTwoIntervals,     ///< 2IFC: standard and comparison one after the other
  kTwoAlternatives,  ///< 2AFC: side by side
  kYesNo,            ///< one stimulus
};

struct ForcedChoicePlan {
  Task task = Task::kTwoIntervals;
  /// Correct means: the comparison above the standard was called the greater one, the one below it the smaller (at level
  /// 0, where none is: the greater); in yes/no "yes" at any level but 0.
  Coding coding = Coding::kCorrect;
  bool asks_for_less = false;  ///< the question asks for the smaller value: "which was more slippery?" on friction
  /// Each place holds the standard equally often in so many trials of one track (rounded up to even, > 0). For constant
  /// stimuli take the trials per level: balanced exactly. Small numbers can be guessed by who counts.
  std::size_t balance_over = 8;
};

/// Puts a task around a method: says which place holds the standard and works out from the place chosen whether the
/// answer was positive. It owns the method; trials and replay go through this object alone.
class ForcedChoice final : public Method {
 public:
  /// Throws std::invalid_argument without a method, around a method of adjustment, or when `balance_over` is 0.
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
  std::map<std::size_t, std::vector<int>> places_left_;  ///< by track, the next one last
};

}  // namespace presa::psychophysics
