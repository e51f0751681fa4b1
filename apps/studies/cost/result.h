#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/studies/cost/evidence.h"
#include "apps/studies/cost/study.h"

namespace presa::cost {

/// Errors up to this value, in any unit, are rounding: a metric without larger errors is dropped.
inline constexpr double kRounding = 1e-9;

/// Median and range of a figure over repeated runs.
struct Spread {
  double median = 0, low = 0, high = 0;
};

/// Results of one setting.
struct Outcome {
  Setting setting;
  std::string failure;                  ///< why the setting has no errors; empty: it has
  std::map<std::string, double> error;  ///< by metric
  std::vector<Timing> timings;          ///< one per repeat; empty when the setting could not be run

  double instructions = 0;  ///< per simulated second; 0: not counted

  bool timed() const { return !timings.empty(); }
  Spread perSecond() const;  ///< processor time per simulated second [-]
  Spread busiestTick()
      const;              ///< 99.9 % of the ticks of the busiest rate group cost less than this part of its period [-]
  Spread load() const;    ///< [s]
  Spread memory() const;  ///< [B]
};

/// Observed order of convergence along one knob in one metric, all other knobs the same.
struct Order {
  std::string factor, metric;
  /// Errors fall with this power of the step: of the value where smaller ones are finer, else of 1 / value.
  double order = 0;
  /// Coarse to fine. The last one is what the others are compared with, unless the reference is analytic.
  std::vector<std::string> values;
};

/// All data of a report. `outcomes` are in the order of Study::settings.
struct Result {
  Study study;
  std::vector<Outcome> outcomes;
  struct Reference {
    bool fine_enough = false;                ///< residual below a tenth of the smallest error, in every metric
    std::vector<std::string> sets;           ///< sets of the finest level used
    std::vector<std::string> kept;           ///< knobs that could not be refined as planned, with their values
    std::map<std::string, double> residual;  ///< by metric: error of the second finest level against the finest
    std::map<std::string, double> noticeable;
  } reference;
  /// A decimated mesh and the distance of its surface from the original.
  struct Mesh {
    std::string body, value;
    std::size_t source_triangles = 0, triangles = 0;
    double hausdorff = 0;  ///< [file units]
  };
  std::vector<Mesh> meshes;
  std::vector<Order> orders;
  /// Ten times the reference's residual: smaller errors are not known to a tenth. 0: all errors are.
  double resolution(const std::string& metric) const;
  /// True when the outcome's error is known to a tenth, or when it has no error.
  bool resolved(const Outcome& outcome, const std::string& metric) const;
  /// The outcome's error, but at least the resolution.
  double claimed(const Outcome& outcome, const std::string& metric) const;
  std::vector<std::string> metrics;                          ///< metrics that apply to the scene, in the study's order
  std::vector<std::pair<std::string, std::string>> machine;  ///< facts about the machine
  std::string command;
  bool interrupted = false;
  std::size_t runs = 0;     ///< made for this study now, the kept ones of --resume not counted
  double runs_seconds = 0;  ///< wall time while they ran [s]
};

}  // namespace presa::cost
