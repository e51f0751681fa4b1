#pragma once
#include <string>
#include <vector>

#include "apps/common/report/svg_plot.h"
#include "apps/common/report/svg_save.h"
#include "apps/common/report/svg_scale.h"

/// Parts of a time figure.
namespace presa::svg {

inline constexpr double kTimeLeft = 70;      ///< left edge of the plotting area [px]
inline constexpr double kCharacterPx = 6.6;  ///< mean width of a character of the labels
inline constexpr double kSwatch = 14;        ///< line in front of a label
inline constexpr double kMaxEndLabel = 180;  ///< longest name at the end of a curve
inline constexpr int kTimeTicks = 12;        ///< about

/// The text, or its beginning and "…" if it is wider than this.
std::string shortened(const std::string& text, double px);

/// One panel with its title, bands, grid, levels, curves and their labels; `x` is the scale of the whole figure.
std::string panelBody(const TimeFigure& figure, const Panel& panel, const Scale& x, double top);
/// The name of a series at its end; empty: the panel's title says it all.
std::string endLabelOf(const Panel& panel, const Series& series);

/// The polyline of a series, thinned to the pixels without losing an extreme.
std::string linePath(const TimeFigure& figure, const Series& series, const Scale& x, const Scale& y);

/// Samples, names and pixel range for the read-out script of the page.
std::string readoutData(const TimeFigure& figure, const Scale& x);
/// What is drawn: every sample, or min and max of each pixel column where there are more.
Csv csvOf(const TimeFigure& figure);

}  // namespace presa::svg
