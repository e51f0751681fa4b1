#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/study/study_run.h"

namespace presa::stability {

/// In ascending order of severity.
enum class Verdict { kStable, kDrift, kUnstable, kFailed };
const char* toString(Verdict verdict);

/// One line of a plot.
struct Curve {
  std::string label;
  std::vector<double> x, y;
};

/// At most `max` points of the curve, evenly spaced, the last point included.
Curve decimated(Curve curve, std::size_t max = 2000);

/// One measured quantity of a trial with its reference.
struct Finding {
  std::string metric;  ///< "grip force error"
  double value = 0;
  std::string unit;    ///< "%"; may be empty
  double bound = 0;    ///< value up to which the verdict is stable
  std::string oracle;  ///< reference: "k depth = 20 N"
  Verdict verdict = Verdict::kFailed;
  std::string plot_x, plot_y;  ///< axes with units, when there are curves
  std::vector<Curve> curves;
};

/// Stable up to `bound`, drift up to ten times the bound, unstable above that or for NaN.
Verdict judge(double value, double bound);
/// Judges |value| against a bound.
Finding finding(std::string metric, double value, std::string unit, double bound, std::string oracle);

using Parameters = std::vector<std::pair<std::string, std::string>>;  ///< name and value with its unit, in column order

/// One parameter set under one method.
struct Trial {
  Parameters parameters;
  std::string method;  ///< kPresa, or the method that it replaces
  /// The known verdict of this method; a worse one is an error. For replaced methods: their verdict today.
  Verdict expected = Verdict::kStable;
  std::function<std::vector<Finding>()> run;  ///< may throw: the verdict is then kFailed, with the message as reason
  bool quick = false;                         ///< part of the subset that `./dev test` runs
};

inline constexpr const char* kPresa = "presa";

struct Case {
  std::string name;    ///< file name without extension
  std::string title;   ///< one line
  std::string source;  ///< origin of the case and of its reference, one sentence
  std::string oracle;  ///< reference result, one sentence
  std::string scene;   ///< file in scenes/, for `presa run`
  std::vector<Trial> trials;
};

/// The shortest decimal text: "0.05", "1e-06".
std::string number(double value);

/// All cases, in the order of the table.
std::vector<Case> allCases();

/// Path of a file under scenes/. The folder experiments/stability is searched for in the environment variable
/// PRESA_EXPERIMENTS, next to the program (up to four levels up), and in the working directory; throws InputError
/// (E615).
std::string sceneFile(const std::string& name);

/// Settings of a run of one of the scenes. `duration` 0: until the end of its script.
StudySpec specOf(const std::string& scene, std::vector<std::string> sets, double duration = 0, double trace_rate = 0);

}  // namespace presa::stability
