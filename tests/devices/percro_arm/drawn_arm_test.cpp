// The drawn arm against the kinematics, the structure and the motors of the model.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "devices/percro_arm/drawn_arm.h"
#include "devices/percro_arm/simulated_arm.h"
#include "framework/scene/manifest.h"
#include "tests/devices/percro_arm/arm.h"

namespace presa::percro {
namespace {

const Pose kBaseAt{{-0.75, 0.1, 0.2}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()))};
constexpr double kRounding = 1e-12;  // of some ten operations on lengths of 1 m

/// Joints over the whole reach, with wrists that differ.
template <class Check>
void atManyPlaces(const Check& check) {
  const Geometry& g = kArm.geometry;
  for (const double tilt : {-g.tilt_range, -0.2, 0.0, 0.5, g.tilt_range})
    for (const double yaw : {-g.yaw_range, 0.1, g.yaw_range})
      for (const double extension : {0.0, 0.3, g.length_max - g.length_min}) {
        const Joints q(tilt, yaw, extension);
        check(q, Vec3(0.4 * tilt + 0.2, yaw - 0.3, extension));
      }
}

FigureMoment momentAt(const Joints& q, const Vec3& wrist) {
  return {.time = 0,
          .p_FH = kBaseAt * tipPosition(kArm.geometry, q),
          .oriented = true,
          .q_FT = kBaseAt.q * Quat(thimbleFrame(q, wrist))};
}

Vec3 axisOf(const Pose& X, int axis) { return X.q * Vec3::Unit(axis); }

double between(const Vec3& a, const Vec3& b) { return a.cross(b).norm(); }

TEST(DrawnArm, TheInnerTubeEndsAtTheReportedTip) {
  const DrawnArm arm(kArm, kBaseAt);
  std::vector<Pose> X;
  atManyPlaces([&](const Joints& q, const Vec3& wrist) {
    const FigureMoment moment = momentAt(q, wrist);
    arm.place(moment, X);
    ASSERT_EQ(X.size(), arm.parts().size());
    for (const DrawnPart part : {kInnerTube, kFork, kRing, kThimble})
      EXPECT_LT((X[part].p - moment.p_FH).norm(), kRounding);
    // along the barrel, which goes through the axes
    EXPECT_LT(between(axisOf(X[kInnerTube], 0), X[kInnerTube].p - kBaseAt.p), kRounding);
    EXPECT_LT(between(axisOf(X[kInnerTube], 0), axisOf(X[kOuterTube], 0)), kRounding);
    EXPECT_NEAR((X[kInnerTube].p - X[kOuterTube].p).norm(), kArm.geometry.length_min + q[2], kRounding);
  });
}

// Each part turns about an axis of the one that carries it.
TEST(DrawnArm, ItsAxesIntersectAtRightAngles) {
  const DrawnArm arm(kArm, kBaseAt);
  std::vector<Pose> X;
  atManyPlaces([&](const Joints& q, const Vec3& wrist) {
    arm.place(momentAt(q, wrist), X);
    for (const DrawnPart part : {kBase, kLeftPulley, kRightPulley, kGimbal, kOuterTube})
      EXPECT_LT((X[part].p - kBaseAt.p).norm(), kRounding);
    EXPECT_LT(between(axisOf(X[kGimbal], 2), axisOf(X[kBase], 2)), kRounding);       // tilt
    EXPECT_LT(between(axisOf(X[kOuterTube], 1), axisOf(X[kGimbal], 1)), kRounding);  // yaw
    EXPECT_NEAR(axisOf(X[kOuterTube], 1).dot(axisOf(X[kBase], 2)), 0, kRounding);    // both at right angles
    EXPECT_NEAR(axisOf(X[kOuterTube], 0).dot(axisOf(X[kOuterTube], 1)), 0, kRounding);
    EXPECT_LT(between(axisOf(X[kFork], 0), axisOf(X[kInnerTube], 0)), kRounding);              // roll
    EXPECT_LT(between(axisOf(X[kRing], 1), axisOf(X[kFork], 1)), kRounding);                   // pitch
    EXPECT_LT(between(axisOf(X[kThimble], 2), axisOf(X[kRing], 2)), kRounding);                // yaw of the thimble
    EXPECT_LT(X[kThimble].q.angularDistance(kBaseAt.q * Quat(thimbleFrame(q, wrist))), 1e-7);  // an arc cosine near 1
  });
}

// Without slip: pulleys and drum turn by the motors' angles [Bergamasco2006 eq. 1], over the ratio of their radii.
TEST(DrawnArm, PulleysAndDrumTurnWithTheMotors) {
  const DrawnArm arm(kArm, kBaseAt);
  std::vector<Pose> X;
  const auto turnAboutZ = [](const Quat& q) { return 2 * std::atan2(q.z(), q.w()); };
  atManyPlaces([&](const Joints& q, const Vec3& wrist) {
    arm.place(momentAt(q, wrist), X);
    const Vec3 motors = transmission(kArm.geometry) * q;
    const double ratio = kArm.geometry.tilt_ratio;
    EXPECT_NEAR(turnAboutZ(kBaseAt.q.conjugate() * X[kLeftPulley].q), -motors[0] / ratio, kRounding);
    EXPECT_NEAR(turnAboutZ(kBaseAt.q.conjugate() * X[kRightPulley].q), motors[1] / ratio, kRounding);
    const double drum = turnAboutZ(X[kOuterTube].q.conjugate() * X[kDrum].q);
    EXPECT_NEAR(std::remainder(drum - motors[2], 2 * std::numbers::pi), 0, 1e-10);  // of an angle of 17 rad
  });
}

TEST(DrawnArm, ADeviceWithoutOrientationHasItsThimbleInLineWithTheBarrel) {
  const DrawnArm arm(kArm, kBaseAt);
  std::vector<Pose> X;
  arm.place({.p_FH = kBaseAt * Vec3(0.7, 0.1, -0.2)}, X);
  EXPECT_LT(X[kThimble].q.angularDistance(X[kInnerTube].q), 1e-7);
}

TEST(DrawnArm, EveryMeshIsClosedAndRightSideOut) {
  int meshes = 0;
  for (const FigurePart& part : drawnParts(kArm)) {
    for (const FigureShape& shape : part.shapes) {
      EXPECT_EQ(std::holds_alternative<MeshRef>(shape.shape), shape.mesh != nullptr) << part.name;
      if (!shape.mesh) continue;
      ++meshes;
      const MeshReport report = checkMesh(*shape.mesh);
      EXPECT_TRUE(report.closed()) << part.name;
      EXPECT_EQ(report.flipped_edges + report.degenerate + report.bad_index, 0u) << part.name;
      EXPECT_FALSE(report.inverted) << part.name;
    }
  }
  EXPECT_GT(meshes, 8);
}

// With its tip there, the model's structure gives that force: an independent implementation, in the frame D.
TEST(DrawnArm, TheDeflectedStructureGivesTheForce) {
  const DrawnArm arm(kArm, kBaseAt);
  const ArmDynamics dynamics(kArm, kGravity);
  const Vec3 f_D(-5.8, -0.9, 0.7);
  atManyPlaces([&](const Joints& q, const Vec3& wrist) {
    FigureMoment moment = momentAt(q, wrist);
    moment.f_H_F = kBaseAt.q * f_D;
    const auto bent = arm.deflection(moment, 100);
    ASSERT_TRUE(bent);
    ArmState state;
    state.q = q;
    state.x = kBaseAt.inverseTimes(moment.p_FH + bent->d_F);
    EXPECT_LT((dynamics.tipForce(state) - f_D).norm(), 1e-8);  // 24 N/mm times a rounding of 1e-13 m
    EXPECT_NEAR(std::hypot(bent->along, bent->across), bent->d_F.norm(), kRounding);
    EXPECT_LT((bent->line_F.front() - kBaseAt.p).norm(), kRounding);
    EXPECT_LT((bent->line_F.back() - (moment.p_FH + 100 * bent->d_F)).norm(), kRounding);
  });
}

/// Follows the arm at rest under a constant force, at the rate of a picture.
void followFor(DrawnArm& arm, const Vec3& tip_D, const Vec3& f_D, double from, double to) {
  for (int i = 0; from + i / 60.0 <= to + 1e-9; ++i)
    arm.follow({.time = from + i / 60.0, .p_FH = kBaseAt * tip_D, .f_H_F = kBaseAt.q * f_D});
}

// The barrel's motor: force times the radius of its drum, and the heat of a first-order winding under a constant torque.
// The barrel lies level across gravity, where it carries no weight; the current's lag of 0.3 ms moves the start by 2e-5
// of the thermal time, the first pictures by no more.
TEST(DrawnArm, AConstantForceHeatsByTheClosedForm) {
  DrawnArm arm(kArm, {Vec3::Zero(), Quat(std::sqrt(0.5), std::sqrt(0.5), 0, 0)});
  const Vec3 tip(0.75, 0, 0), force(6, 0, 0);
  for (int i = 0; i <= 600; ++i) arm.follow({.time = i / 60.0, .p_FH = tip, .f_H_F = force});
  const double share = 6 * kArm.geometry.drum_radius / kArm.motors.continuous_torque;
  const auto heat = arm.heat();
  ASSERT_TRUE(heat);
  ASSERT_EQ(heat->size(), arm.motors().size());
  EXPECT_NEAR((*heat)[2], share * share * (1 - std::exp(-10 / kArm.motors.thermal_time)), 1e-4);
}

// The model's own windings, driven at 1 kHz with the tip held: they differ by the friction that no estimate sees (none
// of it in the torques) and by the counts of the encoders.
TEST(DrawnArm, ItsHeatIsThatOfTheModelsMotors) {
  const Vec3 tip(0.75, 0.05, 0.02), force(5, 1, -0.5);
  SimulatedArm model(kArm, kBaseAt.q.conjugate() * Vec3(0, 0, -9.81), 1e-3);
  model.place(tip);
  TipLoad load;
  load.held = true;
  for (int i = 0; i < 5000; ++i) {
    model.command(force);
    model.advance(load);
  }
  DrawnArm arm(kArm, kBaseAt);
  followFor(arm, tip, force, 0, 5);
  const auto heat = arm.heat();
  ASSERT_TRUE(heat);
  EXPECT_NEAR(*std::max_element(heat->begin(), heat->end()) / model.maxHeat(), 1, 0.01);
}

TEST(DrawnArm, HeatIsNotKnownAfterAJumpAndKnownFromTheStartAgain) {
  const Vec3 tip(0.75, 0, 0), force(6, 0, 0);
  DrawnArm arm(kArm, kBaseAt);
  EXPECT_FALSE(arm.heat());
  followFor(arm, tip, force, 3, 4);
  EXPECT_FALSE(arm.heat()) << "first seen at 3 s";
  followFor(arm, tip, force, 0, 1);
  ASSERT_TRUE(arm.heat());
  const double after = arm.heat()->at(2);
  followFor(arm, tip, force, 1, 1);  // held
  EXPECT_EQ(arm.heat()->at(2), after);
  followFor(arm, tip, force, 5, 6);
  EXPECT_FALSE(arm.heat()) << "jumped from 1 s to 5 s";
}

TEST(DrawnArm, TheDriverExportsItAndItsManifestSaysSo) {
  const Manifest* manifest = findManifest("percro_arm");
  ASSERT_NE(manifest, nullptr);
  EXPECT_TRUE(manifest->hasFigure());
  const auto& table = pluginTable<FigurePlugin>("percro_arm", kFigureSymbol);
  DeviceBinding binding;
  binding.driver = "percro_arm";
  EXPECT_EQ(table.create(binding), nullptr) << "nobody says where it stands";
  binding.settings["pos"].value = "-0.75 0 0.1";
  binding.settings["quat"].value = "2 0 0 0";
  const auto figure = table.create(binding);
  ASSERT_NE(figure, nullptr);
  std::vector<Pose> X;
  figure->place({.p_FH = {0, 0, 0.1}}, X);
  EXPECT_LT((X.at(kBase).p - Vec3(-0.75, 0, 0.1)).norm(), kRounding);
}

}  // namespace
}  // namespace presa::percro
