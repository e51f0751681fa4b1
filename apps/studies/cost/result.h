#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"

namespace presa::cost {

/// Errors that never exceed this, in whatever unit, are rounding: such a metric has nothing to show in this scene.
inline constexpr double kRounding = 1e-9;

/// A figure from repeated runs.
struct Spread {
  double median = 0, low = 0, high = 0;
};

/// What became of one setting.
struct Outcome {
  Setting setting;
  std::string failure;                  ///< why there is no error to show; empty: there is
  std::map<std::string, double> error;  ///< by metric
  std::vector<Timing> timings;          ///< one per repeat; empty when it could not be run

  double instructions = 0;  ///< per simulated second; 0: not counted

  bool timed() const { return !timings.empty(); }
  Spread perSecond() const;  ///< processor time per simulated second [-]
  Spread busiestTick()
      const;              ///< 99.9 % of the ticks of the busiest rate group cost less than this part of its period [-]
  Spread load() const;    ///< [s]
  Spread memory() const;  ///< [B]
};

/// Everything a report says. `outcomes` are as Study::settings.
struct Result {
  Study study;
  std::vector<Outcome> outcomes;
  struct Reference {
    bool fine_enough = false;                ///< residual below a tenth of the smallest error shown, in every metric
    std::vector<std::string> sets;           ///< of the finest level used
    std::map<std::string, double> residual;  ///< by metric: difference of the two finest levels
    std::map<std::string, double> noticeable;
  } reference;
  /// A decimated mesh and how far its surface is from the original's.
  struct Mesh {
    std::string body, value;
    std::size_t source_triangles = 0, triangles = 0;
    double hausdorff = 0;  ///< [file units]
  };
  std::vector<Mesh> meshes;
  /// Errors below this, ten residuals of the reference, are not known to a tenth; 0: all are known.
  double resolution(const std::string& metric) const;
  /// True when the outcome's error is known so, or when it has none.
  bool resolved(const Outcome& outcome, const std::string& metric) const;
  /// The outcome's error, at least the resolution: what may be claimed.
  double claimed(const Outcome& outcome, const std::string& metric) const;
  std::vector<std::string> metrics;                          ///< those that the scene has, in the study's order
  std::vector<std::pair<std::string, std::string>> machine;  ///< for the fine print
  std::string command;
  bool interrupted = false;
};

}  // namespace presa::cost
