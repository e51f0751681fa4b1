#include "modules/dynamics_ode/haptic_rate/meshes_of_ode.h"

#include <gmock/gmock.h>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/framework/geometry/hollow_meshes.h"
#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

using testing::HasSubstr;

const BodyInertia kLight{0.1, Vec3::Zero(), boxInertia(0.1, kCube)};
constexpr Cylinder kRod{.radius = 0.01, .length = 0.05};

Pose aside(double x) { return {{x, 0, 0.1}, Quat::Identity()}; }
std::shared_ptr<const TriMesh> hollow() { return std::make_shared<TriMesh>(test::cup(24, 0.04, 0.044, 0.004, 0.06)); }

/// What the refusal says; empty: none.
std::string refusalOf(const WorldMaker& maker) {
  try {
    refuseMeshesOfOde(*maker.world());
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(MeshesAtHapticRate, WhatOdeWouldCollideAsTrianglesIsRefusedInRealTime) {
  const std::string concave = refusalOf(WorldMaker().table().add(MeshRef{}, aside(0), kLight, {}, hollow()));
  EXPECT_THAT(concave, HasSubstr("E272"));
  EXPECT_THAT(concave, HasSubstr("'body1' is not convex"));
  EXPECT_THAT(refusalOf(WorldMaker().add(MeshRef{}, aside(0), {}, {}, hollow()).box(kCube, 0.1, aside(0.2))),
              HasSubstr("E272"))
      << "a fixed one that a free body may meet";
  const auto cube = std::make_shared<TriMesh>(twelveTriangles());
  EXPECT_THAT(refusalOf(WorldMaker().table().add(MeshRef{}, aside(0), kLight, {}, cube).add(kRod, aside(0.2), kLight)),
              HasSubstr("'body2', a cylinder"));
}

TEST(MeshesAtHapticRate, ConvexOnesAndThoseThatNothingMeetsAreNot) {
  const auto cube = std::make_shared<TriMesh>(twelveTriangles());
  EXPECT_EQ(refusalOf(WorldMaker().table().add(MeshRef{}, aside(0), kLight, {}, cube).box(kCube, 0.1, aside(0.2))), "");
  EXPECT_EQ(refusalOf(WorldMaker().table().add(MeshRef{}, aside(0), {}, {}, hollow())), "") << "nothing is free";
  EXPECT_EQ(refusalOf(WorldMaker().table().box(kCube, 0.1, aside(0)).add(kRod, aside(0.2), kLight)), "");
}

// The shipped scenes of the haptic rate, and a hollow mesh in one of them: only in real time.
TEST(MeshesAtHapticRate, ShippedScenesAreNotRefused) {
  const auto refusal = [](const std::string& scene, bool realtime, const std::vector<std::string>& sets) {
    Diagnostics diagnostics;
    RunOptions options;
    options.realtime = realtime;
    options.bus = BusSettings{.network = "none"};
    RunControl control;
    try {
      Loaded loaded =
          loadWorld({std::string(PRESA_SOURCE_DIR) + "/config/scenes/" + scene, "", sets}, options, diagnostics);
      EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
      const Session session(std::move(loaded), control, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* scene : {"cup_and_ball.xml", "incline.xml", "photographed.xml", "pile.xml", "tea_tray.xml"})
    EXPECT_EQ(refusal(scene, true, {}), "") << scene;
  const std::vector<std::string> whole{"body/cup/physics/mesh/decompose=false"};
  EXPECT_THAT(refusal("cup_and_ball.xml", true, whole), HasSubstr("E272"));
  EXPECT_EQ(refusal("cup_and_ball.xml", false, whole), "");
}

}  // namespace
}  // namespace presa::ode
