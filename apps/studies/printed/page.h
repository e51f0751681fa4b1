#pragma once
#include <string>

#include "apps/studies/printed/comparison.h"

namespace presa::printed {

/// Printed figures and grid as aligned text.
std::string terminalText(const Comparison& comparison);
/// One self-contained page: what the methods of today buy, printed beside measured, the grid with its plot.
std::string reportHtml(const Comparison& comparison, const std::string& command);
/// One line for each run of the grid, units in the header.
std::string toCsv(const Comparison& comparison);

}  // namespace presa::printed
