#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/sliding_tile.h"

namespace presa::stability::coulomb_slide {
namespace {

constexpr double kDuration = 1;
constexpr double kSlope = 40;  // [degrees]
constexpr double kRadian = std::numbers::pi / 180;

struct Start {
  std::string name;
  double down = 0, across = 0;  ///< speed [m/s]
  double spin = 0;              ///< [rad/s]
  double height = 0;            ///< above the slope [m]
};

struct Errors {
  double speed = 0;    ///< relative
  double heading = 0;  ///< [degrees]
};

std::string text(const Vec3& v) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, "%.17g %.17g %.17g", v.x(), v.y(), v.z());
  return buffer;
}

Errors slideTowards(double heading_deg, const Start& start, bool pyramid) {
  const double cos = std::cos(heading_deg * kRadian), sin = std::sin(heading_deg * kRadian);
  const Vec3 downhill(cos, sin, 0);
  SlidingTile::Model model;
  model.gravity = 9.81 * (std::sin(kSlope * kRadian) * downhill - std::cos(kSlope * kRadian) * Vec3::UnitZ());
  const Vec3 v0 = start.down * downhill + start.across * Vec3(-sin, cos, 0);
  SlidingTile reference(model, {v0.head<2>(), 0, start.spin});
  std::vector<std::string> sets{"world/gravity=" + text(model.gravity), "body/tile/velocity=" + text(v0),
                                "body/tile/angular_velocity=" + text(start.spin * Vec3::UnitZ())};
  if (start.height > 0) sets.push_back("body/tile/pos=" + text({0, 0, model.thickness / 2 + start.height}));
  if (pyramid) sets.emplace_back("dynamics/friction=pyramid");
  StudyRun run(specOf("coulomb_slope.xml", sets, kDuration));
  const std::size_t tile = bodyNamed(run.world(), "tile");
  Eigen::Vector2d got = v0.head<2>(), wanted = got;
  run.observe(atEachStep([&](const ObjectState& state) {
    got = state.bodies[tile].v_WB.head<2>();
    wanted = reference.at(state.time_end).v;
  }));
  run.run();
  const double cross = wanted.x() * got.y() - wanted.y() * got.x();
  return {std::abs(got.norm() / wanted.norm() - 1), std::abs(std::atan2(cross, wanted.dot(got))) / kRadian};
}

std::vector<Finding> slide(const Start& start, bool pyramid) {
  Errors worst;
  Curve speed{"speed error", {}, {}}, heading{"heading error", {}, {}};
  for (double towards = 0; towards <= 90; towards += 7.5) {
    const Errors errors = slideTowards(towards, start, pyramid);
    worst = {std::max(worst.speed, errors.speed), std::max(worst.heading, errors.heading)};
    speed.x.push_back(towards);
    speed.y.push_back(100 * errors.speed);
    heading.x.push_back(towards);
    heading.y.push_back(errors.heading);
  }
  const std::string oracle = "tile on four corners, Runge-Kutta in steps of 0.1 ms";
  Finding of_speed = finding("speed error, worst of 13 headings", 100 * worst.speed, "%", 0.5, oracle);
  of_speed.plot_x = "direction downhill [degrees]";
  of_speed.plot_y = "speed error [%]";
  of_speed.curves.push_back(std::move(speed));
  Finding of_heading = finding("heading error, worst of 13 headings", worst.heading, "degrees", 0.2, oracle);
  of_heading.plot_x = "direction downhill [degrees]";
  of_heading.plot_y = "heading error [degrees]";
  of_heading.curves.push_back(std::move(heading));
  return {of_speed, of_heading};
}

}  // namespace

Case make() {
  Case result;
  result.name = "coulomb_slide";
  result.title = "A tile slides down a slope, in every direction";
  result.source =
      "Coulomb's law on an incline of 40 degrees with friction 0.5; a pyramid for the cone is up to 41 % "
      "too strong between its axes.";
  result.oracle =
      "A fine integration of the same tile, for every heading from 0 to 90 degrees in steps of 7.5, after one second.";
  result.scene = "coulomb_slope.xml";
  // a drop ends in an impact whose friction makes up for that missing in flight, so the final speed is the same
  const std::vector<Start> starts{{"at rest", 0, 0, 0, 0},
                                  {"1.5 m/s across", 0, 1.5, 0, 0},
                                  {"spinning 20 rad/s", 0, 0, 20, 0},
                                  {"1 m/s downhill, dropped by 1 mm", 1, 0, 0, 1e-3}};
  for (const Start& start : starts) {
    for (const bool pyramid : {false, true}) {
      Trial trial;
      trial.parameters = {{"start", start.name}};
      trial.method = pyramid ? "pyramid friction" : kPresa;
      if (pyramid) trial.expected = Verdict::kUnstable;
      trial.run = [=] { return slide(start, pyramid); };
      trial.quick = start.height == 0;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::coulomb_slide
