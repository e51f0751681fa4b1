// Torsional friction rendered to an oriented tool. Oracle: Coulomb friction at a radius behind the rotational spring of an
// evenly pressed disc, worked out by hand; the spring is exact, so tolerances are rounding unless said otherwise.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa::torsion {
namespace {

constexpr double kRadius = 0.004, kMuStatic = 0.8, kMuDynamic = 0.5, kDepth = 0.002;
constexpr double kNormal = test::kStiffness * kDepth;                                                 // [N]
constexpr double kTwistStiffness = 9.0 / 8 * test::kStiffness * kRadius * kRadius;                    // [N m/rad]
constexpr double kStatic = kMuStatic * kNormal * kRadius, kDynamic = kMuDynamic * kNormal * kRadius;  // [N m]

World soft(const Shape& shape, bool fixed = true) {
  World world = test::worldOf(shape, fixed);
  world.scene.materials[0].friction_static = kMuStatic;
  world.scene.materials[0].friction_dynamic = kMuDynamic;
  world.scene.materials[0].torsional_radius = kRadius;
  return world;
}

/// A stylus that presses on a cube's face and turns about the face's normal.
struct Stylus {
  explicit Stylus(World world, const Quat& q_WB = Quat::Identity()) : finger(std::move(world)), q(q_WB) {
    finger.tick(input(0, 0.05 + test::kR + 0.001));
  }
  FingerInput input(double angle, double height) const {
    FingerInput input{q * Vec3(0.005, 0.003, height), Vec3::Zero(), -1, true};
    input.oriented = true;
    input.q_WT = q * Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ())) * Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX()));
    return input;
  }
  /// Torque on the tool about the face's normal [N m].
  double turnTo(double angle) {
    const FingerContact& contact = finger.tick(input(angle, 0.05 + test::kR - kDepth));
    EXPECT_NEAR(contact.normal_force, kNormal, 1e-9);
    const Vec3 nhat = q * Vec3::UnitZ();
    EXPECT_NEAR(contact.t_H_W.cross(nhat).norm(), 0, 1e-12) << "about the normal alone";
    return contact.t_H_W.dot(nhat);
  }
  test::OneFinger finger;
  Quat q;
};

const Box kCube{{0.1, 0.1, 0.1}};

TEST(RenderedTorsion, SticksSlipsAtTheStaticBoundAndSlidesAtTheDynamicOne) {
  for (const double side : {1.0, -1.0}) {
    Stylus stylus(soft(kCube));
    EXPECT_EQ(stylus.turnTo(0), 0);
    const double step = 1e-3;
    bool slipped = false;
    for (int n = 1; n < 1000; ++n) {
      const double torque = -side * stylus.turnTo(side * step * n), spring = kTwistStiffness * step * n;
      slipped = slipped || spring > kStatic;
      ASSERT_NEAR(torque, slipped ? kDynamic : spring, 1e-9) << n;
    }
    ASSERT_TRUE(slipped);
    // turned back, the spring unloads from the dynamic bound
    EXPECT_NEAR(-side * stylus.turnTo(side * 0.989), kDynamic - kTwistStiffness * 0.01, 1e-9);
  }
}

// On any facet orientation alike, and through whole turns.
TEST(RenderedTorsion, IsTheSameOnATurnedBody) {
  const Quat q_WB(Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()));
  World world = soft(kCube);
  world.scene.bodies[0].X_WB.q = q_WB;
  Stylus stylus(std::move(world), q_WB);
  double torque = 0;
  for (int n = 0; n <= 2000; ++n) torque = stylus.turnTo(0.01 * n);
  EXPECT_NEAR(torque, -kDynamic, 1e-9) << "three turns";
}

// A body that turns under a still tool pulls it along.
TEST(RenderedTorsion, FollowsTheBody) {
  Stylus stylus(soft(kCube, false));
  stylus.turnTo(0);
  const double angle = 0.01;
  BodyMotion& body = stylus.finger.objects().bodies[0];
  body.X_WB_begin.q = body.X_WB_end.q = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  EXPECT_NEAR(stylus.turnTo(0), kTwistStiffness * angle, 1e-9);
}

// No loop in angle and depth returns more work than it took: turned to and fro, in stick and in slip.
TEST(RenderedTorsion, GivesNoEnergyOverAClosedLoop) {
  for (const double amplitude : {0.02, 0.2, 1.0}) {
    Stylus stylus(soft(kCube));
    stylus.turnTo(0);
    const int steps = 4000;
    double work = 0, last = 0, angle = 0;
    for (int n = 1; n <= steps; ++n) {
      const double next = amplitude * std::sin(2 * M_PI * n / steps), torque = stylus.turnTo(next);
      work += (last + torque) / 2 * (next - angle);  // of the torque on the tool
      last = torque;
      angle = next;
    }
    const bool slips = kTwistStiffness * amplitude > kStatic;
    if (slips) {
      EXPECT_LT(work, -kDynamic * amplitude) << amplitude;
    } else {
      EXPECT_NEAR(work, 0, 1e-15) << amplitude;
    }
  }
}

TEST(RenderedTorsion, IsAbsentWithoutOrientationOrTorsion) {
  Stylus stylus(soft(kCube));
  FingerInput input = stylus.input(0, 0.05 + test::kR - kDepth);
  input.oriented = false;
  input.q_WT = Quat::Identity();
  EXPECT_EQ(stylus.finger.tick(input).t_H_W, Vec3::Zero());
  EXPECT_EQ(stylus.finger.tick(input).twist_stiffness, 0);
  World hard = soft(kCube);
  hard.scene.materials[0].torsional_radius = 0;
  Stylus other(std::move(hard));
  other.turnTo(0);
  EXPECT_EQ(other.turnTo(0.1), 0);
  const std::vector<std::string> stages = other.finger.stages();
  for (const std::string& stage : stages) EXPECT_EQ(stage.find("torsional"), std::string::npos) << stage;
}

}  // namespace
}  // namespace presa::torsion
