#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/grip.h"
#include "experiments/stability/methods.h"

namespace presa::stability::peg_in_hole {
namespace {

// as in the scene: half the peg's width, its length, how deep it is in the hole at the start, the depth of the hole [m]
constexpr double kHalf = 0.01, kLength = 0.06, kIn = 0.01, kHole = 0.04;
constexpr double kClearance = 50e-6, kFriction = 0.3, kGravity = 9.81;

/// Gravity across the hole over gravity along it, from which on the peg jams. Inclined, it touches the mouth of the
/// hole on one side (N1) and the wall with its lower end on the other (N2 = N1 - m g_x). The moments about the axis at
/// the mouth are l N2 + r mu m g_x = a m g_x, with the centre of mass at a height a; it slides when m g_z > mu (N1 +
/// N2).
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

/// Energy of a push from rest to rest: the work of the fingertips goes into their springs or is lost in friction.
class PushLedger {
 public:
  explicit PushLedger(double stiffness) : stiffness_(stiffness) {}
  void see(const HapticSample& sample) {
    const bool first = tip_.empty();
    if (first) {
      tip_.resize(2);
      force_.resize(2);
    }
    stored_ = 0;
    for (std::size_t f = 0; f < 2; ++f) {
      const FingerContact& contact = sample.contact.fingers[f];
      stored_ += stiffness_ * (contact.p_WP - contact.p_WH).squaredNorm() / 2;
      // a spring's work over a tick is that of its mean force
      if (!first) work_ -= (force_[f] + contact.f_H_W).dot(contact.p_WH - tip_[f]) / 2;
      force_[f] = contact.f_H_W;
      tip_[f] = contact.p_WH;
    }
    if (first) stored_first_ = stored_;
  }
  /// Energy in the springs beyond the work [J].
  double created() const { return std::max(0.0, stored_ - stored_first_ - work_); }

 private:
  double stiffness_, work_ = 0, stored_ = 0, stored_first_ = 0;
  std::vector<Vec3> force_, tip_;
};

/// Without gravity two fingertips hold the peg 40 mm above the mouth, move `aside` [m] and push it in. Fingers and peg
/// rub with friction 1.
std::vector<Finding> push(double aside, double stiffness, const Method& method) {
  constexpr double kWay = kHole - kIn, kYield = 2.5e-6;  // of a contact [m/N]
  Grip grip;
  grip.lift = 0;
  for (const double side : {-1.0, 1.0}) {
    grip.points.emplace_back(side * kHalf, 0, 0.04);
    grip.normals.emplace_back(side * Vec3::UnitX());
  }
  grip.move = [aside](std::size_t, double time) {
    const Ramp over = ramp(time, 0, 0.3), down = ramp(time, 0.4, 2.4);
    return PrescribedFinger::State{Vec3(0, aside * over.value, -kWay * down.value),
                                   Vec3(0, aside * over.rate, -kWay * down.rate)};
  };
  const std::vector<std::string> sets{"material/skin/stiffness=" + number(stiffness)};
  StudyRun run(specOf("peg_pushed.xml", sets + method, Grip::kMoveBegin + 3), gripFingers(grip));
  const std::size_t peg = bodyNamed(run.world(), "peg");
  PushLedger ledger(stiffness);
  double left = NAN;
  Curve depth{"depth of the peg", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time >= Grip::kMoveBegin) ledger.see(sample);
    const double now = kLength / 2 - sample.objects->bodies[peg].X_WB_end.p.z();
    left = kHole - now;
    depth.x.push_back(sample.tick.time);
    depth.y.push_back(1000 * now);
  });
  run.run();

  // at the end: friction of N1 + N2 by the springs that are aside, with the fingers 10 mm above the mouth
  const double across = 2 * stiffness * aside, height = 0.04 - kWay;
  const double friction = kFriction * across * (1 + 2 * (height - kHalf * kFriction) / kHole);
  Finding result = finding("depth beside that of the hand", 1e6 * std::abs(left), "um",
                           1e6 * (friction / (2 * stiffness) + kYield), "two springs push: friction over 2 k");
  result.plot_x = "time [s]";
  result.plot_y = "depth of the peg [mm]";
  result.curves = {decimated(std::move(depth))};
  return {result, finding("energy from nothing", 100 * ledger.created() / (stiffness * grip.depth * grip.depth), "%",
                          0.1, "beyond the work of the hand; in relation to the energy of the squeezed springs")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "peg_in_hole";
  result.title = "A peg of 20 mm slides into a hole with 50 um of clearance, or jams";
  result.source =
      "Jamming of a peg: D. E. Whitney, J. Dyn. Sys. Meas. Control 104 (1982), 65; two opposed contacts of a "
      "clearance far below the contact margins of most engines.";
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
  for (const double stiffness : {2000.0, 10'000.0}) {
    for (const double aside : {0.0, 0.0001, 0.0003}) {
      for (const Method& method : {ours(), explicitCoupling()}) {
        Trial trial;
        trial.parameters = {{"pushed beside the hole by", number(1000 * aside) + " mm"},
                            {"stiffness", number(stiffness / 1000) + " N/mm"}};
        trial.method = method.name;
        // explicit coupling holds 50 g on soft springs
        if (!method.own() && stiffness > 5000) trial.expected = Verdict::kUnstable;
        trial.run = [=] { return push(aside, stiffness, method); };
        trial.quick = method.own() && aside > 0;
        result.trials.push_back(std::move(trial));
      }
    }
  }
  return result;
}

}  // namespace presa::stability::peg_in_hole
