#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/evidence.h"

namespace presa::cost {

/// An error that a person can judge.
struct Metric {
  std::string name;   ///< as in --metric
  std::string title;  ///< "Force, RMS error"
  std::string unit;
  std::string meaning;
  /// The error of a setting; nothing where the scene has none. Absolute metrics do not look at the reference.
  std::optional<double> (*error)(const Evidence& setting, const Evidence& reference) = nullptr;
  bool absolute = false;  ///< zero would be right, whatever the reference says
  /// Just-noticeable difference in the metric's unit; nothing where none is known.
  std::optional<double> (*noticeable)(const Evidence& reference) = nullptr;
};

const std::vector<Metric>& allMetrics();
const Metric* findMetric(const std::string& name);
std::vector<std::string> metricNames();

/// Force that one can just tell from another, as a part of it [Pang1991, Jones1992: 7 to 10 %].
inline constexpr double kForceStep = 0.10;
/// Weber's law ends near the threshold: no step is smaller than that of this force [N].
inline constexpr double kLeastForce = 0.5;

}  // namespace presa::cost
