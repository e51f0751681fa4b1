#pragma once
#include <string>
#include <vector>

#include "apps/common/report/svg_plot.h"
#include "apps/studies/cost/result.h"

namespace presa::cost {

/// How a setting is drawn, the same in every figure.
struct Look {
  int color = 0, shape = 0;
  std::string tag;  ///< the values in which it differs from the default
};
struct Looks {
  std::vector<Look> of;  ///< by outcome
  std::vector<svg::WorkFigure::Entry> legend;
};
/// Where every setting differs from the default in one knob, each knob has its colour and shape. In a grid the engine,
/// or else the knob with the largest effect on the first judged error and the cost, gives the colour, the next one the
/// shape; the other way round where that one has more values than there are shapes.
Looks looksOf(const Result& result);

}  // namespace presa::cost
