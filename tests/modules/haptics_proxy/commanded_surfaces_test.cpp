// Surface parameters changed by commands while a finger touches the surface.
#include "modules/haptics_proxy/commanded_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::OneFinger;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using test::kR;
using test::kStiffness;

constexpr double kHeight = 0.05 + kR, kPeriod = 1e-3;
constexpr double kSlewLimit = 1000 * kPeriod;  // slew limit of a finger per tick [N] (DeviceLimits)

const RunOptions kTakesCommands{.bus_commands = true};

/// A box of 1000 N/m with friction; slots: stiffness, static, dynamic.
World openBox(double mu_static = 0.8, double mu_dynamic = 0.8) {
  World world = test::worldOf(Box{{0.1, 0.1, 0.1}});
  world.scene.materials[0].name = "rubber";
  world.scene.materials[0].friction_static = mu_static;
  world.scene.materials[0].friction_dynamic = mu_dynamic;
  return world;
}

void set(OneFinger& finger, std::size_t slot, double value) {
  SurfaceSettings& settings = finger.settings();
  settings.slots[slot] = {++settings.newest, value};
}

TEST(CommandedSurfaces, AreThereOnlyWhereTheRunTakesCommands) {
  World world = openBox();
  EXPECT_THAT(OneFinger(world, kTakesCommands).stages(), Contains(HasSubstr("to their commanded values")));
  EXPECT_THAT(OneFinger(world).stages(), Not(Contains(HasSubstr("to their commanded values"))));
  OneFinger closed(world);
  set(closed, 0, 100);  // without effect
  closed.tick({0, 0, kHeight + 0.001});
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(closed.tick({0, 0, kHeight - 0.002}).stiffness, kStiffness);
}

// Without a command the run equals, to the bit, one that takes no commands, through air, stick and slip; commanding the
// current value changes nothing either.
TEST(CommandedSurfaces, LeaveEveryBitWhereNothingIsSet) {
  World world = openBox(0.8, 0.6);
  world.scene.materials[0].damping = 1;
  OneFinger open(world, kTakesCommands), same(world, kTakesCommands);
  OneFinger closed(world);
  int touched = 0;
  for (int i = 0; i < 3000; ++i) {
    const double t = i * kPeriod;
    const Vec3 p(0.01 * std::sin(9 * t), 0.005 * std::cos(5 * t), kHeight + 0.002 * std::cos(3 * t));
    const Vec3 v(0, 0, -0.006 * std::sin(3 * t));
    if (i == 1000) set(same, 0, kStiffness);
    const FingerContact a = closed.tick(p, v), b = open.tick(p, v), c = same.tick(p, v);
    ASSERT_EQ(a.f_H_W, b.f_H_W) << i;
    ASSERT_EQ(a.p_WP, b.p_WP) << i;
    ASSERT_EQ(a.f_H_W, c.f_H_W) << i;
    touched += a.normal_force > 0;
  }
  EXPECT_GT(touched, 1000);
}

// Under a still finger k(t) = k1 + (k0 - k1) exp(-t / tau): the force is k depth, changes per tick by at most F period
// / tau, here 1/100 of the slew limit, and the energy of the spring changes as slowly. Down and up again.
TEST(CommandedSurfaces, ChangeStiffnessWithoutAStep) {
  OneFinger finger(openBox(), kTakesCommands);
  const double depth = 0.002, tau = CommandedSurfaces::kTimeConstant;
  finger.tick({0, 0, kHeight + 0.001});
  double last = finger.tick({0, 0, kHeight - depth}).normal_force;
  EXPECT_NEAR(last, kStiffness * depth, 1e-5);
  double from = kStiffness;
  for (const double to : {100.0, kStiffness}) {
    set(finger, 0, to);
    for (int n = 1; n <= 3000; ++n) {
      const FingerContact contact = finger.tick({0, 0, kHeight - depth});
      const double k = to + (from - to) * std::exp(-n * kPeriod / tau);
      ASSERT_NEAR(contact.stiffness, k, 2e-6 * kStiffness) << n;
      ASSERT_NEAR(contact.normal_force, k * depth, 2e-5) << n;
      const double step = std::abs(contact.normal_force - last), max = std::abs(from - to) * depth * kPeriod / tau;
      ASSERT_LE(step, 1.001 * max) << n;
      ASSERT_LE(step, kSlewLimit / 50) << n;
      const double energy = std::abs(contact.normal_force - last) * depth / 2;  // change of k depth^2 / 2
      ASSERT_LE(energy, 1.001 * max * depth / 2) << n;
      last = contact.normal_force;
    }
    EXPECT_EQ(finger.tick({0, 0, kHeight - depth}).stiffness, to);  // the target is reached
    from = to;
  }
}

// A slipping finger feels mu(t) N; a finger sticking well within both cones feels nothing. Static friction is never
// below dynamic, in whichever order they are commanded.
TEST(CommandedSurfaces, ChangeFrictionWithoutAStep) {
  OneFinger slipping(openBox(0.8, 0.8), kTakesCommands), sticking(openBox(0.8, 0.8), kTakesCommands);
  const double depth = 0.002, normal = kStiffness * depth, tau = CommandedSurfaces::kTimeConstant;
  for (OneFinger* finger : {&slipping, &sticking}) {
    finger->tick({0, 0, kHeight + 0.001});
    finger->tick({0, 0, kHeight - depth});
  }
  double x = 0;
  FingerContact last;
  for (int n = 0; n < 100; ++n) last = slipping.tick({x += 5e-5, 0, kHeight - depth});
  ASSERT_EQ(last.mode, ContactMode::kSlip);
  const Vec3 held = sticking.tick({1e-4, 0, kHeight - depth}).f_H_W;
  for (OneFinger* finger : {&slipping, &sticking}) {
    set(*finger, 2, 0.3);
    set(*finger, 1, 0.4);
  }
  for (int n = 1; n <= 2000; ++n) {
    const FingerContact contact = slipping.tick({x += 5e-6, 0, kHeight - depth});
    ASSERT_GE(contact.friction_static, contact.friction_dynamic);
    const double mu = 0.3 + 0.5 * std::exp(-n * kPeriod / tau);
    ASSERT_NEAR(contact.friction_dynamic, mu, 2e-6) << n;
    ASSERT_EQ(contact.mode, ContactMode::kSlip) << n;
    ASSERT_NEAR(contact.tangential_force_W.norm(), mu * normal, 1e-4 * normal) << n;
    ASSERT_LE((contact.f_H_W - last.f_H_W).norm(), 1.01 * 0.5 * normal * kPeriod / tau) << n;
    last = contact;
    ASSERT_EQ(sticking.tick({1e-4, 0, kHeight - depth}).f_H_W, held) << n;
  }
}

TEST(CommandedSurfaces, NeitherAllocateNorWait) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  OneFinger finger(openBox(), kTakesCommands);
  finger.tick({0, 0, kHeight + 0.001});
  finger.tick({0, 0, kHeight - 0.002});
  const RealTimeGuard guard;
  for (int i = 0; i < 1000; ++i) {
    set(finger, static_cast<std::size_t>(i % 3), i % 3 == 0 ? 500 + i % 100 : 0.5);
    finger.tick({0, 0, kHeight - 0.002});
  }
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(OpenSurfaces, AreWhatFingersTouchWithinWhatTheSceneLoadedWith) {
  World world = openBox(0.8, 0.6);
  world.scene.materials.emplace_back().stiffness = 500;  // unused material
  const auto open = openSurfaces(world.scene);
  ASSERT_EQ(open.size(), 3u);
  EXPECT_EQ(open[0].name, "material/rubber/stiffness");
  EXPECT_EQ(open[0].min, 1);
  EXPECT_EQ(open[0].max, kStiffness);  // not above: only the loaded value has passed the stability check
  EXPECT_EQ(open[1].name, "material/rubber/friction/static");
  EXPECT_EQ(open[1].max, 1.6);
  EXPECT_EQ(open[2].name, "material/rubber/friction/dynamic");
  EXPECT_EQ(open[2].max, 1.2);
  world.scene.haptics = {.renderer = "penalty", .proxy = false};  // renderer without friction
  EXPECT_EQ(openSurfaces(world.scene).size(), 1u);
  world.scene.haptics = {};
  world.scene.materials[0].changed_friction = {.mu_static = 0.4, .mu_dynamic = 0.3};  // reserved for the experiment
  EXPECT_EQ(openSurfaces(world.scene).size(), 1u);
}

// Several changes between two ticks are applied one per tick, in order; for one slot only the last.
TEST(SettingsTaker, TakesOneChangeATick) {
  SurfaceSettings settings;
  SettingsTaker taker;
  EXPECT_EQ(taker.next(settings), SettingsTaker::kNone);
  settings.slots[7] = {1, 0.1};
  settings.slots[3] = {2, 0.2};
  settings.slots[7] = {3, 0.3};
  settings.newest = 3;
  EXPECT_EQ(taker.next(settings), 3u);
  EXPECT_EQ(taker.next(settings), 7u);
  EXPECT_EQ(taker.next(settings), SettingsTaker::kNone);
}

}  // namespace
}  // namespace presa
