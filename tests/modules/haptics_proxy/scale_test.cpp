// Mechanics has no length of its own: a world in other units gives the same forces, for every stiffness per length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/core/math/random.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/support/effort.h"

namespace presa::scale {
namespace {

/// A finger that wanders over a floor, a wall and a tilted ball with friction, in a world that is `scale` times as large.
std::vector<Vec3> forces(double scale, bool mesh) {
  World world = test::worldOf(Box{scale * Vec3(0.2, 0.2, 0.02)});
  world.scene.bodies.resize(3, world.scene.bodies[0]);
  world.meshes.resize(3);
  world.inertias.resize(3);
  world.scene.bodies[0].X_WB.p = scale * Vec3(0, 0, -0.01);
  world.scene.bodies[1].haptic->shape = Box{scale * Vec3(0.02, 0.2, 0.1)};
  world.scene.bodies[1].X_WB.p = scale * Vec3(-0.04, 0, 0.04);
  world.scene.bodies[2].X_WB = {scale * Vec3(0.03, 0, 0.01), Quat(0.3, -0.5, 0.7, 0.2).normalized()};
  world.scene.bodies[2].haptic->shape = Sphere{scale * 0.025};
  if (mesh) {
    world.scene.bodies[2].haptic->shape = MeshRef{"ball"};
    world.meshes[2].haptic = std::make_shared<const TriMesh>(makeSphere(scale * 0.025, 4));
  }
  Material& material = world.scene.materials[0];
  material.stiffness = 1000 / scale;
  material.friction_static = 0.5;
  material.friction_dynamic = 0.4;
  world.scene.devices[0].fingertip_radius = scale * 0.008;
  test::OneFinger finger(std::move(world));
  RandomStream random(1, "scale", 0);
  Vec3 p(0, 0, 0.04), goal = p;
  std::vector<Vec3> all;
  for (int i = 0; i < unlessSanitized(20'000, 4'000); ++i) {
    if (i % 200 == 0) goal = {random.uniform(-0.05, 0.06), random.uniform(-0.05, 0.05), random.uniform(-0.005, 0.05)};
    if (p != goal) p += (goal - p).normalized() * std::min(2e-4, (goal - p).norm());
    all.push_back(finger.tick(scale * p).f_H_W);
  }
  return all;
}

// 1: metres; 1000: the same in millimetres; 20 and 1/20. A tick's rounding of 1e-16 grows along a path of 20 000 ticks, in
// which friction remembers. Powers of two are exact.
TEST(Scale, MetresMillimetresAndTwentyfoldGiveTheSameForces) {
  for (const bool mesh : {false, true}) {
    const std::vector<Vec3> metres = forces(1, mesh);
    const auto touching = std::ranges::count_if(metres, [](const Vec3& f) { return !f.isZero(0); });
    ASSERT_GT(touching, unlessSanitized(4000, 800));
    EXPECT_EQ(forces(1.0 / 1024, mesh), metres) << mesh;
    for (const double scale : {1000.0, 20.0, 0.05}) {
      const std::vector<Vec3> other = forces(scale, mesh);
      double worst = 0;
      for (std::size_t i = 0; i < metres.size(); ++i) worst = std::max(worst, (other[i] - metres[i]).norm());
      EXPECT_LT(worst, 1e-9) << scale << (mesh ? ", mesh" : "");
    }
  }
}

}  // namespace
}  // namespace presa::scale
