#include "apps/common/report/joint_section.h"

#include <algorithm>
#include <cmath>

#include "apps/common/joint_words.h"
#include "apps/common/number_text.h"
#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "framework/scene/joints/joint_words.h"

namespace presa::html {
namespace {

constexpr std::size_t kMaxCurves = 6;  // as many colours as there are

std::string stopTime(const std::optional<double>& stop, double seconds) { return stop ? fixed(seconds, 3) : "–"; }

std::string jointTable(const JointLog& log) {
  std::string rows;
  for (std::size_t j = 0, p = 0; j < log.scene().joints.size(); ++j) {
    const Joint& joint = log.scene().joints[j];
    if (positionCount(joint) == 0)
      rows += row({svg::escape(joint.name), nameOf(joint.type), "–", "–", "–", "–", "–", "–"});
    for (std::size_t i = 0; i < positionCount(joint); ++i, ++p) {
      const JointTravel& travel = log.positions()[p].travel;
      const auto text = [&](double value) { return positionText(joint, i, value); };
      const JointAxis axis = i < joint.axes.size() ? joint.axes[i] : JointAxis{};
      rows += row({svg::escape(positionName(joint, i)), nameOf(joint.type), text(travel.start), text(travel.min),
                   text(travel.max), text(travel.end), stopTime(axis.lower, travel.at_lower),
                   stopTime(axis.upper, travel.at_upper)});
    }
  }
  return table({"joint", "type", "start", "min", "max", "end", "at lower stop [s]", "at upper stop [s]"}, rows);
}

svg::TimeFigure figureOf(const JointLog& log, bool angles, double max_step) {
  svg::TimeFigure figure;
  figure.title = angles ? "Angles of the joints over time" : "Displacements of the joints over time";
  figure.time = log.times();
  figure.max_step = max_step;
  svg::Panel panel{.title = angles ? "Angle" : "Displacement", .unit = angles ? "deg" : "mm", .height = 200};
  const std::vector<const JointLog::Position*> drawn = mostMoved(log, angles, kMaxCurves);
  for (const JointLog::Position* position : drawn) {
    const Joint& joint = log.jointOf(*position);
    svg::Series series{positionName(joint, position->axis), "s" + std::to_string(panel.series.size()),
                       position->samples};
    const double unit = unitOf(joint, position->axis).factor;
    for (double& value : series.y) value *= unit;
    panel.series.push_back(std::move(series));
    if (drawn.size() > 1 || position->axis >= joint.axes.size()) continue;
    const JointAxis& axis = joint.axes[position->axis];
    if (axis.lower) panel.levels.push_back({unit * *axis.lower, "lower stop", "limit"});
    if (axis.upper) panel.levels.push_back({unit * *axis.upper, "upper stop", "limit"});
  }
  if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  return figure;
}

std::size_t countOf(const JointLog& log, bool angles) {
  return static_cast<std::size_t>(std::ranges::count_if(
      log.positions(), [&](const JointLog::Position& p) { return isAngle(log.jointOf(p), p.axis) == angles; }));
}

}  // namespace

std::string jointSection(const JointLog* log, double max_step) {
  if (log == nullptr || log->scene().joints.empty()) return {};
  std::string out = "<h2>Joints</h2>\n" + jointTable(*log);
  bool left_out = false;
  for (const bool angles : {true, false}) {
    const svg::TimeFigure figure = figureOf(*log, angles, max_step);
    if (log->times().size() > 1 && !figure.panels.empty()) out += svg::render(figure);
    left_out = left_out || countOf(*log, angles) > kMaxCurves;
  }
  return out +
         "<p class=\"caption\">Positions are 0 in the start pose; angles go on beyond half a turn. At a stop: within " +
         fixed(1e3 * kAtStop, 1) + " mm or " + significant(kAtStopAngle * 180 / M_PI, 1) + " deg of it." +
         (left_out ? " Drawn are the " + std::to_string(kMaxCurves) + " positions of each unit that changed most."
                   : "") +
         "</p>\n";
}

}  // namespace presa::html
