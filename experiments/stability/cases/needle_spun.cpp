#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/bodies.h"
#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"

namespace presa::stability::needle_spun {
namespace {

constexpr double kLength = 0.1, kThickness = 0.002;  // [m]
constexpr double kDepth = 0.0005;                    // of each finger [m]
constexpr double kDuration = 10, kHeld = 1;          // [s]
constexpr double kDegree = std::numbers::pi / 180;

struct Spin {
  bool at_ends = false;  ///< held at its ends, spins about its length; else held and spinning across its middle
  double stiffness = 0, rate = 0;
  Method method;

  double width() const { return at_ends ? kLength : kThickness; }
  /// Distance of the fingers' line from the centre [m]; 20 um when the needle spins about its length.
  double offset() const { return at_ends ? 0.00002 : 0.0001; }
  /// Angle of the needle to the fingers' line at the start [deg].
  double tilt() const { return at_ends ? 0.02 : 0.3; }
  std::string size() const {
    return at_ends ? number(kLength) + " " + number(kThickness) + " " + number(kThickness)
                   : number(kThickness) + " " + number(kLength) + " " + number(kThickness);
  }
};

std::vector<Finding> spin(const Spin& trial) {
  const std::vector<std::string> sets{
      "body/needle/haptic/box/size=" + trial.size(), "body/needle/physics/box/size=" + trial.size(),
      "material/skin/stiffness=" + number(trial.stiffness), "body/needle/euler_deg=0 0 " + number(trial.tilt()),
      "body/needle/angular_velocity=" + number(trial.rate) + " 0 0"};
  Pinch pinch;
  pinch.center = {0, trial.offset(), 0};
  pinch.width = trial.width();
  pinch.depth = kDepth;
  StudyRun run(specOf("needle_spun.xml", sets + trial.method, kDuration), pinchFingers(pinch));
  const std::size_t needle = bodyNamed(run.world(), "needle");

  bool held = true;
  double tilt = 0, held_rate = 0, last_rate = 0;
  Curve shown{"tilt", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time < kHeld) return;
    const BodyMotion& motion = sample.objects->bodies[needle];
    const auto& fingers = sample.contact.fingers;
    held = held && fingers[0].mode != ContactMode::kNone && fingers[1].mode != ContactMode::kNone;
    const Vec3 axis = sample.objects->poseAt(static_cast<std::int32_t>(needle), sample.tick.time).q *
                      (fingers[1].p_BP - fingers[0].p_BP);
    const double angle = held ? std::atan2(axis.cross(Vec3::UnitX()).norm(), axis.x()) : std::numbers::pi;
    tilt = std::max(tilt, angle);
    if (held_rate == 0) held_rate = motion.w_WB.x();
    last_rate = motion.w_WB.x();
    shown.x.push_back(sample.tick.time);
    shown.y.push_back(angle / kDegree);
  });
  run.run();

  const double bound = std::atan(2 * trial.offset() / (trial.width() + 2 * pinch.radius)) / kDegree;
  Finding kept = finding("tilt of the axis", tilt / kDegree, "deg", bound,
                         "at most the offset of the grasp at each end: atan(2 offset / (width + 2 radius))");
  kept.plot_x = "time [s]";
  kept.plot_y = "angle between the line of the proxies and that of the fingers [deg]";
  kept.curves.push_back(decimated(std::move(shown)));
  return {kept, finding("spin lost in 9 s", held ? 100 * (last_rate / held_rate - 1) : NAN, "%", 1,
                        "point contacts on the axis transmit no torque about it")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "needle_spun";
  result.title = "A needle of 100 x 2 x 2 mm and 3 g spins between two fingers";
  result.source =
      "Inertia ratio 1 : 1250 under stiff fingers: about its length the needle has 2e-9 kg m^2. Conservation of "
      "angular momentum; geometry of the grasp.";
  result.oracle = "The needle keeps spinning about the line between the fingers, without tilting or slowing down.";
  result.scene = "needle_spun.xml";
  for (const bool at_ends : {false, true}) {
    for (const double stiffness : {2000.0, 10'000.0}) {
      for (const double rate : {10.0, 30.0, 100.0}) {
        for (const Method& method :
             {ours(), explicitCoupling(), Method{"engine's rotation", {"dynamics/rotation=engine"}}}) {
          Trial trial;
          trial.parameters = {{"held", at_ends ? "at its ends" : "across its middle"},
                              {"stiffness", number(stiffness / 1000) + " N/mm"},
                              {"spin", number(rate) + " rad/s"}};
          trial.method = method.name;
          // about the axis of min inertia, 20 um off it, the engine's rotation loses the spin from 30 rad/s on
          const bool lost = at_ends && rate > 20 && !method.own();
          if (lost || method.name == explicitCoupling().name) trial.expected = Verdict::kUnstable;
          trial.run = [spin_trial = Spin{at_ends, stiffness, rate, method}] { return spin(spin_trial); };
          trial.quick = stiffness > 5000 && rate > 20 && rate < 50;
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::needle_spun
