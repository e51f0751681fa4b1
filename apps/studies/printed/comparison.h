#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/printed_figures.h"

/// A system as a paper prints it beside the same scene and hands with the methods of today. All runs are in lockstep
/// virtual time. Thread: main.
namespace presa::printed {

/// What one run shows of its grasp; of several fingers the worst. NaN: the run does not show it.
struct Grasp {
  bool held = false;         ///< in stick for all of the hold
  double frequency = 0;      ///< natural, along the grip [Hz]
  double min_mass = 0;       ///< for an explicit exchange of forces [kg]
  double ripple = 0;         ///< of the grip, peak to peak over its mean
  double mismatch = 0;       ///< of the impulses on user and object over 0.1 s
  double slip = 0;           ///< grip at the slip that is farthest from the limit [N]
  double slip_limit = 0;     ///< m g / (n mu_s) [N]
  double slip_known_to = 0;  ///< fall of the grip in the step before [N]
  double offset = 0;         ///< range of the difference between finger and object in the hold [mm]
};
/// Reads it from the summary of a run.
Grasp graspOf(const nlohmann::json& summary);

/// A cell of the grid.
struct Cell {
  std::vector<double> values;  ///< as Printed::vary
  Grasp printed, today;
};
/// Last values, in the order of Printed::until_lost, at which the object was held; none: at no value.
struct Lasting {
  std::optional<double> printed, today;
  double min_mass = 0;  ///< for an explicit exchange of forces, at these settings [kg]
};

/// One of the methods of today alone, all others as printed.
struct Alone {
  std::string set;  ///< PATH=VALUE
  Grasp grasp;      ///< of the scene as it is
  std::optional<double> lasting;
};

struct Comparison {
  std::string scene;
  Printed print;
  nlohmann::json printed, today;  ///< summaries of the scene as it is
  std::vector<Cell> cells;
  std::optional<Lasting> lasting;
  std::vector<Alone> alone;  ///< as Printed::today

  /// Whether every grasp of the grid holds with the methods of today.
  bool holds() const;
  /// What the methods of today buy, written from the figures.
  std::vector<std::string> sentences() const;
};

/// Ctrl-C, SIGTERM or SIGHUP came during a run.
struct Stopped {};

/// Runs everything, with progress on stderr. Throws InputError for a scene that cannot be loaded or has no file of
/// printed figures (E619), and Stopped.
Comparison compare(const std::string& scene);

}  // namespace presa::printed
