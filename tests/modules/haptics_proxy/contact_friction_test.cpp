// Friction of a finger that two bodies hold: each has its own law, coefficients and memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/core/math/random.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/support/effort.h"

namespace presa {
namespace {

using test::kR;
using test::kStiffness;

struct Surface {
  double mu_static, mu_dynamic;
  double dahl = 0;  ///< stiffness of the bristles of the Dahl law [N/m]; 0: friction cone
};

/// A floor (body 0) and a wall (body 1) at right angles, along y.
World groove(const Surface& floor, const Surface& wall) {
  World world = test::worldOf(Box{{1, 1, 0.2}});
  world.scene.bodies.resize(2, world.scene.bodies[0]);
  world.scene.materials.resize(2, world.scene.materials[0]);
  world.meshes.resize(2);
  world.inertias.resize(2);
  world.scene.bodies[0].X_WB.p = Vec3(0, 0, -0.1);
  world.scene.bodies[1].X_WB.p = Vec3(-0.1, 0, 0);
  world.scene.bodies[1].haptic->shape = Box{{0.2, 1, 1}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Surface& surface = i == 0 ? floor : wall;
    Material& material = world.scene.materials[i];
    world.scene.bodies[i].material = i;
    material.friction_static = surface.mu_static;
    material.friction_dynamic = surface.mu_dynamic;
    if (surface.dahl == 0) continue;
    PluginElement law{"friction_dahl", "dahl", kNoBody, {{"stiffness", std::to_string(surface.dahl)}}, {}};
    law.kind = PluginKind::kFrictionLaw;
    law.material = static_cast<std::int32_t>(i);
    world.scene.plugin_elements.push_back(law);
  }
  return world;
}

/// A fingertip in the groove.
struct InGroove {
  InGroove(const Surface& floor, const Surface& wall) : finger(groove(floor, wall)) {}
  /// `down` on the floor and `aside` on the wall [N], at y.
  void press(double down, double aside, double y) {
    contact = finger.tick(Vec3(kR - aside / kStiffness, y, kR - down / kStiffness));
  }
  void slideTo(double down, double aside, double from, double to) {
    constexpr int kTicks = 500;
    for (int i = 1; i <= kTicks; ++i) press(down, aside, from + (to - from) * i / kTicks);
  }
  double along() const { return -contact.f_H_W.y(); }
  const ToolContact* with(std::int32_t body) const {
    for (const ToolContact& one : finger.all().contactsOf(contact)) {
      if (one.body == body) return &one;
    }
    return nullptr;
  }
  /// Force along the groove that the body alone exerts; NaN without a contact.
  double along(std::int32_t body) const {
    const ToolContact* one = with(body);
    return one == nullptr ? std::numeric_limits<double>::quiet_NaN() : -one->f_H_W.y();
  }

  test::OneFinger finger;
  FingerContact contact;
};

constexpr double kDown = 2, kAside = 1;  // [N]
constexpr double kForce = 1e-6;          // rounding of the proxy's motion times stiffness [N]

// Coulomb, body by body: a finger that slides feels mu N of each, and each body its own.
TEST(ContactFriction, EachBodyRubsWithItsOwnCoefficient) {
  for (const auto& [floor, wall] : {std::pair{0.2, 0.8}, {0.8, 0.2}, {0.0, 0.5}, {0.5, 0.0}}) {
    InGroove groove({floor, floor}, {wall, wall});
    groove.slideTo(kDown, kAside, 0, 0.01);
    EXPECT_NEAR(groove.along(), floor * kDown + wall * kAside, kForce) << floor;
    EXPECT_NEAR(groove.along(0), floor * kDown, kForce) << floor;
    EXPECT_NEAR(groove.along(1), wall * kAside, kForce) << floor;
    EXPECT_EQ(groove.contact.mode, ContactMode::kSlip);
    EXPECT_EQ(groove.with(0)->friction_static, floor);
    EXPECT_EQ(groove.with(1)->friction_static, wall);
  }
}

// One body slips while the other still holds: the springs are parallel, each with its share of the stiffness, here 2/3
// and 1/3. By hand: floor 0.2 N of 0.1 * 2 N from s = 0.3 mm on; the wall holds k s / 3 up to 0.8 * 1 N.
TEST(ContactFriction, OneSlipsWhileTheOtherHolds) {
  InGroove groove({0.1, 0.1}, {0.8, 0.8});
  groove.press(kDown, kAside, 0);
  groove.slideTo(kDown, kAside, 0, 0.0015);
  EXPECT_EQ(groove.with(0)->mode, ContactMode::kSlip);
  EXPECT_EQ(groove.with(1)->mode, ContactMode::kStick);
  EXPECT_EQ(groove.contact.mode, ContactMode::kStick);
  EXPECT_NEAR(groove.along(0), 0.1 * kDown, kForce);
  EXPECT_NEAR(groove.along(1), kStiffness * 0.0015 * kAside / (kDown + kAside), kForce);
}

// The body that bears more changes from floor to wall and back, below both bounds: what sticks stays where it is.
TEST(ContactFriction, AStickingFingerKeepsItsForceWhenTheLoadMovesOver) {
  InGroove groove({1, 1}, {1, 1});
  groove.press(kDown, kAside, 0);
  groove.slideTo(kDown, kAside, 0, 0.001);
  const double held = groove.along();
  EXPECT_NEAR(held, kStiffness * 0.001, kForce);
  for (int i = 0; i <= 100; ++i) {
    groove.press(kDown - 0.01 * i, kAside + 0.01 * i, 0.001);
    ASSERT_NEAR(groove.along(), held, kForce) << i;
  }
  EXPECT_EQ(groove.contact.body, 1);
  for (int i = 100; i >= 0; --i) groove.press(kDown - 0.01 * i, kAside + 0.01 * i, 0.001);
  EXPECT_NEAR(groove.along(), held, kForce);
  EXPECT_EQ(groove.contact.body, 0);
}

// The floor's bristles (Dahl) are its own: while the wall, which has a cone, bears more, they stay stretched.
// By hand: the bristles, 500 N/m, have a share 2/3 of 0.5 * 3 N at the most, and are stretched by 0.2 mm only, where
// z = z_s (1 - exp(-d / z_s)), z_s = 0.5 * 3 N / (500 N/m).
TEST(ContactFriction, ALawKeepsItsMemoryWhileAnotherBodyBearsMore) {
  InGroove groove({0.5, 0.5, 500}, {0.4, 0.4});
  groove.press(kDown, kAside, 0);
  groove.slideTo(kDown, kAside, 0, 0.0002);
  const double z_s = 0.5 * (kDown + kAside) / 500, z = z_s * (1 - std::exp(-0.0002 / z_s));
  EXPECT_NEAR(groove.along(0), 500 * z * kDown / (kDown + kAside), 1e-3);
  const double before = groove.along(0);
  for (int i = 0; i <= 100; ++i) groove.press(kDown - 0.01 * i, kAside + 0.01 * i, 0.0002);
  EXPECT_EQ(groove.contact.body, 1);
  for (int i = 100; i >= 0; --i) groove.press(kDown - 0.01 * i, kAside + 0.01 * i, 0.0002);
  EXPECT_EQ(groove.contact.body, 0);
  EXPECT_NEAR(groove.along(0), before, kForce);
}

// A body that lets go takes its friction with it, and begins anew when it comes back.
TEST(ContactFriction, ABodyThatLetsGoForgets) {
  InGroove groove({0, 0}, {1, 1});
  groove.press(kDown, kAside, 0);
  groove.slideTo(kDown, kAside, 0, 0.0015);
  EXPECT_NEAR(groove.along(), kStiffness * 0.0015 * kAside / (kDown + kAside), kForce);
  groove.press(kDown, -0.01, 0.0015);
  EXPECT_EQ(groove.with(1), nullptr);
  EXPECT_NEAR(groove.along(), 0, kForce);
  groove.press(kDown, kAside, 0.0015);
  EXPECT_NEAR(groove.along(), 0, kForce);
  EXPECT_EQ(groove.with(1)->mode, ContactMode::kStick);
}

/// Blocks at random places and angles, some of which overlap.
World rubble(RandomStream& random) {
  World world = test::worldOf(Box{{0.02, 0.02, 0.02}});
  constexpr std::size_t kBlocks = 8;
  world.scene.bodies.resize(kBlocks, world.scene.bodies[0]);
  world.meshes.resize(kBlocks);
  world.inertias.resize(kBlocks);
  world.scene.materials[0].friction_static = world.scene.materials[0].friction_dynamic = 1;
  for (auto& body : world.scene.bodies) {
    body.X_WB.p = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
    body.X_WB.q = Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
  }
  return world;
}

// The contacts of a finger explain its whole displacement, also in a tick in which friction starts again on other
// bodies than before. Of 50 piles of rubble, with a finger that moves 2 mm in a tick.
TEST(ContactFriction, TheContactsExplainTheWholeDisplacement) {
  int several = 0;
  for (std::uint64_t pile = 0; pile < unlessSanitized(50U, 10U); ++pile) {
    RandomStream random(1, "displacement", pile);
    test::OneFinger finger(rubble(random));
    const auto anywhere = [&] {
      return Vec3(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03));
    };
    Vec3 p(0, 0, 0.06), goal = p;
    for (int i = 0; i < 5000; ++i) {
      if (i % 25 == 0) goal = anywhere();
      p += (goal - p).normalized() * std::min((goal - p).norm(), 0.002);
      const FingerContact contact = finger.tick(p);
      if (contact.contact_count < 2) continue;
      ++several;
      Vec3 sum = Vec3::Zero();
      for (const ToolContact& one : finger.all().contactsOf(contact))
        sum += one.stiffness / contact.stiffness * one.stretch_W;
      ASSERT_NEAR((sum - (contact.p_WP - contact.p_WH)).norm(), 0, 1e-12) << pile << ", " << i;
    }
  }
  EXPECT_GT(several, unlessSanitized(1000, 200));
}

}  // namespace
}  // namespace presa
