#include "apps/common/report/figures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/common/number_text.h"
#include "apps/common/report/fault_events.h"

namespace presa {
namespace {

constexpr double kMissing = 5;  // trace samples missing in a row: the loop stood still

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

/// A series with the ranges between its samples. `own` reads the sample itself, `range` its TraceRanges.
svg::Series ranged(const BoundedList<TraceSample>& trace, std::size_t contact_point, const std::string& label,
                   const std::string& css_class, const std::function<double(const TraceSample&)>& own,
                   TraceRange TraceRanges::*range) {
  const auto rangeOf = [&](const TraceSample& s) { return s.ranges[contact_point].*range; };
  return {label,
          css_class,
          column(trace, own),
          false,
          column(trace, [&](const TraceSample& s) { return rangeOf(s).min; }),
          column(trace, [&](const TraceSample& s) { return rangeOf(s).max; })};
}

const std::string& nameOf(const RunResult& result, std::int32_t body) {
  static const std::string unknown = "?";
  const std::vector<Body>& bodies = result.world->scene.bodies;
  return static_cast<std::size_t>(body) < bodies.size() ? bodies[static_cast<std::size_t>(body)].name : unknown;
}

/// Samples farther apart than this were not taken one after the other; 0: not known [s].
double maxStep(const BoundedList<TraceSample>& trace) {
  return trace.size() > 1 ? kMissing * (trace[1].time - trace[0].time) : 0;
}

/// The intervals in which the contact point touched one body, by name.
std::vector<svg::Band> touched(const RunResult& result, std::size_t contact_point) {
  std::vector<svg::Band> spans;
  std::int32_t before = kNoBody;
  double last = result.trace->begin()->time;
  for (const TraceSample& sample : *result.trace) {
    if (sample.time - last > maxStep(*result.trace)) before = kNoBody;
    last = sample.time;
    const FingerContact& finger = sample.fingers[contact_point];
    const std::int32_t body = finger.mode == ContactMode::kNone ? kNoBody : finger.body;
    if (body != kNoBody && body != before) spans.push_back({nameOf(result, body), sample.time, sample.time});
    if (before != kNoBody && !spans.empty() && (body == before || body == kNoBody)) spans.back().end = sample.time;
    if (body != kNoBody && before != kNoBody && body != before) spans[spans.size() - 2].end = sample.time;
    before = body;
  }
  return spans;
}

/// While forces fade after a stop, rendered forces are felt by nobody and may exceed every limit.
void hideRenderedAfter(double stop, const BoundedList<TraceSample>& trace, svg::Panel& force) {
  for (svg::Series& series : force.series) {
    if (series.css_class.starts_with("thin")) {
      for (std::size_t i = 0; i < trace.size(); ++i) {
        if (trace[i].time >= stop) series.y[i] = series.low[i] = series.high[i] = std::nan("");
      }
    }
  }
}

/// Force of the finger's device, split along the contact normal: what was commanded in front, what was rendered behind.
svg::Panel forcePanel(const RunResult& result, std::size_t f, const std::vector<svg::Band>& spans) {
  const BoundedList<TraceSample>& trace = *result.trace;
  const auto commanded = [f](const TraceSample& s) { return partsOf(s.f_command[f], s.fingers[f]); };
  svg::Panel force{.title = "Grip force" + svg::touching(spans), .unit = "N", .height = 170, .from_zero = true};
  force.series = {
      ranged(
          trace, f, "tangential, rendered", "thin second",
          [f](const auto& s) { return s.fingers[f].tangential_force_W.norm(); }, &TraceRanges::rendered_tangential),
      ranged(
          trace, f, "normal, rendered", "thin", [f](const auto& s) { return s.fingers[f].normal_force; },
          &TraceRanges::rendered_normal),
      ranged(
          trace, f, "tangential, commanded", "tangential", [&](const auto& s) { return commanded(s).tangential; },
          &TraceRanges::commanded_tangential),
      ranged(
          trace, f, "normal, commanded", "force", [&](const auto& s) { return commanded(s).normal; },
          &TraceRanges::commanded_normal)};
  if (result.stopped_at >= 0) hideRenderedAfter(result.stopped_at, trace, force);
  return force;
}

}  // namespace

svg::TimeFigure pathFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                           std::size_t contact_point) {
  const BoundedList<TraceSample>& trace = *result.trace;
  const auto finger = [&](const TraceSample& sample) -> const FingerContact& { return sample.fingers[contact_point]; };
  svg::TimeFigure figure;
  figure.title = "Height, grip force and contact state of " + result.contact_points[contact_point].name + " over time";
  figure.time = column(trace, [](const TraceSample& sample) { return sample.time; });
  figure.max_step = maxStep(trace);
  for (const RunResult::Phase& phase : result.phases) figure.bands.push_back({phase.name, phase.begin, phase.end});

  for (const RunResult::Fault& fault : result.faults) addFault(fault.time, fault.text, figure.events);
  if (result.stopped_at >= 0) figure.events.push_back({"stopped by you", result.stopped_at});

  svg::Panel height{.title = "Height", .unit = "m", .height = 230};
  height.series = {ranged(
                       trace, contact_point, "finger", "finger", [&](const auto& s) { return finger(s).p_WH.z(); },
                       &TraceRanges::height),
                   ranged(
                       trace, contact_point, "proxy", "proxy", [&](const auto& s) { return finger(s).p_WP.z(); },
                       &TraceRanges::proxy_height)};
  if (const RunResult::Object* object = drawnObject(result, grasp)) {
    const auto slot = static_cast<std::size_t>(object->trace_slot);
    height.series.push_back(
        {object->name, "object", column(trace, [&](const auto& s) { return s.bodies[slot].p.z(); })});
  }
  const std::vector<svg::Band> spans = touched(result, contact_point);
  svg::Panel force = forcePanel(result, contact_point, spans);
  if (graspOf(grasp, contact_point) && grasp->slip_limit > 0)
    force.levels.push_back({grasp->slip_limit, "slip limit " + fixed(grasp->slip_limit, 3) + " N", "limit"});

  svg::Panel state{.title = "Contact state", .height = 84, .names = {"none", "stick", "slip"}};
  state.spans = spans;
  state.series.push_back(
      {"state", "state", column(trace, [&](const auto& s) { return static_cast<double>(finger(s).mode); }), true});
  figure.panels = {std::move(height), std::move(force), std::move(state)};
  return figure;
}

/// What the contact point touched most, if it is an object; without a grasp each finger may touch another one.
static const RunResult::Object* touchedMost(const RunResult& result, std::size_t contact_point) {
  const auto samples = [&](const RunResult::Object& object) {
    return std::ranges::count_if(*result.trace, [&](const TraceSample& sample) {
      const FingerContact& contact = sample.fingers[contact_point];
      return contact.mode != ContactMode::kNone && contact.body == object.body;
    });
  };
  const auto most = std::ranges::max_element(result.objects, {}, samples);
  return most == result.objects.end() || samples(*most) == 0 ? nullptr : &*most;
}

svg::ScatterFigure frictionFigure(const RunResult& result, const std::optional<GraspFigures>& grasp,
                                  std::size_t contact_point) {
  const RunResult::ContactPoint& point = result.contact_points[contact_point];
  svg::ScatterFigure figure;
  figure.title = "Tangential over normal force of " + point.name;
  figure.x_label = "normal force [N]";
  figure.y_label = "tangential force [N]";
  svg::Cloud stick{"stick", "stick", {}}, slip{"slip", "slip", {}};
  const RunResult::Object* object = grasp ? drawnObject(result, grasp) : touchedMost(result, contact_point);
  for (const TraceSample& sample : *result.trace) {
    const FingerContact& contact = sample.fingers[contact_point];
    if (result.stopped_at >= 0 && sample.time >= result.stopped_at) break;
    if (contact.mode == ContactMode::kNone || (object && contact.body != object->body)) continue;
    svg::Cloud& cloud = contact.mode == ContactMode::kSlip ? slip : stick;
    cloud.points.push_back({contact.normal_force, contact.tangential_force_W.norm()});
  }
  figure.clouds = {std::move(stick), std::move(slip)};
  if (object) {
    figure.rays.push_back({"slip line, static friction μₛ = " + significant(object->friction_static, 3), "static",
                           object->friction_static});
    figure.rays.push_back(
        {"dynamic friction μ = " + significant(object->friction_dynamic, 3), "dynamic", object->friction_dynamic});
  }
  if (const FingerGrasp* finger = graspOf(grasp, contact_point); finger && finger->slip) {
    figure.marks.push_back({"last stick before the slip at " + fixed(finger->slip->time, 3) + " s",
                            "onset",
                            {finger->slip->last_stick_normal_force, finger->slip->last_stick_tangential_force}});
  }
  return figure;
}

}  // namespace presa
