#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

// Every shape extends 0.05 m from its origin along +-x and +-z (the capsule 0.05 along x, 0.1 along z).
struct Named {
  const char* name;
  Shape shape;
  double reach_x, reach_z;
};

std::shared_ptr<const TriMesh> cubeMesh(double half) {
  auto mesh = std::make_shared<TriMesh>();
  for (int i = 0; i < 8; ++i) {
    mesh->vertices.emplace_back((i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half);
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

const std::vector<Named>& shapes() {
  static const std::vector<Named> all{{"box", Box{{0.1, 0.1, 0.1}}, 0.05, 0.05},
                                      {"sphere", Sphere{0.05}, 0.05, 0.05},
                                      {"cylinder", Cylinder{0.05, 0.1}, 0.05, 0.05},
                                      {"capsule", Capsule{0.05, 0.1}, 0.05, 0.1},
                                      {"mesh", MeshRef{}, 0.05, 0.05}};
  return all;
}

// ODE's normal points from its second geometry into its first; Presa's from A into B, with the force on B. The test
// runs every pair of shapes in both orders, along two axes, with either or both of them free: a body on the + side of
// another is pushed to +. Depth: 2 mm by construction; 1 % tolerance for the engine's support mapping.
class Conventions : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(Conventions, NormalPointsFromAIntoBAndDepthIsPositive) {
  const Named& first = shapes()[static_cast<std::size_t>(std::get<0>(GetParam()))];
  const Named& second = shapes()[static_cast<std::size_t>(std::get<1>(GetParam()))];
  const double overlap = 0.002;
  const BodyInertia free{0.1, Vec3::Zero(), 1e-4 * Mat3::Identity()};
  for (const bool along_x : {true, false}) {
    for (const int moving : {1, 2, 3}) {  // bit 0: the first is free, bit 1: the second
      const double gap = (along_x ? first.reach_x + second.reach_x : first.reach_z + second.reach_z) - overlap;
      const Vec3 axis = along_x ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ());
      WorldMaker maker;
      maker.gravity(Vec3::Zero());
      maker.add(first.shape, {}, (moving & 1) != 0 ? free : BodyInertia{}, {}, cubeMesh(0.05));
      maker.add(second.shape, {gap * axis, Quat::Identity()}, (moving & 2) != 0 ? free : BodyInertia{}, {},
                cubeMesh(0.05));
      Runner runner(maker.world());
      runner.step();
      ASSERT_FALSE(runner.bodies.contacts().empty()) << first.name << " " << second.name << " " << along_x << moving;
      for (const BodyContact& contact : runner.bodies.contacts()) {
        const double side = contact.B == 1 ? 1 : -1;
        if (std::string(first.name) == "mesh" && std::string(second.name) == "mesh") continue;  // see README
        EXPECT_GT(side * contact.nhat_AB_W.dot(axis), 0.999) << first.name << " " << second.name;
        EXPECT_GE(contact.depth, 0);
        EXPECT_LE(contact.depth, 1.01 * overlap) << first.name << " " << second.name;
        EXPECT_NEAR(contact.p_W.dot(axis), (along_x ? first.reach_x : first.reach_z) - overlap / 2, 0.51 * overlap);
      }
      // the force agrees with the normal: they move apart
      EXPECT_GT((runner[1].v_WB - runner[0].v_WB).dot(axis), 0) << first.name << " " << second.name;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(AllPairs, Conventions, testing::Combine(testing::Range(0, 5), testing::Range(0, 5)),
                         [](const auto& param) {
                           return std::string(shapes()[static_cast<std::size_t>(std::get<0>(param.param))].name) + "_" +
                                  shapes()[static_cast<std::size_t>(std::get<1>(param.param))].name;
                         });

// A geometry offset from the body frame, with yet another centre of mass, must lie at X_WB X_BG.
TEST(Placement, GeometryLiesWhereTheSceneSays) {
  const Pose X_WB{{0.3, 0.1, 0.2}, turn(radians(90), Vec3::UnitY())};
  const Pose X_BG{{0.05, 0, 0.01}, turn(radians(90), Vec3::UnitX())};
  const Pose X_WG = X_WB * X_BG;
  for (const bool fixed : {true, false}) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero());
    maker.add(Box{{0.02, 0.04, 0.06}}, X_WB,
              fixed ? BodyInertia{} : BodyInertia{1, {0.01, 0.02, 0.03}, 1e-3 * Mat3::Identity()}, X_BG);
    // a probe that overlaps the far face of the box, 0.03 along G's z, by 1 mm
    maker.add(Sphere{0.01}, {X_WG * Vec3(0, 0, 0.039), Quat::Identity()}, {0.1, Vec3::Zero(), 1e-4 * Mat3::Identity()});
    Runner runner(maker.world());
    EXPECT_LT((runner[0].X_WB_end.p - X_WB.p).norm(), 1e-15);
    runner.step();
    ASSERT_EQ(runner.bodies.contacts().size(), 1U);
    const BodyContact& contact = runner.bodies.contacts()[0];
    EXPECT_NEAR(contact.depth, 0.001, 1e-9);
    EXPECT_LT((contact.nhat_AB_W - X_WG.q * Vec3::UnitZ()).norm(), 1e-9);
  }
}

// A box rests on a mesh of many triangles as on a plane, on four corners: duplicates at triangle edges are merged, and
// the outermost contacts are kept.
TEST(Placement, BoxRestsOnAMeshTable) {
  WorldMaker maker;
  maker.add(MeshRef{}, {{0, 0, -0.5}, Quat::Identity()}, {}, {}, cubeMesh(0.5));
  maker.box({0.08, 0.08, 0.08}, 0.2, {{0.01, 0.02, 0.0401}, turn(0.3, Vec3::UnitZ())});
  Runner runner(maker.world());
  runner.run(3);
  EXPECT_NEAR(runner[1].X_WB_end.p.z(), 0.04, 1e-4);
  EXPECT_LT(runner[1].v_WB.norm(), 1e-4);
  EXPECT_LE(runner.bodies.contacts().size(), 8U);
}

// A cube that rolled onto another side lies on the table with edges parallel to rounding. ODE alone then misses the
// contact in one of 60 headings, and the cube sinks.
TEST(Placement, CubeIsFoundOnEachOfItsSidesAtAnyHeading) {
  const Vec3 edges = Vec3::Constant(0.05);
  for (int n = 0; n < 500; ++n) {
    const double heading = 3 * std::sin(n);
    const Quat flat(std::cos(heading / 2), 1e-16 * std::sin(2 * n), 1e-16 * std::sin(3 * n), std::sin(heading / 2));
    Runner runner(
        WorldMaker().table().box(edges, 0.1, {{0.1, 0.2, 0.0245}, flat * turn(radians(90), Vec3::UnitX())}).world());
    runner.step();
    ASSERT_EQ(runner.bodies.contacts().size(), 4U) << n;
    for (const BodyContact& contact : runner.bodies.contacts()) EXPECT_NEAR(contact.depth, 0.0005, 1e-9) << n;
  }
}

}  // namespace
}  // namespace presa::ode
