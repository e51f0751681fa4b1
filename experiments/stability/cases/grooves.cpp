#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/folder.h"
#include "experiments/stability/polyhedra.h"
#include "framework/geometry/rotation_between.h"

namespace presa::stability::grooves {
namespace {

constexpr double kDuration = 4;
constexpr double kRadius = 0.001;    // of the fingertip, as in the scene [m]
constexpr double kStiffness = 1000;  // as in the scene [N/m]
constexpr double kPress = 0.002;     // how far the finger's target lies below the bottom of a hollow [m]
constexpr double kSway = 0.003;      // lateral amplitude there [m]
constexpr double kNear = 0.75;       // distance of the finger's target from a convex body, in radii
constexpr double kArrived = 0.5;     // [s]

/// The planes that bound the free space of the fingertip's centre in a hollow.
std::vector<Plane> movedIn(std::vector<Plane> planes) {
  for (Plane& plane : planes) plane.offset += kRadius;
  return planes;
}

/// Exact force on a fingertip whose centre is at p: k times the vector to the nearest place where it fits.
Vec3 exactForce(const Solid& solid, const std::vector<Plane>& free, const Vec3& p) {
  if (solid.hollow) return kStiffness * (nearestInAll(free, p) - p);
  const Vec3 away = p - nearestInAll(solid.planes, p);
  const double distance = away.norm();
  return distance < kRadius ? Vec3(kStiffness * (kRadius - distance) / distance * away) : Vec3(Vec3::Zero());
}

/// Target path. In a hollow: down and from wall to wall below the bottom. Around a convex body: over and around its
/// feature, at a distance at which the fingertip would overlap it by a quarter of its radius.
Vec3 wayOver(const Solid& solid, const std::vector<Plane>& free, double time) {
  const double in = ramp(time, 0.05, kArrived).value, moved = std::max(0.0, time - kArrived) * 2 * std::numbers::pi;
  const double sway = ramp(time, kArrived, kArrived + 0.3).value;
  if (solid.hollow) {
    const Vec3 bottom = nearestInAll(free, solid.feature - Vec3(0, 0, 1));
    const Vec3 aside(kSway * std::sin(moved), 2 * kSway * std::sin(0.37 * moved), 0);
    return bottom + sway * aside + Vec3(0, 0, 0.01 * (1 - in) - kPress * in);
  }
  const double polar = 0.1 + sway * (0.9 - 0.9 * std::cos(0.8 * moved)), around = 0.3 + 0.55 * moved;
  const Vec3 direction(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
  const Vec3 far = solid.feature + 0.01 * (rotationBetween(Vec3::UnitZ(), solid.outward) * direction),
             on = nearestInAll(solid.planes, far);
  return on + (2 - (2 - kNear) * in) * kRadius * (far - on).normalized();
}

/// The larger value; NaN counts as infinite.
double larger(double a, double b) {
  return std::isfinite(b) ? std::max(a, b) : std::numeric_limits<double>::infinity();
}

std::vector<Finding> drag(const Solid& solid, bool penalty) {
  const Folder folder("grooves");
  const std::string mesh = folder.file("solid.obj");
  writeObj(solid, mesh);
  const std::vector<Plane> free = movedIn(solid.planes);
  const auto way = [&](double time) { return wayOver(solid, free, time); };
  DeviceList devices;
  devices.push_back(std::make_unique<PrescribedFinger>([&](double time) {
    constexpr double kSmall = 1e-5;  // [s]
    return PrescribedFinger::State{way(time), (way(time + kSmall) - way(time - kSmall)) / (2 * kSmall)};
  }));
  std::vector<std::string> sets{"body/block/haptic/mesh/file=" + mesh};
  if (penalty) sets.emplace_back("haptics/renderer=penalty");
  StudyRun run(specOf("grooves.xml", sets, kDuration), std::move(devices));

  double worst = 0, jump = 0;
  std::uint32_t popped = 0;
  Vec3 last_force = Vec3::Zero(), last_p = way(0);
  Curve rendered{"rendered", {}, {}}, exact{"exact", {}, {}};
  run.observe([&](const HapticSample& sample) {
    const FingerContact& contact = sample.contact.fingers[0];
    const Vec3 &force = contact.f_H_W, wanted = exactForce(solid, free, contact.p_WH);
    worst = larger(worst, (force - wanted).norm());
    jump = larger(jump, (force - last_force).norm() - kStiffness * (contact.p_WH - last_p).norm());
    last_force = force;
    last_p = contact.p_WH;
    popped = sample.contact.pop_through;
    rendered.x.push_back(sample.tick.time);
    rendered.y.push_back(force.x());
    exact.x.push_back(sample.tick.time);
    exact.y.push_back(wanted.x());
  });
  run.run();

  Finding error = finding("force error", 1000 * worst, "mN", 1, "k times the way to where the fingertip just fits");
  error.plot_x = "time [s]";
  error.plot_y = "force to the side [N]";
  error.curves = {decimated(std::move(rendered)), decimated(std::move(exact))};
  return {error,
          finding("force step beyond that of the finger", 1000 * jump, "mN", 1,
                  "no more than k times the finger's step: nearest points of convex sets do not spread"),
          finding("surfaces passed", popped, "", 0, "none")};
}

struct Named {
  std::string name;
  Solid solid;
};

std::vector<Named> solids() {
  std::vector<Named> all;
  for (const double angle : {5.0, 10.0, 20.0, 45.0, 90.0, 120.0, 150.0, 170.0}) {
    const double depth = std::min(0.03, 0.02 / std::tan(angle / 2 * std::numbers::pi / 180));
    all.push_back({"groove of " + number(angle) + " degrees", grooved(angle, depth)});
  }
  all.push_back({"corner of a cube", pitted(3, 0.02 / std::numbers::sqrt2, 0.02)});
  all.push_back({"pit of 4 walls", pitted(4, 0.01, 0.02)});
  all.push_back({"pit of 12 walls", pitted(12, 0.02, 0.01)});
  all.push_back({"outer corner", striped({0.02}, 0.04)});
  all.push_back({"needle of 60 x 2 mm", needle(0.06, 0.001)});
  all.push_back({"slivers of 40 mm x 10 um", striped({2e-3, 10e-6, 10e-6, 10e-6}, 0.04)});
  return all;
}

}  // namespace

Case make() {
  Case result;
  result.name = "grooves";
  result.title = "A finger is dragged through grooves, corners, over needles and slivers";
  result.source =
      "Geometry on which proxies chatter, stick or fall through: acute grooves, many walls in one point, "
      "triangles without width.";
  result.oracle = "The nearest point to the finger at which the fingertip fits, found by testing every set of planes.";
  result.scene = "grooves.xml";
  for (const Named& named : solids()) {
    for (const bool penalty : {false, true}) {
      Trial trial;
      trial.parameters = {{"shape", named.name}};
      trial.method = penalty ? "penalty" : kPresa;
      if (penalty && named.solid.hollow) trial.expected = Verdict::kUnstable;  // exact outside a convex body
      trial.run = [=] { return drag(named.solid, penalty); };
      trial.quick = true;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::grooves
