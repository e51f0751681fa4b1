// A full run of a scene with 5 000 bodies.
#include <gtest/gtest.h>

#include "experiments/study/prescribed_finger.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/experiments/study/eye.h"
#include "tests/support/guarded_steps.h"

namespace presa {
namespace {

constexpr int kBodies = 5000, kColumns = 70, kEachFree = 25;
constexpr double kEdge = 0.04, kApart = 0.1, kFingertip = 0.008, kDepth = 0.002, kStiffness = 1000;

Vec3 placeOf(int body) { return {kApart * (body % kColumns), kApart * (body / kColumns), kEdge / 2}; }

/// A floor with separate cubes on it: one in 25 is free, and so is the last.
std::string crowdXml() {
  std::string xml = R"(<scene version="1.0" name="crowd"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness=")" +
                    std::to_string(kStiffness) + R"("><friction static="0.5"/></material></materials>
    <body name="floor" fixed="true" pos="3.5 3.6 -0.05"><physics><box size="8 8 0.1"/></physics></body>)";
  const auto box = [](const std::string& role, const std::string& mass = {}) {
    const std::string edge = std::to_string(kEdge);
    return "<" + role + mass + "><box size=\"" + edge + " " + edge + " " + edge + "\"/></" + role + ">";
  };
  for (int b = 1; b < kBodies; ++b) {
    const bool free = b % kEachFree == 0 || b + 1 == kBodies;
    const Vec3 p = placeOf(b);
    xml += "<body name=\"cube" + std::to_string(b) + "\" fixed=\"" + (free ? "false" : "true") + "\" pos=\"" +
           std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\">" + box("haptic") +
           box("physics", free ? " mass=\"0.1\"" : "") + "</body>";
  }
  return xml + "<devices><device role=\"index\" fingertip_radius=\"" + std::to_string(kFingertip) +
         "\"/></devices></scene>";
}

// The finger presses on the last free cube and feels its material's spring, k times the depth; the other cubes stay in
// place. No tick of the haptic group allocates or takes a lock, the first one included.
TEST(Crowd, OfFiveThousandBodiesOneIsTouched) {
  Diagnostics diagnostics;
  RunOptions options;
  options.bus = BusSettings{.network = "none"};
  Loaded loaded = loadWithoutDevices(
      {crowdXml(), "crowd.xml", R"(<rig version="1.0" name="desk"><device role="index" driver="scripted"/></rig>)"},
      options, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  ASSERT_EQ(loaded.world->scene.bodies.size(), static_cast<std::size_t>(kBodies));

  Session::Options session_options;
  const Vec3 top = placeOf(kBodies - 1) + Vec3(0, 0, kEdge / 2 + kFingertip);
  session_options.devices.push_back(std::make_unique<PrescribedFinger>([top](double time) {
    const double height = std::max(-kDepth, 0.01 - 0.05 * time);
    return PrescribedFinger::State{top + Vec3(0, 0, height), Vec3(0, 0, height > -kDepth ? -0.05 : 0)};
  }));
  auto made = std::make_unique<test::Eye>();
  const test::Eye& eye = *made;
  session_options.more.push_back(std::move(made));
  RunControl control;
  Session session(std::move(loaded), control, std::move(session_options));
  test::GuardedSteps steps(session);
  steps.run(500);
  EXPECT_EQ(steps.violation(RateGroup::kHaptic), "");
  const ObjectState& objects = eye.objects.value();
  ASSERT_EQ(objects.count(), kBodies);
  EXPECT_EQ(objects.faults, 0U);
  const FingerContact& finger = eye.contact->fingers[0];
  EXPECT_EQ(finger.body, kBodies - 1);
  // the floor deflects by the depth at which the cube rests, less than 0.1 mm
  EXPECT_NEAR(finger.normal_force, kStiffness * kDepth, kStiffness * 1e-4);
  for (int b = 1; b < kBodies; ++b)
    ASSERT_LT((objects.bodies[static_cast<std::size_t>(b)].X_WB_end.p - placeOf(b)).norm(), 1e-4) << b;
}

}  // namespace
}  // namespace presa
