// Two cubes on a plate, at poses with known overlap and energy.
#include "apps/studies/cost/rest_watch.h"

#include <gtest/gtest.h>

#include "framework/session/load_world.h"

namespace presa::cost {
namespace {

std::shared_ptr<const World> stack() {
  const std::string cube = "<physics mass=\"0.2\"><box size=\"0.1 0.1 0.1\"/></physics></body>";
  Diagnostics diagnostics;
  const Loaded loaded = loadWorldFromText(
      {"<scene version=\"1.0\" name=\"stack\"><world gravity=\"0 0 -9.81\"/>"
       "<materials><material name=\"m\" stiffness=\"1000\"/></materials>"
       "<body name=\"plate\" fixed=\"true\" pos=\"0 0 -0.05\"><physics><box size=\"1 1 0.1\"/></physics></body>"
       "<body name=\"low\" pos=\"0 0 0.05\">" +
           cube + "<body name=\"high\" pos=\"0 0 0.15\">" + cube + "</scene>",
       "stack", ""},
      {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return loaded.world;
}

/// A step of 5 ms that ends at `end` [s]; the lower cube moves from height `low_from` to `low_to`, the upper is at
/// `high` [m].
ObjectState step(double end, double low_from, double low_to, double high) {
  ObjectState state;
  state.bodies.resize(3);
  state.time_begin = end - 0.005;
  state.time_end = end;
  state.bodies[0].X_WB_begin.p = state.bodies[0].X_WB_end.p = Vec3(0, 0, -0.05);
  state.bodies[1].X_WB_begin.p = Vec3(0, 0, low_from);
  state.bodies[1].X_WB_end.p = Vec3(0, 0, low_to);
  state.bodies[2].X_WB_begin.p = state.bodies[2].X_WB_end.p = Vec3(0, 0, high);
  return state;
}

Evidence windows() {
  Evidence evidence;
  evidence.compared_to = evidence.steady_to = 2;
  evidence.steady_from = 1;
  return evidence;
}

TEST(RestWatch, MeasuresOverlapMotionAndDrift) {
  const auto world = stack();
  Evidence evidence = windows();
  RestWatch watch(*world, evidence);
  watch.observe(step(0.5, 0.04, 0.04, 0.15));       // 10 mm deep, before the steady window
  watch.observe(step(1.5, 0.048, 0.048, 0.15));     // 2 mm in the plate; no contact of the upper cube
  watch.observe(step(1.505, 0.048, 0.049, 0.146));  // 1 mm in the plate, 3 mm in each other; 0.2 m/s
  watch.observe(step(2.5, 0.01, 0.01, 0.15));       // after both windows
  watch.finish(evidence);
  EXPECT_NEAR(evidence.penetration.value(), (0.002 + 0.001 + 0.003) / 3, 1e-12);
  EXPECT_NEAR(evidence.penetration_max.value(), 0.010, 1e-12);
  EXPECT_NEAR(evidence.rest_energy.value(), 0.5 * (0.5 * 0.2 * 0.2 * 0.2), 1e-12);
  EXPECT_NEAR(evidence.rest_drift.value(), 0.004, 1e-12);
  EXPECT_EQ(watch.lost(), "");
}

// A rotation of 0.01 rad in 5 ms about z is 2 rad/s; the cube's inertia is m a^2 / 6.
TEST(RestWatch, CountsTheEnergyOfTurning) {
  const auto world = stack();
  Evidence evidence = windows();
  RestWatch watch(*world, evidence);
  ObjectState state = step(1.5, 0.05, 0.05, 0.15);
  state.bodies[2].X_WB_end.q = Quat(Eigen::AngleAxisd(0.01, Vec3::UnitZ()));
  watch.observe(state);
  watch.finish(evidence);
  EXPECT_NEAR(evidence.rest_energy.value(), 0.5 * (0.2 * 0.01 / 6) * 4, 1e-9);
}

TEST(RestWatch, NamesWhatFellOut) {
  const auto world = stack();
  RestWatch watch(*world, windows());
  watch.observe(step(0.5, 0.05, -3, 0.15));
  EXPECT_EQ(watch.lost(), "low");
}

}  // namespace
}  // namespace presa::cost
