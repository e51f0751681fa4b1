#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/stability/cases.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"

namespace presa::stability::grasp_any_size {
namespace {

constexpr double kDuration = 5;

/// A grasp at a given place and scale.
struct Grasp {
  std::string name;
  double edge = 0, mass = 0, stiffness = 0;
  Vec3 place = Vec3::Zero();
  Method method;
  double scale() const { return edge / 0.07; }
  double depth() const { return 0.002 * scale(); }
};

std::string text(const Vec3& v) {
  char buffer[120];
  std::snprintf(buffer, sizeof buffer, "%.17g %.17g %.17g", v.x(), v.y(), v.z());
  return buffer;
}

std::vector<std::string> setsOf(const Grasp& grasp) {
  const double s = grasp.scale();
  const std::string cube = text(Vec3::Constant(grasp.edge)), radius = number(0.008 * s);
  return {"body/table/pos=" + text(grasp.place + Vec3(0, 0, -0.02 * s)),
          "body/table/physics/box/size=" + text(s * Vec3(0.6, 0.4, 0.04)),
          "body/cube/pos=" + text(grasp.place + Vec3(0, 0, grasp.edge / 2)),
          "body/cube/haptic/box/size=" + cube,
          "body/cube/physics/box/size=" + cube,
          "body/cube/physics/mass=" + number(grasp.mass),
          "material/skin/stiffness=" + number(grasp.stiffness),
          "device/thumb/fingertip_radius=" + radius,
          "device/index/fingertip_radius=" + radius};
}

std::vector<Finding> hold(const Grasp& grasp) {
  const double s = grasp.scale();
  Pinch pinch;
  pinch.center = grasp.place + s * Vec3(0.0001, 0, 0.040);
  pinch.width = grasp.edge;
  pinch.radius = 0.008 * s;
  pinch.depth = grasp.depth();
  pinch.open *= s;
  pinch.lift = 0.03 * s;
  StudyRun run(specOf("grasp_any_size.xml", setsOf(grasp) + grasp.method, kDuration), pinchFingers(pinch));

  const double wanted = grasp.stiffness * pinch.depth;
  double worst = 0, low = HUGE_VAL, high = 0;
  Curve grip{"grip force over k depth", {}, {}};
  run.observe([&](const HapticSample& sample) {
    double mean = 0;
    for (std::size_t f = 0; f < 2; ++f) {
      const double normal = sample.contact.fingers[f].normal_force;
      mean += normal / wanted / 2;
      if (sample.tick.time < kDuration - 1) continue;
      worst = std::max(worst, std::abs(normal / wanted - 1));
      low = std::min(low, normal / wanted);
      high = std::max(high, normal / wanted);
    }
    grip.x.push_back(sample.tick.time);
    grip.y.push_back(mean);
  });
  run.run();

  Finding error = finding("grip force error", 100 * worst, "%", 0.1, "k depth = " + number(wanted) + " N from each");
  error.plot_x = "time [s]";
  error.plot_y = "mean normal force / k depth";
  error.curves.push_back(decimated(std::move(grip)));
  return {error, finding("grip ripple in the last second", low > 0 ? 100 * (high - low) : NAN, "%", 0.1,
                         "ringing decays to nothing")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "grasp_any_size";
  result.title = "The same grasp far away, tiny and huge";
  result.source =
      "Mechanics has no preferred place or length: a result that holds for 70 mm at the origin also holds a kilometre "
      "away, for a millimetre and for ten metres.";
  result.oracle = "Each finger presses with k times its depth, at any place and size.";
  result.scene = "grasp_any_size.xml";
  const Vec3 origin = Vec3::Zero(), far(600, -800, 0);
  for (const Grasp& base :
       {Grasp{"at the origin", 0.07, 0.01, 10'000, origin, {}}, Grasp{"1 km away", 0.07, 0.01, 10'000, far, {}},
        Grasp{"at the origin", 0.001, 1e-6, 4, origin, {}}, Grasp{"1 km away", 0.001, 1e-6, 4, far, {}},
        Grasp{"at the origin", 10, 1000, 3.5e5, origin, {}}}) {
    for (const Method& method : {ours(), explicitCoupling()}) {
      Grasp grasp = base;
      grasp.method = method;
      Trial trial;
      trial.parameters = {{"edge", number(1000 * grasp.edge) + " mm"}, {"place", grasp.name}};
      trial.method = method.name;
      // light bodies explode; the ringing of the heavy one is undamped
      if (!method.own()) trial.expected = Verdict::kUnstable;
      trial.run = [grasp] { return hold(grasp); };
      trial.quick = grasp.edge < 0.01 || grasp.place.x() > 0;
      result.trials.push_back(std::move(trial));
    }
  }
  return result;
}

}  // namespace presa::stability::grasp_any_size
