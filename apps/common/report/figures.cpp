#include "apps/common/report/figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace presa {
namespace {

/// The object whose height is drawn: the grasped one, else the first traced one.
const RunResult::Object* drawnObject(const RunResult& result, const std::optional<GraspFigures>& grasp) {
  if (grasp) return &result.objects[grasp->object];
  const auto rank = [](const RunResult::Object& object) {
    return object.trace_slot < 0 ? 2 : object.summary.grasped ? 0 : 1;
  };
  const auto best = std::min_element(result.objects.begin(), result.objects.end(),
                                     [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return best == result.objects.end() || best->trace_slot < 0 ? nullptr : &*best;
}

template <class Value>
std::vector<double> column(const BoundedList<TraceSample>& trace, Value value) {
  std::vector<double> out;
  out.reserve(trace.size());
  for (const TraceSample& sample : trace) out.push_back(value(sample));
  return out;
}

const FingerGrasp* graspOf(const std::optional<GraspFigures>& grasp, std::size_t contact_point) {
  if (!grasp) return nullptr;
  const auto finger = std::find_if(grasp->fingers.begin(), grasp->fingers.end(),
                                   [&](const FingerGrasp& f) { return f.contact_point == contact_point; });
  return finger == grasp->fingers.end() ? nullptr : &*finger;
}

std::string shortNumber(double value, const char* pattern = "%.3f") {
  char text[48];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

}  // namespace

svg::TimeFigure pathFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                           std::size_t contact_point) {
  const BoundedList<TraceSample>& trace = *result.trace;
  const auto finger = [&](const TraceSample& sample) -> const FingerContact& { return sample.fingers[contact_point]; };
  svg::TimeFigure figure;
  figure.title = "Height, grip force and contact state of " + result.contact_points[contact_point].name + " over time";
  figure.time = column(trace, [](const TraceSample& sample) { return sample.time; });
  for (const RunResult::Phase& phase : result.phases) figure.bands.push_back({phase.name, phase.begin, phase.end});

  svg::Panel height{.title = "Height", .unit = "m", .height = 230};
  height.series.push_back({"finger", "finger", column(trace, [&](const auto& s) { return finger(s).p_WH.z(); })});
  height.series.push_back({"proxy", "proxy", column(trace, [&](const auto& s) { return finger(s).p_WP.z(); })});
  if (const RunResult::Object* object = drawnObject(result, grasp)) {
    const auto slot = static_cast<std::size_t>(object->trace_slot);
    height.series.push_back(
        {object->name, "object", column(trace, [&](const auto& s) { return s.bodies[slot].p.z(); })});
  }

  svg::Panel force{.title = "Grip force", .unit = "N", .height = 150, .from_zero = true};
  force.series.push_back({"normal", "force", column(trace, [&](const auto& s) { return finger(s).normal_force; })});
  force.series.push_back(
      {"tangential", "tangential", column(trace, [&](const auto& s) { return finger(s).tangential_force_W.norm(); })});
  if (graspOf(grasp, contact_point) && grasp->slip_limit > 0) {
    force.levels.push_back({grasp->slip_limit, "slip limit " + shortNumber(grasp->slip_limit) + " N", "limit"});
  }

  svg::Panel state{.title = "Contact state", .height = 72, .names = {"none", "stick", "slip"}};
  state.series.push_back(
      {"state", "state", column(trace, [&](const auto& s) { return static_cast<double>(finger(s).mode); }), true});
  figure.panels = {std::move(height), std::move(force), std::move(state)};
  return figure;
}

svg::ScatterFigure frictionFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                                  std::size_t contact_point) {
  const RunResult::ContactPoint& point = result.contact_points[contact_point];
  svg::ScatterFigure figure;
  figure.title = "Tangential over normal force of " + point.name;
  figure.x_label = "normal force [N]";
  figure.y_label = "tangential force [N]";
  svg::Cloud stick{"stick", "stick", {}}, slip{"slip", "slip", {}};
  const RunResult::Object* object = drawnObject(result, grasp);
  for (const TraceSample& sample : *result.trace) {
    const FingerContact& contact = sample.fingers[contact_point];
    if (contact.mode == ContactMode::kNone || (object && contact.body != object->body)) continue;
    svg::Cloud& cloud = contact.mode == ContactMode::kSlip ? slip : stick;
    cloud.points.push_back({contact.normal_force, contact.tangential_force_W.norm()});
  }
  figure.clouds = {std::move(stick), std::move(slip)};
  if (object) {
    figure.rays.push_back({"slip line, static friction " + shortNumber(object->friction_static, "%.3g"), "static",
                           object->friction_static});
    figure.rays.push_back(
        {"dynamic friction " + shortNumber(object->friction_dynamic, "%.3g"), "dynamic", object->friction_dynamic});
  }
  if (const FingerGrasp* finger = graspOf(grasp, contact_point); finger && finger->slip) {
    figure.marks.push_back({"last stick before the slip at " + shortNumber(finger->slip->time) + " s",
                            "onset",
                            {finger->slip->last_stick_normal_force, finger->slip->last_stick_tangential_force}});
  }
  return figure;
}

}  // namespace presa
