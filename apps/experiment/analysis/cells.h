#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/means.h"

namespace presa::experiment::analysis {

/// Means of one measure over the trials of each cell, for tables and figures alike.
struct CellMeansOf {
  struct OfCell {
    Group group;
    double mean = 0;
    std::optional<double> sd;
    std::optional<statistics::Interval> over_trials;     ///< t interval of the cell's trials
    std::optional<statistics::Interval> within_subject;  ///< after Cousineau and Morey
  };
  std::vector<OfCell> cells;
  std::optional<double> correction;  ///< Morey's factor; set when there are within-subject intervals
};
CellMeansOf cellMeans(const Context& context, const std::string& y, const NameList& by);

}  // namespace presa::experiment::analysis
