#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"

namespace presa::stability::peg_in_hole {
namespace {

// as in the scene: half the peg's width, its length, how deep it is in the hole at the start, the depth of the hole [m]
constexpr double kHalf = 0.01, kLength = 0.06, kIn = 0.01, kHole = 0.04;
constexpr double kClearance = 50e-6, kFriction = 0.3, kGravity = 9.81;

/// Gravity across the hole over gravity along it, from which on the peg jams. Inclined, it touches the mouth of the hole
/// on one side (N1) and the wall with its lower end on the other (N2 = N1 - m g_x). The moments about the axis at the
/// mouth are l N2 + r mu m g_x = a m g_x, with the centre of mass at a height a; it slides when m g_z > mu (N1 + N2).
double jamRatio() {
  const double a = kLength / 2 - kIn;
  return 1 / (kFriction * (1 + 2 * (a - kHalf * kFriction) / kIn));
}

/// Pose in which the peg touches both walls, leaning towards +x: X and Z of its middle, and its angle.
struct Leaning {
  double x = 0, z = 0, angle = 0;
};
Leaning leaning() {
  const double wall = kHalf + kClearance / 2;
  Leaning peg;
  double low = 0, high = 2 * kClearance / kIn;
  for (int i = 0; i < 60; ++i) {
    const double angle = (low + high) / 2, s = std::sin(angle), c = std::cos(angle);
    peg = {-wall + kHalf * c + kLength / 2 * s, -kIn - kHalf * s + kLength / 2 * c, angle};
    const double at_mouth = peg.x + kHalf * c + (kHalf * s - peg.z) * std::tan(angle);  // of the other face
    (at_mouth < wall ? low : high) = angle;
  }
  return peg;
}

/// `heading` 0: leaning towards x, 1: towards y.
std::vector<std::string> setsOf(double share, int heading) {
  const double incline = std::atan(share * jamRatio());
  const Vec3 across = kGravity * std::sin(incline) * Vec3::Unit(heading);
  std::vector<std::string> sets{
      "dynamics/sleeping=false",
      "world/gravity=" + number(across.x()) + " " + number(across.y()) + " " + number(-kGravity * std::cos(incline))};
  if (share == 0) return sets;
  const Leaning peg = leaning();
  const Vec3 p = peg.x * Vec3::Unit(heading) + peg.z * Vec3::UnitZ();
  const double degrees = 180 / std::numbers::pi * peg.angle;
  char pose[200];
  std::snprintf(pose, sizeof pose, "body/peg/pos=%.17g %.17g %.17g", p.x(), p.y(), p.z());
  sets.emplace_back(pose);
  std::snprintf(pose, sizeof pose, "body/peg/euler_deg=%.17g %.17g 0", heading == 1 ? -degrees : 0,
                heading == 0 ? degrees : 0);
  sets.emplace_back(pose);
  return sets;
}

std::vector<Finding> slide(double share, int heading, const Method& method) {
  StudyRun run(specOf("peg_in_hole.xml", setsOf(share, heading) + method, share > 1 ? 10 : 2));
  const std::size_t peg = bodyNamed(run.world(), "peg");
  const Vec3 start = run.world().scene.bodies[peg].X_WB.p, g = run.world().scene.gravity;
  double energy = 0, farthest = 0, rise = 0, lowest = 0;
  Curve depth{"depth of the peg", {}, {}};
  run.observe(atEachStep([&](const ObjectState& state) {
    const BodyMotion& body = state.bodies[peg];
    const Vec3 w_B = body.X_WB_end.q.conjugate() * body.w_WB;
    const BodyInertia& inertia = run.world().inertias[peg];
    energy = inertia.mass * (body.v_WB.squaredNorm() / 2 - g.dot(body.X_WB_end.p - start)) +
             w_B.dot(inertia.inertia * w_B) / 2;
    rise = std::max(rise, energy - lowest);
    lowest = std::min(lowest, energy);
    farthest = std::max(farthest, (body.X_WB_end.p - start).norm());
    depth.x.push_back(state.time_end);
    depth.y.push_back(1000 * (kLength / 2 - body.X_WB_end.p.z()));
  }));
  run.run();

  const double released = run.world().inertias[peg].mass * kGravity * (kHole - kIn),
               left = kHole - depth.y.back() / 1000;
  Finding result = share > 1 ? finding("displacement of the jammed peg", 1000 * farthest, "mm", 0.01,
                                       "friction at both points carries it: jams from " + number(jamRatio()) + " on")
                             : finding("hole left below the peg", 1000 * left, "mm", 0.01,
                                       "friction does not carry it: jams from " + number(jamRatio()) + " on");
  result.plot_x = "time [s]";
  result.plot_y = "depth of the peg [mm]";
  result.curves = {decimated(std::move(depth))};
  return {result,
          finding("rise of the energy", 100 * rise / released, "%", 0.1, "walls and friction only take energy")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "peg_in_hole";
  result.title = "A peg of 20 mm slides into a hole with 50 um of clearance, or jams";
  result.source =
      "Jamming of a peg: D. E. Whitney, J. Dyn. Sys. Meas. Control 104 (1982), 65; two opposed contacts of a clearance "
      "far below the contact margins of most engines.";
  result.oracle = "Inclined by less than the jamming angle it slides to the bottom; inclined by more it stays.";
  result.scene = "peg_in_hole.xml";
  for (const double share : {0.0, 0.5, 0.95, 1.05, 2.0}) {
    for (const int heading : {0, 1}) {
      if (share == 0 && heading == 1) continue;
      for (const Method& method : {ours(), twentyIterations()}) {
        Trial trial;
        trial.parameters = {{"inclination over the limit", number(share)},
                            {"towards", std::string(1, "xy"[heading])},
                            {"peg then", share > 1 ? "jams" : "slides in"}};
        trial.method = method.name;
        if (!method.own()) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return slide(share, heading, method); };
        trial.quick = method.own();
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::peg_in_hole
