#include "devices/percro_arm/characterise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/presa/device/characterise.h"
#include "devices/percro_arm/bench.h"
#include "devices/percro_arm/reach.h"
#include "devices/percro_arm/steps.h"
#include "framework/core/math/random.h"
#include "tests/apps/support/support.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

// Reference: the transfer function of the linear model. Without dry friction the remaining differences are the hold of
// the command over a tick (0.1 dB at 100 Hz), the counts in J, and the sampling: 0.3 dB.
TEST(PercroBench, ForceResponseIsThatOfTheLinearModel) {
  Parameters p = kArm;
  p.friction.coulomb[0] = p.friction.coulomb[1] = p.friction.coulomb[2] = 0;
  const ForceResponse response = forceResponse(p, {4, 20, 40, 60, 80, 100});
  for (std::size_t i = 0; i < response.frequency.size(); ++i)
    EXPECT_NEAR(response.gain_db[i], linearGain(p, response.frequency[i]), 0.3) << response.frequency[i];
}

// With twice the moving mass the bandwidth falls by sqrt(2), in the model as in the closed form of a mass on a spring.
TEST(PercroBench, BandwidthFallsWithTheMovingMass) {
  const std::vector<double> frequencies = steps(2, 120, 59);
  Parameters heavy = kArm;
  heavy.masses.barrel *= 2;
  const double ratio = forceResponse(kArm, frequencies).bandwidth / forceResponse(heavy, frequencies).bandwidth;
  EXPECT_NEAR(ratio, std::numbers::sqrt2, 0.08);  // the damping does not scale with the mass
}

// A rigid arm without friction, with fine encoders and fast motors, is a mass at a sampled wall: stable below K = 2 b /
// T [Colgate1997]. At 0.7 of that bound the disturbance of the impact decays as exp(-2.1 t), at 1.3 it grows as fast.
TEST(PercroBench, AWallOfARigidArmShakesBeyondColgatesBound) {
  Parameters p = kArm;
  p.friction = {{0, 0, 0}, {0, 0, 0}};
  p.structure.axial_stiffness *= 1000;
  p.motors.counts = 40'000'000;
  p.motors.current_bandwidth = 1e6;
  const double hand = 5, bound = 2 * hand / 1e-3;
  EXPECT_LT(wallShake(p, 0.75, Vec3::UnitX(), 0.7 * bound, hand), 5e-6);
  EXPECT_GT(wallShake(p, 0.75, Vec3::UnitX(), 1.3 * bound, hand), 100e-6);
}

// Reference: the box of 300 x 400 mm with its near face at L = 441 mm and its far corners at L = 1070 mm.
TEST(PercroReach, TheDeepBoxEndsWhereItsCornersDo) {
  const double a = 0.6 * 0.6 + 0.15 * 0.15 + 0.2 * 0.2, b = 2 * 0.441 * 0.6, c = 0.441 * 0.441 - 1.07 * 1.07;
  const double scale = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  EXPECT_NEAR(largestScale(kArm.geometry, {0.6, 0.3, 0.4}), scale, 1e-6);
  EXPECT_FALSE(reaches(kArm.geometry, {{0.6, 0.3, 0.4}, 0.441}));
  EXPECT_TRUE(reaches(kArm.geometry, {{0.599, 0.3, 0.4}, 0.441}));
  EXPECT_FALSE(reaches(kArm.geometry, {{0.3, 0.4, 0.6}, 0.40}));  // its near face is closer than the retracted barrel
}

// Reference: the force that reaches a motor's limit, over 2000 random directions; tolerance 1 %.
TEST(PercroReach, NoDirectionAsksMoreOfAMotorThanTheForceInAll) {
  const ArmDynamics arm(kArm, {0, -9.81, 0});
  const Mat3 to_motors = transmissionInverse(kArm.geometry).transpose();
  for (const Vec3& p : {Vec3(0.5, 0.1, 0.1), Vec3(0.8, -0.2, 0.1), Vec3(1.0, 0.1, -0.2)}) {
    const Joints q = jointsAt(kArm.geometry, p);
    const double force = forceInAllDirections(kArm, q, kArm.motors.continuous_torque);
    RandomStream stream(1, "directions");
    double max = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 direction = Vec3(stream.normal(), stream.normal(), stream.normal()).normalized();
      const Vec3 torque = to_motors * (arm.weight(q) + force * jacobian(kArm.geometry, q).transpose() * direction);
      max = std::max(max, torque.cwiseAbs().maxCoeff());
    }
    EXPECT_LE(max, kArm.motors.continuous_torque * (1 + 1e-12));
    EXPECT_GT(max, 0.99 * kArm.motors.continuous_torque);
  }
}

TEST(PercroFigures, AgreeWithThePrintedOnes) {
  int compared = 0;
  for (const Characteristic& f : figures(kArm)) {
    EXPECT_TRUE(std::isfinite(f.here)) << f.name;
    if (!f.compared()) continue;
    ++compared;
    EXPECT_TRUE(f.agrees()) << f.name << ": " << f.here;
  }
  EXPECT_EQ(compared, 12);
}

// An arm that differs from the paper's is reported as different.
TEST(PercroFigures, AnotherArmDiffers) {
  const auto differs = [](const Parameters& p, const std::string& name) {
    for (const Characteristic& f : figures(p)) {
      if (f.name.starts_with(name)) return f.compared() && !f.agrees();
    }
    ADD_FAILURE() << name;
    return false;
  };
  Parameters p = kArm;
  p.geometry.tilt_ratio *= 1.05;
  EXPECT_TRUE(differs(p, "position step across, L = 441"));
  p = kArm, p.masses.barrel *= 1.3;
  EXPECT_TRUE(differs(p, "force bandwidth"));
  p = kArm, p.motors.continuous_torque *= 0.9;
  EXPECT_TRUE(differs(p, "continuous force"));
  p = kArm, p.structure.axial_stiffness *= 1.1;
  EXPECT_TRUE(differs(p, "stiffness along"));
  p = kArm, p.geometry.length_max -= 0.005;
  EXPECT_TRUE(differs(p, "box of 300 x 400 mm"));
}

TEST(CharacteriseCommand, WritesTableFiguresAndPlots) {
  const std::string out = test::scratch("percro");
  const test::Outcome outcome = test::presa("device characterise percro_arm --out " + out);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("force bandwidth"), std::string::npos);
  const auto json = nlohmann::json::parse(test::shell("cat " + out + "/characteristics.json").out);
  EXPECT_EQ(json["figures"].size(), figures(kArm).size());
  EXPECT_EQ(json["plots"].size(), 7u);
  const std::string page = test::shell("cat " + out + "/report.html").out;
  for (const auto& plot : json["plots"])
    EXPECT_NE(page.find("aria-label=\"" + plot["title"].get<std::string>()), std::string::npos);
  for (const char* no_number : {"Mnan", "Lnan", " nan", "Minf", "Linf", " inf"})
    EXPECT_EQ(page.find(no_number), std::string::npos) << no_number;
}

TEST(CharacteriseCommand, RefusesDriversWithoutFigures) {
  const test::Outcome none = test::presa("device characterise scripted");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("E471"), std::string::npos) << none.err;
  EXPECT_EQ(test::presa("device characterise nothing_such").status, 2);
  EXPECT_EQ(test::presa("device characterise percro_arm --out /proc/nowhere").status, 2);
}

}  // namespace
}  // namespace presa::percro
