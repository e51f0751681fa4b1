#include "apps/common/report/tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/common/machine.h"
#include "apps/common/number_text.h"
#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/summary.h"
#include "apps/common/version.h"

namespace presa::html {
namespace {

using svg::escape;

std::string count(std::uint64_t value) { return std::to_string(value); }

std::string tile(const std::string& label, const std::string& value) {
  return "<div class=\"tile\"><span>" + label + "</span><strong>" + value + "</strong></div>\n";
}

std::string position(const Vec3& p) { return fixed(p.x(), 4) + ", " + fixed(p.y(), 4) + ", " + fixed(p.z(), 4); }

/// p50, p99, p99.9 and largest, in microseconds.
std::vector<std::string> percentiles(const DurationHistogram& histogram) {
  if (histogram.count() == 0) return std::vector<std::string>(4, "–");
  const auto us = [](std::int64_t ns) { return fixed(static_cast<double>(ns) / 1000, 1); };
  return {us(histogram.percentile(0.5)), us(histogram.percentile(0.99)), us(histogram.percentile(0.999)),
          us(histogram.max())};
}

}  // namespace

std::string graspTiles(const GraspFigures& grasp) {
  double offset = 0, ripple = 0;
  for (const FingerGrasp& finger : grasp.fingers) {
    offset = std::max(offset, finger.offset_range);
    ripple = std::max(ripple, finger.grip_ripple.value_or(0));
  }
  return "<div class=\"tiles\">\n" + tile("lifted by", fixed(grasp.lift_height * 1000, 1) + " mm") +
         tile("held in stick", fixed(grasp.held_in_stick, 2) + " s") +
         tile("offset constant to", fixed(offset * 1000, 3) + " mm") +
         tile("grip ripple", fixed(ripple * 100, 2) + " %") +
         (grasp.slip_limit > 0 ? tile("slip limit m g / (" + std::to_string(grasp.fingers.size()) + " μₛ)",
                                      fixed(grasp.slip_limit, 3) + " N")
                               : std::string{}) +
         "</div>\n";
}

std::string graspTable(const RunResult& result, const GraspFigures& grasp) {
  std::string rows;
  for (const FingerGrasp& finger : grasp.fingers) {
    const auto& slip = finger.slip;
    rows += row({escape(result.contact_points[finger.contact_point].name), fixed(finger.stick_fraction * 100, 1),
                 fixed(finger.offset_range * 1000, 4), fixed(finger.mean_normal_force, 3),
                 grasp.carried ? fixed(finger.weight_share * 100, 1) : "–",
                 finger.grip_ripple ? fixed(*finger.grip_ripple * 100, 3) : "–", slip ? fixed(slip->time, 3) : "–",
                 slip ? fixed(slip->normal_force, 4) : "–",
                 slip && grasp.slip_limit > 0 ? fixed((slip->normal_force / grasp.slip_limit - 1) * 100, 1) : "–"});
  }
  return table({"contact point", "in stick [%]", "offset range [mm]", "mean grip rendered [N]", "share of weight [%]",
                "ripple [%]", "slip at [s]", "grip at slip [N]", "against limit [%]"},
               rows);
}

std::string contactTable(const RunResult& result) {
  std::string rows;
  for (const RunResult::ContactPoint& point : result.contact_points) {
    const FingerSummary& sum = point.summary;
    rows += row({escape(point.name), fixed(sum.seconds[0], 3), fixed(sum.seconds[1], 3), fixed(sum.seconds[2], 3),
                 fixed(sum.mean_normal_force, 3), fixed(sum.max_normal_force, 3), fixed(sum.max_commanded_force, 3),
                 count(sum.slip_onsets), count(sum.leaps), count(sum.pop_through),
                 sum.reaction.windows == 0 ? "–" : fixed(100 * sum.reaction.worst, 2) + " %"});
  }
  return table(
      {"contact point", "none [s]", "stick [s]", "slip [s]", "mean normal rendered [N]", "max normal rendered [N]",
       "max commanded [N]", "slip onsets", "out of folds", "pop-through", "impulse mismatch in any 0.1 s"},
      rows);
}

std::string toolTable(const RunResult& result) {
  std::string rows;
  for (const ToolSummary& tool : result.tools)
    rows += row({escape(tool.name), count(tool.touched), fixed(tool.deepest * 1000, 4), count(tool.most_points),
                 count(tool.coarse), count(tool.late)});
  return table({"tool", "ticks in contact", "deepest [mm]", "most points in contact", "ticks examined coarsely",
                "ticks out of balance"},
               rows);
}

std::string objectTable(const RunResult& result) {
  std::string rows;
  for (const RunResult::Object& object : result.objects) {
    const ObjectSummary& sum = object.summary;
    const std::string lost = sum.lost_at < 0 ? "–" : fixed(sum.lost_at, 3);
    rows += row({escape(object.name), fixed(object.mass, 4), position(sum.start), position(sum.highest),
                 position(sum.final), fixed(sum.peak_speed, 3), sum.grasped ? "yes" : "no", lost,
                 sum.dropped ? "yes" : "no"});
  }
  return table({"object", "mass [kg]", "start [m]", "highest [m]", "final [m]", "peak speed [m/s]", "grasped",
                "lost at [s]", "dropped"},
               rows);
}

std::string rateTable(const RunResult& result) {
  std::string rows;
  for (const RunResult::Rate& rate : result.rates) {
    const GroupTiming& timing = *rate.timing;
    const auto add = [&](const std::string& what, const DurationHistogram& histogram, bool first) {
      std::vector<std::string> cells =
          first ? std::vector<std::string>{toString(rate.group), fixed(rate.rate_hz, 0), count(timing.ticks),
                                           count(timing.missed), count(timing.skipped)}
                : std::vector<std::string>(5);
      cells.push_back(what);
      for (const std::string& cell : percentiles(histogram)) cells.push_back(cell);
      rows += row(cells);
    };
    add("execution", timing.execution, true);
    if (!result.realtime) continue;
    add("period", timing.period, false);
    add("lateness", timing.lateness, false);
  }
  std::string out =
      table({"group", "rate [Hz]", "ticks", "late", "given up", "[µs]", "p50", "p99", "p99.9", "max"}, rows);
  out += result.realtime ? "<p class=\"caption\">Late: ticks that began more than one period after their deadline. "
                           "Given up: ticks skipped after a "
                           "stall too long to catch up.</p>\n"
                         : "<p class=\"caption\">Lockstep runs in virtual time: there is no deadline, so period and "
                           "lateness do not exist.</p>\n";
  for (const std::string& missing : result.realtime_missing) out += "<p class=\"fault\">" + escape(missing) + "</p>\n";
  return out;
}

std::string faultsAndNotes(const RunResult& result) {
  std::string out;
  if (result.faults.empty()) {
    out += "<p>No faults.</p>\n";
  } else {
    out += "<ul>\n";
    for (const RunResult::Fault& fault : result.faults) {
      out += "<li class=\"fault\">" + fixed(fault.time, 3) + " s: " + escape(fault.text) + "</li>\n";
    }
    out += "</ul>\n";
  }
  if (result.notes.empty()) return out;
  out += "<ul>\n";
  for (const std::string& note : result.notes) out += "<li>" + escape(note) + "</li>\n";
  return out + "</ul>\n";
}

std::string provenance(const RunResult& result) {
  const World& world = *result.world;
  const auto named = [](const std::string& name, const std::string& file) {
    return escape(name) + (file.empty() ? "" : " <code>" + escape(file) + "</code>");
  };
  std::string rows =
      row({"scene", named(world.scene.name, world.scene.file)}) +
      (world.rig.name.empty() ? "" : row({"rig", named(world.rig.name, world.rig.file)})) +
      row({"mode", result.realtime ? "real time" : "lockstep"}) + row({"seed", std::to_string(result.seed)}) +
      row({"simulated",
           fixed(result.simulated_seconds, 3) + " s in " + fixed(result.wall_seconds, 3) + " s of wall time"}) +
      row({"state hash", "<code>" + hashText(result.state_hash) + "</code>"}) +
      row({"Presa version", escape(versionText(result.version))}) + row({"machine", escape(machineLine())});
  if (!result.started.empty()) rows = row({"started", escape(result.started)}) + rows;
  if (!result.recording.file.empty()) {
    rows += row({"recording", "<code>" + escape(result.recording.file) + "</code>, " + count(result.recording.rows) +
                                  " rows, " + count(result.recording.dropped) + " dropped"});
  }
  std::string out = "<div class=\"scroll\"><table class=\"facts\"><tbody>\n" + rows + "</tbody></table></div>\n";
  if (!result.command.empty())
    out += "<h3>Repeat this run</h3>\n<pre><code>" + escape(result.command) + "</code></pre>\n";
  return out;
}

}  // namespace presa::html
