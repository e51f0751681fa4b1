#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/runner/statistics/psychometric.h"

/// The `analysis` element of an experiment file: which statistics and figures to compute from its data. Names refer to
/// columns and measures of a trial (see variablesOf()). Plain data. Thread: any.
namespace presa::experiment {

using NameList = std::vector<std::string>;

namespace wanted {

/// Rank correlation of one measure with each of several columns.
struct Spearman {
  std::string y;
  NameList x, within;  ///< within: permutation strata, any of "subject", "session", "block"
  std::size_t permutations = 0;
};
/// Mean and intervals of every cell; a cell is one combination of the levels of `by`.
struct CellMeans {
  std::string y;
  NameList by;
};
/// Relative safety margin of the grip force over the slip force, per cell.
struct Margin {
  std::string grip, slip;
  NameList by;
};
/// Exponents of y = c x1^b1 x2^b2 …
struct LogLinear {
  std::string y;
  NameList x;
};
/// Slope of ln(force / stiffness) on ln stiffness: -1 under force control, 0 under depth control.
struct DepthControl {
  std::string force, stiffness;
  NameList x;
};
struct Psychometric {
  std::string x, y;
  NameList by;
  statistics::PsychometricModel model;
  std::string standard;     ///< the value of the standard: a number or a column; may be empty
  double threshold = 0.75;  ///< proportion of positive answers
  std::size_t draws = 0;
};

/// The figure types: 14, 15, 16, 17 and 12 of the PERCRO paper, in this order.
struct Bars {
  std::string y, rows, columns, color;
};
struct MeansPlot {
  std::string y, x, rows, columns, line;
  bool within_subject = false;  ///< draw the within-subject interval; false: the interval over trials
};
struct MarginPlot {
  std::string grip, slip, x, color, shape;
  bool log_x = false;  ///< logarithmic axis of x
};
struct Scatter {
  std::string x, y, color;
  bool diagonal = true;
};
struct TimeCourse {
  std::string finger, body, subject;
  int trial = 0;  ///< trial number; 0: the first valid trial
};

using Any = std::variant<Spearman, CellMeans, Margin, LogLinear, DepthControl, Psychometric, Bars, MeansPlot,
                         MarginPlot, Scatter, TimeCourse>;

}  // namespace wanted

struct Analysis {
  struct Item {
    std::string kind;      ///< name of its XML element
    std::string title;     ///< may be empty
    bool headline = true;  ///< repeat the result in the summary at the top of the report
    wanted::Any what;
  };
  double confidence = 0.95;
  std::uint64_t seed = 1;
  std::vector<Item> items;  ///< in the order of the file
};

struct Experiment;

/// A number or word of every trial that an analysis may name.
struct Variable {
  /// kColumn: a factor's column, set by the design. kPlace: position of the trial in its session. kOther: drawn per
  /// trial, chosen by a method, or an answer.
  enum class Kind { kColumn, kMeasure, kQuality, kPlace, kOther };
  std::string name, unit, description;
  Kind kind = Kind::kOther;
};
/// The columns of a trial's row (see row.h) and the place names below.
std::vector<Variable> variablesOf(const Experiment& experiment);

/// "block", "repeat", "session", "trial": position of a trial.
extern const NameList kPlaceNames;

}  // namespace presa::experiment
