// A renderer with a contact set of its own: a ring of balls under one fingertip.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "tests/modules/haptics_proxy/module_fixture.h"

namespace presa {
namespace {

using test::kR, test::kStiffness;

constexpr double kBall = 0.01, kRing = 0.006;

/// Balls in a ring, whose centres are `kRing` from the z axis.
World ring(int balls, double damping = 0) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  World world = test::worldOf(Sphere{kBall}, false);
  world.scene.materials[0].damping = damping;
  world.scene.haptics = {.renderer = "every_body", .proxy = false};
  world.scene.bodies.clear();
  world.meshes.clear();
  world.inertias.clear();
  for (int b = 0; b < balls; ++b) {
    const double angle = 2 * std::numbers::pi * b / balls;
    Body body;
    body.name = "ball" + std::to_string(b);
    body.X_WB.p = kRing * Vec3(std::cos(angle), std::sin(angle), 0);
    body.haptic = Geometry{Sphere{kBall}, {}, {}};
    world.scene.bodies.push_back(body);
    world.meshes.emplace_back();
    world.inertias.emplace_back();
  }
  return world;
}

double depthAt(double z) { return kR + kBall - std::hypot(kRing, z); }

// Each ball pushes along the line of centres with k times its own depth. The contact as a whole is their sum.
TEST(OwnContacts, EachBodyBearsItsOwn) {
  const double z = std::sqrt(std::pow(kR + kBall - 0.001, 2) - kRing * kRing);
  for (const double damping : {0.0, 4.0}) {
    test::OneFinger finger(ring(4, damping));
    const Vec3 v_WH(0, 0, -0.05);
    finger.tick({0, 0, z}, v_WH);
    const FingerContact contact = finger.tick({0, 0, z}, v_WH);
    const std::span<const ToolContact> contacts = finger.all().contactsOf(contact);
    ASSERT_EQ(contacts.size(), 4U);
    Vec3 sum = Vec3::Zero();
    for (const ToolContact& one : contacts) {
      const Vec3 apart = Vec3(0, 0, z) - ring(4).scene.bodies[static_cast<std::size_t>(one.body)].X_WB.p;
      const Vec3 nhat = apart.normalized();
      EXPECT_NEAR(one.depth, depthAt(z), 1e-12);
      EXPECT_NEAR((one.f_H_W - (kStiffness * depthAt(z) - damping * v_WH.dot(nhat)) * nhat).norm(), 0, 1e-9);
      EXPECT_NEAR((one.nhat_B - nhat).norm(), 0, 1e-12);
      EXPECT_NEAR((one.p_BP - apart - Vec3(0, 0, contact.p_WP.z() - z)).norm(), 0, 1e-12);
      sum += one.f_H_W;
    }
    EXPECT_NEAR((contact.f_H_W - sum).norm(), 0, 1e-9);
  }
  EXPECT_EQ(test::OneFinger(ring(4)).all().coverage_lost, 0U);
}

// A tick with more contacts than the renderer asked for room counts as lost coverage, and keeps those that fit.
TEST(OwnContacts, AboveTheRoomAreCounted) {
  test::OneFinger finger(ring(6));
  for (std::uint32_t n = 1; n <= 3; ++n) {
    EXPECT_EQ(finger.tick({0, 0, 0.016}).contact_count, 4U);
    EXPECT_EQ(finger.all().coverage_lost, n);
  }
  finger.tick({0, 0, 0.1});
  EXPECT_EQ(finger.all().coverage_lost, 3U);
  EXPECT_EQ(finger.all().contacts.size(), 0U);
}

}  // namespace
}  // namespace presa
