#include "experiments/stability/held_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace presa::stability {
namespace {

HeldBody::Parameters cube(double mass, double stiffness) {
  HeldBody::Parameters parameters;
  parameters.mass = mass;
  parameters.inertia = Vec3::Constant(mass * 0.07 * 0.07 / 6);
  parameters.stiffness = stiffness;
  parameters.attachments = {{-0.043, 0, 0}, {0.043, 0, 0}};
  parameters.fingertip = [](std::size_t finger, double) { return Vec3(finger == 0 ? -0.041 : 0.041, 0, 0); };
  return parameters;
}

// Grasp resonance f = sqrt(2 K / m) / 2 pi: after a full period the body is back, after half a period it is opposite.
TEST(HeldBody, SwingsAtTheGraspResonance) {
  const double mass = 0.1, stiffness = 500, period = 2 * std::numbers::pi / std::sqrt(2 * stiffness / mass);
  HeldBody body(cube(mass, stiffness), 0, {Vec3(0.001, 0.0005, 0), Quat::Identity()}, Vec3::Zero(), Vec3::Zero());
  body.advance(10.5 * period);
  // the end time is exact to half a step, where the speed is zero; the phase error of the scheme is (w dt)^2 / 24
  EXPECT_NEAR(body.pose().p.x(), -0.001, 1e-8);
  EXPECT_NEAR(body.pose().p.y(), -0.0005, 1e-8);
}

TEST(HeldBody, HangsByItsWeight) {
  HeldBody::Parameters parameters = cube(0.1, 2000);
  parameters.gravity = {0, 0, -9.81};
  const double sag = 0.1 * 9.81 / (2 * 2000);
  HeldBody body(parameters, 0, {Vec3(0, 0, -sag), Quat::Identity()}, Vec3::Zero(), Vec3::Zero());
  body.advance(1);
  EXPECT_NEAR(body.pose().p.z(), -sag, 1e-12);
}

// From anywhere near: below the fingers by its weight, and straight; each spring then carries half of it.
TEST(HeldBody, RelaxesToWhereItHangs) {
  HeldBody::Parameters parameters = cube(0.1, 2000);
  parameters.gravity = {0, 0, -9.81};
  const double weight = 0.1 * 9.81, sag = weight / (2 * 2000);
  HeldBody body(parameters, 0, {Vec3(1e-3, -1e-3, 1e-3), Quat(Eigen::AngleAxisd(0.02, Vec3::UnitY()))}, Vec3::Zero(),
                Vec3::Zero());
  body.relax(2);
  EXPECT_LT((body.pose().p - Vec3(0, 0, -sag)).norm(), 1e-9);
  EXPECT_LT((body.force(0) - Vec3(2000 * 0.002, 0, weight / 2)).norm(), 1e-5);
}

// No torque acts about the line between the fingers: the body keeps spinning about it. Across it the springs have the
// stiffness c = 2 k a (a - depth), so the body swings at sqrt(c / J).
TEST(HeldBody, TurnsFreelyAboutTheLineAndSwingsAcrossIt) {
  HeldBody spinning(cube(0.1, 2000), 0, {}, Vec3::Zero(), Vec3(3, 0, 0));
  spinning.advance(0.5);
  EXPECT_NEAR(Eigen::AngleAxisd(Eigen::Quaterniond(spinning.pose().q)).angle(), 1.5, 1e-9);

  const double inertia = 0.1 * 0.07 * 0.07 / 6, c = 2 * 2000 * 0.043 * 0.041, angle = 1e-3;
  const double half = std::numbers::pi / std::sqrt(c / inertia);
  HeldBody swinging(cube(0.1, 2000), 0, {Vec3::Zero(), Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))}, Vec3::Zero(),
                    Vec3::Zero());
  swinging.advance(half);
  EXPECT_NEAR(2 * swinging.pose().q.z(), -angle, 1e-7);
}

}  // namespace
}  // namespace presa::stability
