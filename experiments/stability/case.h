#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/study_run.h"

namespace presa::stability {

/// Worse comes later.
enum class Verdict { kStable, kDrift, kUnstable, kFailed };
const char* toString(Verdict verdict);

/// One line of a plot.
struct Curve {
  std::string label;
  std::vector<double> x, y;
};

/// At most `most` of the curve's points, evenly taken, the last one among them.
Curve decimated(Curve curve, std::size_t most = 2000);

/// What was measured in a trial, against what.
struct Finding {
  std::string metric;  ///< "grip force error"
  double value = 0;
  std::string unit;    ///< "%"; may be empty
  double bound = 0;    ///< value up to which the verdict is stable
  std::string oracle;  ///< "k depth = 20 N"
  Verdict verdict = Verdict::kFailed;
  std::string plot_x, plot_y;  ///< axes with units, when there are curves
  std::vector<Curve> curves;
};

/// Stable up to `bound`, drifting up to ten times that, unstable beyond or when it is no number.
Verdict judge(double value, double bound);
/// The finding of |value| against a bound.
Finding finding(std::string metric, double value, std::string unit, double bound, std::string oracle);

using Parameters =
    std::vector<std::pair<std::string, std::string>>;  ///< name and value with its unit, in order of the table

/// One parameter set under one method.
struct Trial {
  Parameters parameters;
  std::string method;  ///< kPresa, or what it replaces
  /// The verdict that this method is known to reach; a worse one is an error. Of what Presa replaces: what it does today.
  Verdict expected = Verdict::kStable;
  std::function<std::vector<Finding>()> run;  ///< may throw: verdict failed, with the reason
  bool quick = false;                         ///< part of the subset that `./dev test` runs
};

inline constexpr const char* kPresa = "presa";

struct Case {
  std::string name;    ///< as the file
  std::string title;   ///< one line
  std::string source;  ///< where case and answer come from, one sentence
  std::string oracle;  ///< what the result is held against, one sentence
  std::string scene;   ///< file in scenes/, shown by `presa run`
  std::vector<Trial> trials;
};

/// As short as it can be: "0.05", "1e-06".
std::string number(double value);

/// All cases, in the order of the table.
std::vector<Case> allCases();

/// Path of a file under scenes/. The folder experiments/stability is looked for in the environment variable
/// PRESA_EXPERIMENTS, beside the program (up to four levels up), then in the working directory; throws InputError (E610).
std::string sceneFile(const std::string& name);

/// A run of one of the scenes. `duration` 0: to the end of its script.
StudySpec specOf(const std::string& scene, std::vector<std::string> sets, double duration = 0, double trace_rate = 0);

}  // namespace presa::stability
