#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "experiments/stability/bodies.h"
#include "experiments/stability/grip.h"
#include "experiments/study/study_run.h"

// Two fingers pull a door by its knob into the stop of its hinge, as the case drawer_stop does with a slider.
namespace presa::stability {
namespace {

constexpr double kArm = 0.25, kStop = 0.2, kBeyond = 0.032;  // hinge to knob [m]; stop, pulled beyond it [rad]
struct Pulled {
  double step = 0, beyond = 0, left = 0;  // of a finger's force in a tick [N]; of the knob's way [m]
};

/// The hand pulls at `speed` along the knob's circle until it is kBeyond past the stop.
Pulled pull(double speed, double stiffness, const Method& method) {
  Grip grip;
  for (const double side : {-1.0, 1.0}) {
    grip.points.emplace_back(side * 0.012, 0, 0);
    grip.normals.emplace_back(side * Vec3::UnitX());
  }
  grip.depth = 12 / stiffness;
  grip.lift = 0;
  grip.move = [&](std::size_t finger, double time) {
    const Ramp along = ramp(time, 0, 2 * (kStop + kBeyond) * kArm / speed);
    const double angle = -(kStop + kBeyond) * along.value, rate = -(kStop + kBeyond) * along.rate;
    const double r = kArm + (finger == 0 ? -1 : 1) * (0.012 + grip.radius - grip.depth);
    return PrescribedFinger::State{Vec3(r * std::cos(angle) - r, r * std::sin(angle), 0),
                                   rate * Vec3(-r * std::sin(angle), r * std::cos(angle), 0)};
  };
  StudySpec spec;
  spec.scene = PRESA_SOURCE_DIR "/tests/experiments/stability/hinge_stop.xml";
  spec.sets = std::vector<std::string>{"material/oak/stiffness=" + std::to_string(stiffness)} + method;
  spec.duration = 4;
  StudyRun run(spec, gripFingers(grip));
  const std::size_t knob = bodyNamed(run.world(), "knob");
  Pulled pulled;
  const StudyRun::Observer body = atEachStep([&](const ObjectState& state) {
    const Vec3 arm = state.bodies[knob].X_WB_end.p + kArm * Vec3::UnitX();
    const double way = kArm * std::atan2(-arm.y(), arm.x());
    pulled.beyond = std::max(pulled.beyond, way - kArm * kStop);
    pulled.left = kArm * kStop - way;
  });
  std::array<Vec3, 2> before{Vec3::Zero(), Vec3::Zero()};
  run.observe([&](const HapticSample& sample) {
    body(sample);
    for (std::size_t f = 0; f < 2; ++f) {
      const Vec3 now = sample.contact.fingers[f].f_H_W;
      if (sample.tick.time > Grip::kMoveBegin) pulled.step = std::max(pulled.step, (now - before[f]).norm());
      before[f] = now;
    }
  });
  run.run();
  return pulled;
}

// The slew limit of the device is 1000 N/s: 1 N in a tick. The stop is rigid, and the hand pulls the door to it.
TEST(HingeStop, NoFingerFeelsAStepAboveTheSlewLimit) {
  for (const double speed : {0.1, 0.4}) {
    for (const double stiffness : {1000.0, 2000.0}) {
      for (const Method& method : {ours(), hapticRate()}) {
        const Pulled pulled = pull(speed, stiffness, method);
        const std::string which =
            std::to_string(speed) + " m/s, " + std::to_string(stiffness) + " N/m, " + couplingOf(method);
        EXPECT_LT(pulled.step, 1) << which;
        EXPECT_LT(pulled.beyond, 1e-5) << which;
        EXPECT_LT(std::abs(pulled.left), 1e-5) << which;
      }
    }
  }
}

}  // namespace
}  // namespace presa::stability
