#include "apps/common/summary.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "apps/common/atomic_file.h"
#include "apps/common/grasp_figures.h"
#include "apps/common/grasp_loop.h"
#include "apps/common/grasp_strength.h"
#include "apps/common/joint_words.h"
#include "apps/common/losses.h"

namespace presa {
namespace {

// keys keep the order in which they are written here
using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;

Json vector(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json durations(const DurationHistogram& histogram) {
  if (histogram.count() == 0) return nullptr;
  const auto us = [](double ns) { return ns / 1000.0; };
  const auto percentile = [&](double q) { return us(static_cast<double>(histogram.percentile(q))); };
  return {{"p50", percentile(0.5)},
          {"p99", percentile(0.99)},
          {"p999", percentile(0.999)},
          {"max", us(static_cast<double>(histogram.max()))},
          {"mean", us(histogram.mean())}};
}

Json rates(const RunResult& result) {
  Json all = Json::object();
  for (const RunResult::Rate& rate : result.rates) {
    const GroupTiming& timing = *rate.timing;
    Json& group = all[toString(rate.group)];
    group["rate_hz"] = rate.rate_hz;
    group["ticks"] = timing.ticks.load();
    group["missed"] = timing.missed.load();
    group["skipped"] = timing.skipped.load();
    group["execution_us"] = durations(timing.execution);
    group["lateness_us"] = durations(timing.lateness);
    group["period_us"] = durations(timing.period);
  }
  return all;
}

Json slipOnset(const SlipOnset& slip) {
  return {{"time_s", slip.time},
          {"normal_force_N", slip.normal_force},
          {"tangential_force_N", slip.tangential_force},
          {"last_stick_normal_force_N", slip.last_stick_normal_force},
          {"last_stick_tangential_force_N", slip.last_stick_tangential_force}};
}

Json reaction(const ActionReaction::Result& result) {
  if (result.windows == 0) return nullptr;  // the finger never held a free body for a tenth of a second
  return {{"worst", result.worst}, {"time_s", result.time}, {"windows", result.windows}};
}

Json timeOrNull(double time) { return time < 0 ? Json(nullptr) : Json(time); }

Json contactPoints(const RunResult& result) {
  Json all = Json::array();
  for (const RunResult::ContactPoint& point : result.contact_points) {
    const FingerSummary& sum = point.summary;
    all.push_back({{"name", point.name},
                   {"seconds", {{"none", sum.seconds[0]}, {"stick", sum.seconds[1]}, {"slip", sum.seconds[2]}}},
                   {"max_normal_force_N", sum.max_normal_force},
                   {"mean_normal_force_N", sum.mean_normal_force},
                   {"max_commanded_force_N", sum.max_commanded_force},
                   {"leaps", sum.leaps},
                   {"pop_through", sum.pop_through},
                   {"first_pop_through_s", timeOrNull(sum.first_pop_through)},
                   {"slip_onsets", sum.slip_onsets},
                   {"impulse_mismatch", reaction(sum.reaction)}});
  }
  return all;
}

Json objects(const RunResult& result) {
  Json all = Json::array();
  for (const RunResult::Object& object : result.objects) {
    const ObjectSummary& sum = object.summary;
    all.push_back({{"name", object.name},
                   {"start_position_m", vector(sum.start)},
                   {"highest_position_m", vector(sum.highest)},
                   {"final_position_m", vector(sum.final)},
                   {"grasped", sum.grasped},
                   {"dropped", sum.dropped},
                   {"lost_at_s", timeOrNull(sum.lost_at)},
                   {"peak_speed_m_s", sum.peak_speed}});
  }
  return all;
}

// Displacements in metres, as all positions here.
Json joints(const JointLog& log) {
  Json all = Json::array();
  for (const Joint& joint : log.scene().joints)
    all.push_back({{"name", joint.name}, {"type", nameOf(joint.type)}, {"positions", Json::array()}});
  for (const JointLog::Position& position : log.positions()) {
    const Joint& joint = log.jointOf(position);
    const bool angle = isAngle(joint, position.axis);
    const double unit = angle ? kDegrees : 1;
    const JointTravel& travel = position.travel;
    const JointAxis axis = position.axis < joint.axes.size() ? joint.axes[position.axis] : JointAxis{};
    all[position.joint]["positions"].push_back({{"unit", angle ? "deg" : "m"},
                                                {"start", unit * travel.start},
                                                {"min", unit * travel.min},
                                                {"max", unit * travel.max},
                                                {"end", unit * travel.end},
                                                {"at_lower_s", axis.lower ? Json(travel.at_lower) : Json(nullptr)},
                                                {"at_upper_s", axis.upper ? Json(travel.at_upper) : Json(nullptr)}});
  }
  return all;
}

Json turn(const GraspTurn& turn) {
  return {{"object_deg", turn.object * kDegrees},
          {"hand_deg", turn.hand * kDegrees},
          {"fingers_sideways_mm", turn.sideways * 1000},
          {"turned_in_grip", turn.objectTurned()},
          {"hand_buckled", turn.handBuckled()}};
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Of each pair of bounds, the one that is on the safe side.
void addStrength(const std::optional<GraspStrength>& strength, Json& json) {
  for (const char* key :
       {"closure", "quality", "quality_at_most", "quality_otherwise", "weakest", "slip_margin", "min_grip_N"})
    json[key] = nullptr;
  if (!strength) return;
  const GraspQuality& quality = strength->quality;
  json["closure"] = toString(quality.closure);
  json["quality"] = quality.epsilon.at_least;
  json["quality_at_most"] = quality.epsilon.at_most;
  if (quality.closure == GraspClosure::kPartial) json["quality_otherwise"] = quality.within_span.at_least;
  json["weakest"] = strength->weakest;
  json["slip_margin"] = finite(strength->slip_margin.at_least);
  json["min_grip_N"] = finite(strength->min_grip.at_most);
}

/// The body as a mass on the springs of the fingers that held it.
void addLoop(const RunResult& result, const GraspFigures& figures, Json& json) {
  json["natural_frequency_hz"] = json["explicit_min_mass_kg"] = nullptr;
  if (!figures.carried) return;
  const auto body = static_cast<std::size_t>(result.objects[figures.object].body);
  const GraspLoop loop = graspLoop(*result.world, body, figures.fingers.size());
  json["natural_frequency_hz"] = loop.naturalFrequency();
  json["explicit_min_mass_kg"] = loop.explicitMinMass(1 / result.world->scene.rates.dynamics);
}

Json grasp(const RunResult& result, const GraspFigures& figures) {
  Json fingers = Json::array();
  for (const FingerGrasp& finger : figures.fingers) {
    fingers.push_back({{"name", result.contact_points[finger.contact_point].name},
                       {"stick_fraction", finger.stick_fraction},
                       {"offset_range_mm", finger.offset_range * 1000},
                       {"mean_normal_force_N", finger.mean_normal_force},
                       {"weight_share", figures.carried ? Json(finger.weight_share) : Json(nullptr)},
                       {"grip_ripple", orNull(finger.grip_ripple)},
                       {"slip_onset", finger.slip ? slipOnset(*finger.slip) : Json(nullptr)},
                       {"slip_known_to_N", finger.slip ? Json(finger.slip_step) : Json(nullptr)}});
  }
  Json json = {{"object", result.objects[figures.object].name},
               {"hold_s", {figures.hold_begin, figures.hold_end}},
               {"release_s", finite(figures.release_begin)},
               {"lift_height_m", figures.lift_height},
               {"held_in_stick_s", figures.held_in_stick},
               {"turn", figures.turn ? turn(*figures.turn) : Json(nullptr)},
               {"slip_limit_N", figures.carried ? Json(figures.slip_limit) : Json(nullptr)}};
  addLoop(result, figures, json);
  addStrength(graspStrength(result, figures), json);
  json["fingers"] = fingers;
  return json;
}

}  // namespace

std::string hashText(std::uint64_t hash) {
  char text[19];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(hash));
  return text;
}

std::string summaryJson(const RunResult& result) {
  Json json;
  json["version"] = result.version;
  json["scene"] = result.world->scene.name;
  json["rig"] = result.world->rig.name;
  json["seed"] = result.seed;
  json["mode"] = result.realtime ? "realtime" : "lockstep";
  json["duration_s"] = result.simulated_seconds;
  json["wall_s"] = result.wall_seconds;
  json["interrupted"] = result.interrupted;
  json["stopped_s"] = timeOrNull(result.stopped_at);
  json["rates"] = rates(result);
  if (result.sharpness) json["window"] = {{"sharpness", *result.sharpness}};
  json["contact_points"] = contactPoints(result);
  json["coverage_lost"] = {{"ticks", result.coverage_lost.count}, {"first_s", timeOrNull(result.coverage_lost.first)}};
  json["objects"] = objects(result);
  for (const RunResult::DrivenFrame& frame : result.frames)
    json["frames"].push_back({{"name", frame.name},
                              {"uses", frame.uses},
                              {"held_up", frame.refusals},
                              {"lost", frame.losses},
                              {"zoom", frame.zoom}});
  if (result.joints != nullptr) json["joints"] = joints(*result.joints);
  for (const ToolSummary& tool : result.tools)
    json["tools"].push_back({{"name", tool.name},
                             {"ticks_in_contact", tool.touched},
                             {"ticks_examined_coarsely", tool.coarse},
                             {"ticks_out_of_balance", tool.late},
                             {"most_points_in_contact", tool.most_points},
                             {"deepest_m", tool.deepest}});
  if (const auto figures = graspFigures(result)) json["grasp"] = grasp(result, *figures);
  if (result.assembly) json["assembly"] = {{"goals", result.assembly->goals}, {"filled", result.assembly->filled}};
  json["solver_fallbacks"] = result.solver_fallbacks;
  const auto known = [](double value) { return std::isnan(value) ? Json() : Json(value); };
  json["energy_created"] = {{"sum_j", known(result.energy_created.sum)},
                            {"worst_step_j", known(result.energy_created.worst_step)}};
  json["stopped_short"] = result.stopped_short;
  if (result.world->scene.dynamics.coupling == DynamicsSettings::Coupling::kHapticRate)
    json["too_many_held"] = result.too_many_held;
  json["far_lag_s"] = result.far_lag;
  json["faults"] = Json::array();
  for (const RunResult::Fault& fault : result.faults)
    json["faults"].push_back({{"time_s", fault.time}, {"what", fault.text}});
  json["warnings"] = lossesOf(result);
  json["load_warnings"] = result.load_warnings;
  json["notes"] = result.notes;
  json["realtime_missing"] = result.realtime_missing;
  if (!result.recording.file.empty()) {
    json["recording"] = {
        {"file", result.recording.file}, {"rows", result.recording.rows}, {"dropped", result.recording.dropped}};
  }
  json["state_hash"] = hashText(result.state_hash);
  // names may come from files in any encoding: replace what is not UTF-8 instead of failing at the end of a run
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeSummary(const RunResult& result, const std::string& path) { writeFileAtomically(path, summaryJson(result)); }

}  // namespace presa
