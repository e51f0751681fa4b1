#pragma once
#include <optional>
#include <string>

#include "apps/studies/cost/trace.h"
#include "framework/plugin/plugin_loader.h"

namespace presa::cost {

/// An error metric in units that a person can judge.
struct Metric {
  std::string name;     ///< name for --metric
  std::string title;    ///< such as "Force, RMS error"
  std::string unit;     ///< such as "N"
  std::string meaning;  ///< definition in words, for reports
  /// The error of a setting; no value when the metric does not apply to the scene. Absolute metrics ignore the
  /// reference.
  std::optional<double> (*error)(const Evidence& setting, const Evidence& reference) = nullptr;
  bool absolute = false;  ///< the right value is zero, independent of the reference
  /// Just-noticeable difference in the metric's unit; no value when it is unknown. Null in a plug-in: it is unknown.
  std::optional<double> (*noticeable)(const Evidence& reference) = nullptr;
};

/// Table of a plug-in of kind metric (framework/scene/manifest.h). `presa cost` loads it when a study names it, as
/// --metric NAME; errors of settings and just-noticeable differences are then drawn and compared like those of its own.
/// Thread: main.
struct MetricPlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  Metric metric;         ///< its name is that of the manifest
};

/// Weber fraction of force [Pang1991, Jones1992: 7 to 10 %].
inline constexpr double kForceStep = 0.10;
/// Below this force [N], near the threshold, Weber's law fails: steps are computed as at this force.
inline constexpr double kMinForce = 0.5;

}  // namespace presa::cost

/// Exports `table`, a MetricPlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_METRIC_PLUGIN(table)                                                                         \
  extern "C" __attribute__((visibility("default"))) const presa::cost::MetricPlugin* presaMetricPlugin() { \
    return &(table);                                                                                       \
  }
