#pragma once
#include <string>
#include <vector>

#include "apps/common/terminal/text.h"
#include "apps/experiment/operator/session_view.h"

namespace presa::experiment {

/// One line of the operator's display in a terminal or a window.
struct ConsoleLine {
  std::string text;
  terminal::Style style = terminal::Style::kPlain;
};
using ConsoleView = std::vector<ConsoleLine>;

/// The display, at most `columns` wide and `rows` high. The plot of a method's answers comes last and fills the
/// remaining rows.
ConsoleView consoleViewOf(const SessionView& view, std::size_t columns, std::size_t rows);

/// A bar of `cells` characters for value/most, with a mark at line/most. NaN: no bar, no mark.
std::string gauge(double value, double line, double max, std::size_t cells);
/// Plot of the levels of the answers, the newest at the right end: + positive, - negative, o not answered.
std::vector<std::string> levelPlot(const std::vector<psychophysics::Trial>& answers, std::size_t columns,
                                   std::size_t rows);

}  // namespace presa::experiment
