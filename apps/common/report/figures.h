#pragma once
#include <cstddef>
#include <optional>

#include "apps/common/grasp_figures.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/run_result.h"

namespace presa {

/// Height of finger and object, grip force and contact state of one contact point over time, as figure 12 of the
/// PERCRO paper shows them. Needs a trace.
svg::TimeFigure pathFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                           std::size_t contact_point);

/// Tangential over normal force of one contact point, with the friction limits as lines. Needs a trace.
svg::ScatterFigure frictionFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                                  std::size_t contact_point);

}  // namespace presa
