#pragma once
#include <string>
#include <vector>

#include "apps/common/terminal/text.h"
#include "apps/experiment/operator/session_view.h"

namespace presa::experiment {

/// Text for the operator, line by line; a terminal or a window shows it.
struct BoardLine {
  std::string text;
  terminal::Style style = terminal::Style::kPlain;
};
using Board = std::vector<BoardLine>;

/// At most `columns` wide and `rows` high: the plot of a method's answers comes last and takes what is left.
Board boardOf(const SessionView& view, std::size_t columns, std::size_t rows);

/// A bar of `cells` characters for value/most, with a mark at line/most; NaN: nothing, no mark.
std::string gauge(double value, double line, double most, std::size_t cells);
/// Levels of the answers from left to right, the newest at the right end: + positive, - negative, o not answered.
std::vector<std::string> levelPlot(const std::vector<psychophysics::Trial>& answers, std::size_t columns,
                                   std::size_t rows);

}  // namespace presa::experiment
