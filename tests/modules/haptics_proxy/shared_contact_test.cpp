// A finger held by several bodies: each bears its own part. Oracle: statics of a frictionless sphere, worked out by
// hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::kR;
using test::kStiffness;

/// Boxes (or their meshes) under one fingertip.
World boxes(const std::vector<std::pair<Vec3, Pose>>& all, bool mesh, double mu = 0) {
  World world = test::worldOf(Box{{1, 1, 1}}, false);
  world.scene.materials[0].friction_static = world.scene.materials[0].friction_dynamic = mu;
  world.scene.bodies.clear();
  world.meshes.clear();
  world.inertias.clear();
  for (const auto& [size, X_WB] : all) {
    Body body;
    body.name = "box" + std::to_string(world.scene.bodies.size());
    body.X_WB = X_WB;
    body.haptic = Geometry{mesh ? Shape(MeshRef{}) : Shape(Box{size}), {}, {}};
    world.scene.bodies.push_back(body);
    world.meshes.emplace_back();
    if (mesh) world.meshes.back().haptic = std::make_shared<const TriMesh>(makeBox(size));
    world.inertias.emplace_back();
  }
  return world;
}

Vec3 partOf(const test::OneFinger& finger, std::int32_t body) {
  Vec3 sum = Vec3::Zero();
  for (const ToolContact& part : finger.all().contactsOf(finger.all().fingers[0])) {
    if (part.body == body) sum += part.f_H_W;
  }
  return sum;
}

Vec3 sumOfParts(const test::OneFinger& finger) {
  Vec3 sum = Vec3::Zero();
  for (const ToolContact& part : finger.all().contactsOf(finger.all().fingers[0])) sum += part.f_H_W;
  return sum;
}

// Two cubes 10 mm apart hold the fingertip between their upper edges: each pushes along the line from its edge to the
// fingertip's centre, at asin(5/8) from the vertical, with F / (2 cos). Tolerance: 1 um of the spring's 1 mm.
TEST(SharedContact, TwoEdgesShareAForceAlike) {
  const Vec3 cube(0.05, 0.05, 0.05);
  for (const bool mesh : {false, true}) {
    test::OneFinger finger(boxes(
        {{cube, {Vec3(-0.03, 0, -0.025), Quat::Identity()}}, {cube, {Vec3(0.03, 0, -0.025), Quat::Identity()}}}, mesh));
    FingerContact contact;
    const double top = std::sqrt(kR * kR - 0.005 * 0.005);
    for (int i = 0; i <= 100; ++i) contact = finger.tick({0, 0, top + 0.001 - 2e-5 * i});
    ASSERT_EQ(contact.contact_count, 2U) << mesh;
    EXPECT_NEAR((contact.f_H_W - Vec3(0, 0, 1)).norm(), 0, 0.001);
    EXPECT_NEAR((sumOfParts(finger) - contact.f_H_W).norm(), 0, 1e-9);
    const double sideways = 0.5 * 0.005 / top;  // F / 2 tan
    EXPECT_NEAR((partOf(finger, 0) - Vec3(sideways, 0, 0.5)).norm(), 0, 0.01 * 0.64) << mesh;
    EXPECT_NEAR((partOf(finger, 1) - Vec3(-sideways, 0, 0.5)).norm(), 0, 0.01 * 0.64) << mesh;
  }
}

// A floor and a wall leaning over it: multipliers of a wedge of 60 degrees, worked out by hand, for any direction of
// the load.
TEST(SharedContact, AWedgeSharesByItsMultipliers) {
  const double angle = std::numbers::pi / 3;
  const Quat lean(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  const Vec3 floor_nhat(0, 0, 1), wall_nhat = lean * Vec3(1, 0, 0);
  const auto box = [](const Vec3& nhat, const Quat& turn, const Vec3& size, double half) {
    return std::pair(size, Pose{-half * nhat, turn});
  };
  for (const bool mesh : {false, true}) {
    for (const double toward : {-0.3, 0.0, 0.4}) {
      test::OneFinger finger(
          boxes({box(floor_nhat, Quat::Identity(), {1, 1, 0.2}, 0.1), box(wall_nhat, lean, {0.2, 1, 1}, 0.1)}, mesh));
      // centre of the sphere that touches both planes through the origin
      Mat3 planes;
      planes.row(0) = floor_nhat;
      planes.row(1) = wall_nhat;
      planes.row(2) = Vec3::UnitY();
      const Vec3 rest = planes.inverse() * Vec3(kR, kR, 0);
      const Vec3 in = -(floor_nhat + wall_nhat + toward * (floor_nhat - wall_nhat)).normalized();
      FingerContact contact;
      for (int i = 0; i <= 150; ++i) contact = finger.tick(rest - 0.001 * in + 2e-5 * i * in);
      const Vec3 load = contact.f_H_W;
      ASSERT_EQ(contact.contact_count, 2U) << mesh << toward;
      Mat3 normals;
      normals << floor_nhat, wall_nhat, Vec3::UnitY();
      const Vec3 multipliers = normals.inverse() * load;
      EXPECT_NEAR((partOf(finger, 0) - multipliers[0] * floor_nhat).norm(), 0, 0.01 * load.norm()) << mesh << toward;
      EXPECT_NEAR((partOf(finger, 1) - multipliers[1] * wall_nhat).norm(), 0, 0.01 * load.norm()) << mesh << toward;
    }
  }
}

// Three bodies in a corner: each bears the force along its own axis. With friction the parts still add up to the
// rendered force.
TEST(SharedContact, ThreeBodiesInACornerEachBearTheirAxis) {
  for (const double mu : {0.0, 0.5}) {
    test::OneFinger finger(boxes({{{0.2, 1, 1}, {Vec3(-0.1, 0, 0), Quat::Identity()}},
                                  {{1, 0.2, 1}, {Vec3(0, -0.1, 0), Quat::Identity()}},
                                  {{1, 1, 0.2}, {Vec3(0, 0, -0.1), Quat::Identity()}}},
                                 true, mu));
    const Vec3 rest = Vec3::Constant(kR), in(-1e-3, -2e-3, -3e-3);
    FingerContact contact;
    for (int i = 0; i <= 200; ++i) contact = finger.tick(rest - in + 0.01 * i * in);
    ASSERT_EQ(contact.contact_count, 3U);
    EXPECT_NEAR((sumOfParts(finger) - contact.f_H_W).norm(), 0, 1e-6);
    if (mu > 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR((partOf(finger, axis) + kStiffness * in[axis] * Vec3::Unit(axis)).norm(), 0, 0.01 * 3) << axis;
    }
  }
}

}  // namespace
}  // namespace presa
