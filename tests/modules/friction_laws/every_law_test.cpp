// What holds for every law, through the whole haptic rendering: on faces of any orientation, in any direction, over closed
// paths, without a call that waits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/core/math/random.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/friction_track.h"

namespace presa::every_law {
namespace {

using test::kR;
using test::kStiffness;

constexpr double kMuS = 0.8, kMuD = 0.6, kNormal = 2, kSpeed = 0.05;  // [-], [-], [N], [m/s]
constexpr double kCreep = 2e-3;  // speed at which the static coefficient is sought [m/s]

/// A law with some attributes, and what it should render for a slide by the angle to the x axis of the body.
struct Case {
  const char *plugin, *element;
  std::map<std::string, std::string> attributes;
  double (*peak)(double angle);  ///< max of tangential over normal force in a slow slide
  double (*sliding)(double angle);
  friend std::ostream& operator<<(std::ostream& out, const Case& law) { return out << law.plugin; }
};

constexpr double kAcross = 0.5;
/// The coefficient along the grain holds this one in a direction that differs from it by the angle.
double stickingAcross(double angle) { return kMuS / std::hypot(std::cos(angle), std::sin(angle) / kAcross); }
/// The force of the ellipse that resists the slide most.
double slidingAcross(double angle) {
  const double c = std::cos(angle), s = kAcross * std::sin(angle);
  return kMuD * std::hypot(c, kAcross * s) / std::hypot(c, s);
}

const Case kCases[] = {
    {"friction_cone", "friction", {}, [](double) { return kMuS; }, [](double) { return kMuD; }},
    {"friction_viscous",
     "viscous",
     {{"damping", "4"}},
     [](double) { return kMuS; },
     [](double) { return kMuD + 4 * kSpeed / kNormal; }},
    {"friction_stribeck",
     "stribeck",
     {{"speed", "0.05"}, {"viscosity", "0"}},
     [](double) { return kMuS; },
     [](double) { return kMuD + (kMuS - kMuD) * std::exp(-1.0); }},
    {"friction_dahl", "dahl", {{"stiffness", "2000"}}, [](double) { return kMuD; }, [](double) { return kMuD; }},
    {"friction_lugre",
     "lugre",
     {{"stiffness", "2000"}, {"speed", "0.05"}, {"damping", "0"}, {"viscosity", "0.5"}},
     [](double) { return kMuD + (kMuS - kMuD) * std::exp(-std::pow(kCreep / 0.05, 2)) + 0.5 * kCreep / kNormal; },
     [](double) { return kMuD + (kMuS - kMuD) * std::exp(-1.0) + 0.5 * kSpeed / kNormal; }},
    {"friction_membrane", "membrane", {{"stiffness", "400"}}, [](double) { return kMuS; }, [](double) { return kMuD; }},
    {"friction_anisotropic",
     "anisotropic",
     {{"grain", "1 0 0"}, {"across", "0.5"}},
     [](double angle) { return std::max(stickingAcross(angle), slidingAcross(angle)); },
     slidingAcross},
};

class EveryLaw : public testing::TestWithParam<Case> {
 protected:
  /// A block at `X_WB`, its upper side at z = 0 in its own coordinates.
  static World block(const Pose& X_WB) {
    World world = test::worldOf(Box{{0.4, 0.4, 0.4}});
    Material& material = world.scene.materials[0];
    material.friction_static = kMuS;
    material.friction_dynamic = kMuD;
    world.scene.bodies[0].X_WB = X_WB * Pose{Vec3(0, 0, -0.2), Quat::Identity()};
    PluginElement law{GetParam().plugin, GetParam().element, kNoBody, GetParam().attributes, {}};
    law.kind = PluginKind::kFrictionLaw;
    law.material = 0;
    if (std::string(law.plugin) != kDefaultFrictionLaw) world.scene.plugin_elements.push_back(law);
    return world;
  }
  static std::string element() {
    std::string text = "<" + std::string(GetParam().element);
    for (const auto& [name, value] : GetParam().attributes) text += " " + name + "=\"" + value + "\"";
    return GetParam().element == std::string("friction") ? "" : text + "/>";
  }
};

// The finger breaks away, then slides, on faces of twelve orientations in as many directions. 0.5 %: the
// finger's last step before it breaks away is 2 mN, and 4 mN with bristles of 2 N/mm, of 1.2 N: 0.3 %.
TEST_P(EveryLaw, BreaksAwayAndSlidesAsItSaysOnEveryFaceInEveryDirection) {
  const Case& law = GetParam();
  RandomStream random(1, "facets", 0);
  for (int facet = 0; facet < 12; ++facet) {
    const Pose X_WB{Vec3(random.normal(), random.normal(), random.normal()),
                    Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized()};
    const double angle = random.uniform(0, 6.28);
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    test::OneFinger finger(block(X_WB));
    Vec3 p(0, 0, kR - kNormal / kStiffness);
    double peak = 0;
    const auto move = [&](double speed) {
      p += speed * 1e-3 * along;
      const FingerContact& contact = finger.tick(X_WB * p, X_WB.q * (speed * along));
      return contact.tangential_force_W.norm() / contact.normal_force;
    };
    for (int i = 0; i < 4000; ++i) peak = std::max(peak, move(kCreep));
    EXPECT_NEAR(peak / law.peak(angle), 1, 0.005) << facet;
    double ratio = 0;
    for (int i = 0; i < 1000; ++i) ratio = move(kSpeed);
    EXPECT_NEAR(ratio / law.sliding(angle), 1, 0.005) << facet;
  }
}

// From rest on, along any path and under any pressure, the finger never gets back more work than it gave. By the
// trapezium rule, exact for springs.
TEST_P(EveryLaw, GivesNoEnergyOverAnyPath) {
  for (std::uint64_t path = 0; path < 20; ++path) {
    test::FrictionTrack finger(element(), {.mu_static = kMuS, .mu_dynamic = kMuD, .normal_force = kNormal});
    RandomStream random(1, "paths", path);
    const double x = random.uniform(0.1, 20), y = random.uniform(0.1, 20), size = random.logNormal(1e-3, 1);
    Vec3 last = Vec3::Zero(), before = Vec3::Zero();
    double given = 0;
    for (int i = 1; i < 5000; ++i) {
      const double t = 1e-3 * i;
      const Vec3 now = size * Vec3(std::sin(6.28 * x * t), std::sin(6.28 * y * t) + 0.3 * std::sin(200 * t), 0);
      if (path % 2 == 1) finger.press(kNormal * (1 + 0.5 * std::sin(11 * t)));
      const Vec3 force = finger.slide((now - before) / 1e-3);
      given -= 0.5 * (force + last).dot(now - before);
      ASSERT_GE(given, -1e-9) << path << ", " << i;
      last = force;
      before = now;
    }
    EXPECT_GT(given, 0) << path;
  }
}

TEST_P(EveryLaw, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::FrictionTrack finger(element(), {});
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) finger.slide({0.01 * i, 0.02, 0});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, testing::ValuesIn(kCases), [](const auto& law) {
  std::string name = law.param.plugin;
  std::erase(name, '_');
  return name;
});

}  // namespace
}  // namespace presa::every_law
