#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "experiments/runner/statistics/psychometric.h"

/// What an experiment's file wants to know of its data: the `analysis` element. Names are those of columns and measures.
/// Nothing else is computed. Thread: any.
namespace presa::experiment {

using NameList = std::vector<std::string>;

namespace wanted {

/// Rank correlation of one measure with each of several columns.
struct Spearman {
  std::string y;
  NameList x, within;  ///< within: "subject", "session", "block", of which a permutation keeps each apart
  std::size_t permutations = 0;
};
/// Mean and intervals of every cell: one combination of the levels of `by`.
struct CellMeans {
  std::string y;
  NameList by;
};
/// Relative safety margin of grip over slip force, per cell.
struct Margin {
  std::string grip, slip;
  NameList by;
};
/// Exponents of y = c x1^b1 x2^b2 …
struct LogLinear {
  std::string y;
  NameList x;
};
/// Slope of ln(force / stiffness) on ln stiffness: -1 where a force was held, 0 where a depth was.
struct DepthControl {
  std::string force, stiffness;
  NameList x;
};
struct Psychometric {
  std::string x, y;
  NameList by;
  statistics::PsychometricModel model;
  std::string standard;     ///< a number or a column; may be empty
  double threshold = 0.75;  ///< proportion
  std::size_t draws = 0;
};

/// Figures, as 14, 15, 16, 17 and 12 of the PERCRO paper.
struct Bars {
  std::string y, rows, columns, color;
};
struct MeansPlot {
  std::string y, x, rows, columns, line;
  bool within_subject = false;  ///< which interval is drawn; else of the trials
};
struct MarginPlot {
  std::string grip, slip, x, color, shape;
};
struct Scatter {
  std::string x, y, color;
  bool diagonal = true;
};
struct TimeCourse {
  std::string finger, body, subject;
  int trial = 0;  ///< 0: the first that counts
};

using Any = std::variant<Spearman, CellMeans, Margin, LogLinear, DepthControl, Psychometric, Bars, MeansPlot,
                         MarginPlot, Scatter, TimeCourse>;

}  // namespace wanted

struct Analysis {
  struct Item {
    std::string kind;      ///< name of its element
    std::string title;     ///< may be empty
    bool headline = true;  ///< what it finds is told at the top too
    wanted::Any what;
  };
  double confidence = 0.95;
  std::uint64_t seed = 1;
  std::vector<Item> items;  ///< as they stand in the file
};

struct Experiment;

/// A number or word of every trial that an analysis may name.
struct Variable {
  /// Column: a factor's, set by the design. Place: of a trial in its session. Other: drawn, chosen by a method, answered.
  enum class Kind { kColumn, kMeasure, kQuality, kPlace, kOther };
  std::string name, unit, description;
  Kind kind = Kind::kOther;
};
/// Columns of a trial's row (see row.h), and its places.
std::vector<Variable> variablesOf(const Experiment& experiment);

/// "block", "repeat", "session", "trial": where a trial stands.
extern const NameList kPlaceNames;

}  // namespace presa::experiment
