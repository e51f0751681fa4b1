#include <cmath>

#include "devices/percro_arm/bench.h"
#include "devices/percro_arm/characterise.h"
#include "devices/percro_arm/reach.h"
#include "devices/percro_arm/steps.h"

namespace presa::percro {
namespace {

constexpr double kMm = 1e3;

/// Boundary of the reach in the plane of x and one angle of this range, for axes at x0, facing `side`. In mm.
PlotLine edgeOf(const Geometry& g, double range, double x0, double side, int color, const std::string& label) {
  PlotLine line{.label = label, .color = color};
  const auto add = [&](double length, double angle) {
    line.x.push_back(kMm * (x0 + side * length * std::cos(angle)));
    line.y.push_back(kMm * length * std::sin(angle));
  };
  for (const double angle : steps(-range, range, 60)) add(g.length_max, angle);
  for (const double angle : steps(range, -range, 60)) add(g.length_min, angle);
  add(g.length_max, -range);
  return line;
}

PlotLine rectangle(double x_low, double x_high, double half, const std::string& label, bool dashed) {
  return {.label = label,
          .x = {kMm * x_low, kMm * x_high, kMm * x_high, kMm * x_low, kMm * x_low},
          .y = {-kMm * half, -kMm * half, kMm * half, kMm * half, -kMm * half},
          .color = -1,
          .dashed = dashed};
}

/// Condition number over x and y (or z) within the reach.
PlotMap conditionOver(const Geometry& g, const Vec3& second) {
  PlotMap map{
      .x = steps(0.3, 1.1, 160), .y = steps(-0.8, 0.8, 320), .z = {}, .levels = {1.05, 1.1, 1.2, 1.3, 1.4, 1.5}};
  for (const double y : map.y) {
    for (const double x : map.x) {
      const Joints q = jointsAt(g, x * Vec3::UnitX() + y * second);
      map.z.push_back(withinReach(g, q) ? conditionNumber(g, q) : Characteristic::kNone);
    }
  }
  for (double& x : map.x) x *= kMm;
  for (double& y : map.y) y *= kMm;
  return map;
}

DevicePlot conditioning(const Geometry& g) {
  DevicePlot plot{
      .name = "conditioning",
      .title = "Condition number of J K^-1 (figure 2)",
      .caption =
          "Best, 1, where the barrel's drum moves the tip as far as the differential does: at L = 687 mm. In the "
          "plane of the tilt it depends on L alone; yaw moves the tip closer to the tilt axis.",
      .x_label = "x [mm]",
      .y_label = "y, z [mm]",
      .equal_scales = true};
  plot.panels.push_back(
      {"plane XY (tilt)", {edgeOf(g, g.tilt_range, 0, 1, -1, "reach")}, conditionOver(g, Vec3::UnitY())});
  plot.panels.push_back({"plane XZ (yaw)", {edgeOf(g, g.yaw_range, 0, 1, -1, "")}, conditionOver(g, Vec3::UnitZ())});
  return plot;
}

DevicePlot workspace(const Geometry& g) {
  DevicePlot plot{
      .name = "workspace",
      .title = "Reach of two arms that face each other (figure 3)",
      .caption =
          "Axes 1.5 m apart, as in the shipped rig: the paper prints no distance. Dashed: 300 x 400 x 600 mm with 300 "
          "mm "
          "along the barrels, in the reach of both. With 600 mm along the barrel the box fits one arm exactly.",
      .x_label = "x [mm]",
      .y_label = "y, z [mm]",
      .equal_scales = true};
  const double middle = 0.5 * kArmsApart;
  for (const bool tilt : {true, false}) {
    const double range = tilt ? g.tilt_range : g.yaw_range;
    plot.panels.push_back(
        {tilt ? "plane XY (tilt)" : "plane XZ (yaw)",
         {edgeOf(g, range, 0, 1, 0, tilt ? "thumb's arm" : ""),
          edgeOf(g, range, kArmsApart, -1, 1, tilt ? "index's arm" : ""),
          rectangle(middle - 0.15, middle + 0.15, tilt ? 0.2 : 0.3, tilt ? "300 x 400 x 600 mm" : "", true),
          rectangle(g.length_min, g.length_min + 0.5994, tilt ? 0.15 : 0.2, tilt ? "600 mm along the barrel" : "",
                    false)}});
  }
  return plot;
}

DevicePlot resolution(const Parameters& p) {
  PlotLine across{.label = "across: both encoders step"}, along{.label = "along the barrel", .color = 1};
  for (const double length : steps(p.geometry.length_min, p.geometry.length_max, 40)) {
    across.x.push_back(kMm * length), across.y.push_back(1e6 * transverseStep(p, length));
    along.x.push_back(kMm * length), along.y.push_back(1e6 * axialStep(p));
  }
  const PlotLine paper{.label = "paper",
                       .x = {kMm * p.geometry.length_min, kMm * p.geometry.length_max},
                       .y = {1e6 * printed::kStepShort, 1e6 * printed::kStepLong},
                       .color = 3,
                       .symbols = true};
  return {.name = "resolution",
          .title = "Step of the position",
          .caption = "4000 counts a turn. The step across grows with the length; the printed pair does not quite.",
          .x_label = "length L [mm]",
          .y_label = "step [um]",
          .panels = {{"", {across, along, paper}}},
          .y_from_zero = true};
}

DevicePlot bandwidth(const Parameters& p) {
  const std::vector<double> frequencies = steps(2, 160, 79);
  const ForceResponse response = forceResponse(p, frequencies);
  PlotLine linear{.label = "linear, closed form", .x = frequencies, .color = 1, .dashed = true};
  for (const double f : frequencies) linear.y.push_back(linearGain(p, f));
  const double low = response.gain_db.back(), high = response.peak_db;
  const double limit = response.gain_db.front() - 3;
  std::vector<PlotLine> lines{{.label = "bolted arm", .x = frequencies, .y = response.gain_db},
                              linear,
                              {.label = "-3 dB", .x = {2, 160}, .y = {limit, limit}, .color = -1, .dashed = true}};
  for (const double edge : {printed::kBandwidthLow, printed::kBandwidthHigh})
    lines.push_back({.label = edge == printed::kBandwidthLow ? "paper: 70 to 80 Hz" : "",
                     .x = {edge, edge},
                     .y = {low, high},
                     .color = 3});
  return {.name = "bandwidth",
          .title = "Force at the bolted tip over the commanded force, along the barrel (figure 5)",
          .caption =
              "2 N about 3 N. Motors' lag 500 Hz, moving mass on 23.74 N/mm, dry friction 0.2 N; damping 0.1 of "
              "critical is a guess "
              "and makes the peak.",
          .x_label = "frequency [Hz]",
          .y_label = "gain [dB]",
          .panels = {{"", lines}}};
}

DevicePlot compliance(const Parameters& p) {
  PlotLine law{.label = "a1 L + a3 L^3"},
      measured{.label = "pushed to 4 N, by the encoders", .color = 1, .symbols = true};
  for (const double length : steps(p.geometry.length_min, p.geometry.length_max, 60))
    law.x.push_back(kMm * length), law.y.push_back(kMm * p.structure.compliance(length));
  for (const double length : steps(p.geometry.length_min + 1e-3, p.geometry.length_max - 1e-3, 12))
    measured.x.push_back(kMm * length), measured.y.push_back(kMm / push(p, length, Vec3::UnitY(), 4).stiffness);
  const PlotLine paper{.label = "paper: 13.5 and 1.5 N/mm",
                       .x = {kMm * p.geometry.length_min, kMm * p.geometry.length_max},
                       .y = {kMm / printed::kStiffShort, kMm / printed::kStiffLong},
                       .color = 3,
                       .symbols = true};
  return {.name = "compliance",
          .title = "Compliance across the barrel (figure 6)",
          .caption =
              "The paper's law, its two coefficients from the two stiffnesses that are printed. A spring at the joints "
              "would give "
              "L^2 in place of L: at most 5 % different between these ends.",
          .x_label = "length L [mm]",
          .y_label = "compliance [mm/N]",
          .panels = {{"", {law, measured, paper}}},
          .y_from_zero = true};
}

DevicePlot force(const Parameters& p) {
  PlotLine steady{.label = "continuous"}, peak{.label = "peak", .color = 1};
  for (const double length : steps(p.geometry.length_min, p.geometry.length_max, 60)) {
    const Joints q{0, 0, length - p.geometry.length_min};
    steady.x.push_back(kMm * length), peak.x.push_back(kMm * length);
    steady.y.push_back(forceInAllDirections(p, q, p.motors.continuous_torque));
    peak.y.push_back(forceInAllDirections(p, q, p.motors.peak_torque));
  }
  const PlotLine paper{.label = "paper, worst case",
                       .x = {kMm * p.geometry.length_max, kMm * p.geometry.length_max},
                       .y = {printed::kContinuousForce, printed::kPeakForce},
                       .color = 3,
                       .symbols = true};
  return {.name = "force",
          .title = "Force in every direction",
          .caption =
              "Beside carrying the arm. Drawn in, the barrel's motor limits; drawn out, those of the differential, "
              "where the "
              "counterweight leaves them nothing else to do.",
          .x_label = "length L [mm]",
          .y_label = "force [N]",
          .panels = {{"", {steady, peak, paper}}},
          .y_from_zero = true};
}

DevicePlot wall(const Parameters& p) {
  constexpr double kHand = 5;  // [N s/m]
  std::vector<PlotLine> lines;
  const auto add = [&](const std::string& label, double length, const Vec3& direction) {
    PlotLine line{.label = label, .color = static_cast<int>(lines.size())};
    for (const double stiffness : steps(1, 20, 19)) {
      line.x.push_back(stiffness);
      line.y.push_back(kMm * wallShake(p, length, direction, 1e3 * stiffness, kHand));
    }
    lines.push_back(line);
  };
  add("along", 0.75, Vec3::UnitX());
  for (const double length : {0.5, 0.75, 1.0}) {
    const std::string millimetres = std::to_string(static_cast<int>(kMm * length));
    add("across, L = " + millimetres, length, Vec3::UnitY());
  }
  return {
      .name = "wall",
      .title = "How a virtual wall shakes",
      .caption =
          "A hand (0.1 kg, 300 N/m, 5 N s/m: a guess) leans on it with 3 N; motion of the tip from 3 to 4 s. Nothing "
          "of the kind is printed. The paper's study goes up to 2 N/mm. Drawn out, the bending barrel limits.",
      .x_label = "stiffness of the wall [N/mm]",
      .y_label = "to and fro [mm]",
      .panels = {{"", lines}},
      .y_from_zero = true};
}

}  // namespace

std::vector<DevicePlot> plots(const Parameters& p) {
  return {
      conditioning(p.geometry), workspace(p.geometry), bandwidth(p), compliance(p), resolution(p), force(p), wall(p)};
}

}  // namespace presa::percro
