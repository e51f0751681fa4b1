#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/runner/psychophysics/axis.h"
#include "experiments/runner/psychophysics/method.h"

namespace presa::test {

/// A method plug-in without an experiment, answered by a simulated responder:
///
///     MethodRun run("weighted_up_down", {{"start", "1"}, {"step", "0.1"}, {"trials", "40"}});
///     run.answer([](double level) { return level > 0.3; });
///     EXPECT_EQ(run.levels().size(), 40U);
///
/// Attributes that are not given have the defaults of the manifest.
class MethodRun {
 public:
  using Responder = std::function<bool(double level)>;  ///< whether the answer is positive

  /// Throws std::invalid_argument when no plug-in brings `element` or a required attribute is missing; InputError when
  /// the method cannot be made.
  MethodRun(const std::string& element, const std::map<std::string, std::string>& attributes, std::uint64_t seed = 1,
            const psychophysics::Axis& axis = {});

  /// Answers every trial until the method has finished. Throws std::runtime_error after more than its max_trials.
  void answer(const Responder& positive);
  /// The levels presented so far, in order.
  std::vector<double> levels() const;
  psychophysics::Method& method() noexcept { return *method_; }  ///< to answer it by hand

  /// Whether a fresh method that gets the answers so far presents the same trials: then a session can be resumed.
  bool resumes() const;

 private:
  std::function<std::unique_ptr<psychophysics::Method>()> make_;
  std::unique_ptr<psychophysics::Method> method_;
  std::size_t max_trials_ = 0;
};

}  // namespace presa::test
