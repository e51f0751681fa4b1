// A line in the hand against bodies for which everything is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "modules/ray/segment.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/mesh_file.h"
#include "tests/support/tool_laws.h"

namespace presa::ray_test {
namespace {

using test::OneTool;
using test::slab;
using test::turned;

constexpr double kHandle = 1000, kTurn = 2, kPoint = 2000000, kRod = 0.001;
/// A rod of 160 mm with its end in the hand.
const char* const kRodTool =
    R"(<tool pos="0 0 0.08" stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.158"/></tool>)";
const Quat& level() {
  static const Quat q = turned({0, 1, 0}, 90);  // the rod points along x
  return q;
}

std::shared_ptr<const World> rayWorld(const std::string& bodies, const std::string& tool = kRodTool) {
  return test::toolWorld(tool, bodies, "", "ray");
}

std::string ball(const std::string& name, const std::string& shape, double x, const std::string& material = "smooth") {
  return "<body name=\"" + name + "\" fixed=\"true\" material=\"" + material + "\" pos=\"" + std::to_string(x) +
         " 0 -0.01\"><haptic>" + shape + "</haptic></body>";
}

// Statics of height w and tilt phi over two balls, each a spring: F_i = -K (w + x_i phi), F_1 + F_2 = k (w + depth),
// F_1 x_1 + F_2 x_2 = c (phi + lean).
struct OnTwo {
  OnTwo(double near, double far, double depth, double lean) {
    Eigen::Matrix2d springs{{kHandle + 2 * kPoint, kPoint * (near + far)},
                            {kPoint * (near + far), kTurn + kPoint * (near * near + far * far)}};
    const Eigen::Vector2d rod = springs.inverse() * Eigen::Vector2d(-kHandle * depth, -kTurn * lean);
    of_near = -kPoint * (rod[0] + near * rod[1]);
    of_far = -kPoint * (rod[0] + far * rod[1]);
  }
  double of_near, of_far;
};

void expectTwoBalls(const std::string& shape, double slack) {
  constexpr double kDepth = 0.002, kNear = 0.05, kFar = 0.1;
  OneTool tool(rayWorld(ball("near", shape, kNear) + ball("far", shape, kFar)));
  tool.tick({{0, 0, 0.02}, level()});
  for (const double degrees : {3.5, 4.3, 5.0}) {
    const double lean = degrees * EIGEN_PI / 180;
    const OnTwo oracle(kNear, kFar, kDepth, lean);
    const FingerContact& contact = tool.rest({{0, 0, kRod - kDepth}, turned({0, 1, 0}, degrees) * level()}, 200);
    double of_near = 0, of_far = 0;
    for (const ToolContact& one : tool.all().contactsOf(contact)) (one.body == 0 ? of_near : of_far) += one.f_H_W.z();
    EXPECT_NEAR(of_near, oracle.of_near, slack * kHandle * kDepth) << degrees;
    EXPECT_NEAR(of_far, oracle.of_far, slack * kHandle * kDepth) << degrees;
    EXPECT_NEAR(contact.t_H_W.y(), -kNear * oracle.of_near - kFar * oracle.of_far, slack * kTurn * lean);
    EXPECT_NEAR(contact.t_H_W.x(), 0, 1e-6) << "about the rod's own axis";
  }
  EXPECT_EQ(tool.state().late, 0U);
}

TEST(Ray, OnTwoBallsFeelsWhereEachOfThemIs) { expectTwoBalls(R"(<sphere radius="0.01"/>)", 0.002); }

TEST(Ray, OnTwoMeshesFeelsWhereEachOfThemIs) {
  for (const int subdivisions : {3, 5, 7}) {
    SCOPED_TRACE(subdivisions);
    const test::MeshFile mesh(makeSphere(0.01, subdivisions), "ball" + std::to_string(subdivisions));
    // the chord of a facet lies below the sphere, and the facet's edge beside the middle
    expectTwoBalls("<mesh file=\"" + mesh.path() + "\"/>", subdivisions == 3 ? 0.1 : subdivisions == 5 ? 0.01 : 0.003);
  }
}

// Oracle: the spring of the handle in series with the two points at the ends of what lies on the slab.
TEST(Ray, LyingFlatIsHeldAtBothEnds) {
  const test::MeshFile mesh(makeBox({0.4, 0.4, 0.1}), "slab");
  const std::string of_mesh =
      "<body name=\"slab\" fixed=\"true\" material=\"smooth\" pos=\"0 0 -0.05\"><haptic><mesh file=\"" + mesh.path() +
      "\"/></haptic></body>";
  const char* const kMiddle =
      R"(<tool stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.1"/></tool>)";
  for (const std::string& body : {slab(), of_mesh}) {
    OneTool tool(rayWorld(body, kMiddle));
    tool.tick({{0.013, 0.007, 0.02}, level()});
    for (const double depth : {0.0005, 0.001, 0.002}) {
      const FingerContact& contact = tool.rest({{0.013, 0.007, kRod - depth}, level()}, 100);
      EXPECT_NEAR(contact.f_H_W.z(), kHandle * depth, 0.01 * kHandle * depth) << depth;
      // the diagonal of the mesh's side is a third place, beside the middle
      EXPECT_LT(tool.state().X_WT.q.angularDistance(level()), 2e-5);
      EXPECT_LT(contact.t_H_W.norm(), kTurn * 2e-5);
    }
    EXPECT_EQ(tool.state().late, 0U);
  }
}

// Oracle: the end of an upright rod is a sphere.
TEST(Ray, ItsEndIsHeldByAFace) {
  OneTool tool(rayWorld(slab("rough")));
  tool.tick({{0, 0, 0.2}, turned({1, 0, 0}, 180)});
  const FingerContact& contact = tool.rest({{0, 0, 0.16 - 0.001}, turned({1, 0, 0}, 180)}, 100);
  EXPECT_NEAR(contact.f_H_W.z(), 1, 0.01);
  EXPECT_EQ(tool.state().points, 1U);
  EXPECT_NEAR(tool.all().contactsOf(contact)[0].p_WP.z(), 0, 1e-5);
}

TEST(Ray, StaysWhereItIs) {
  const test::MeshFile mesh(makeSphere(0.01, 5), "rest");
  for (const char* material : {"smooth", "rough"}) {
    OneTool tool(rayWorld(ball("near", "<mesh file=\"" + mesh.path() + "\"/>", 0.05, material) +
                          ball("far", R"(<box size="0.02 0.02 0.02"/>)", 0.1, material)));
    tool.tick({{0, 0, 0.02}, level()});
    const Pose hand{{0, 0, -0.001}, turned({0, 1, 0.1}, 4) * level()};
    tool.rest(hand, 500);
    const Pose before = tool.state().X_WT;
    const Vec3 force = tool.rest(hand, 1).f_H_W;
    EXPECT_GT(force.norm(), 1);
    tool.rest(hand, 20000);
    EXPECT_LT((tool.state().X_WT.p - before.p).norm(), 1e-8) << material;
    EXPECT_LT(tool.state().X_WT.q.angularDistance(before.q), 1e-6) << material;
    EXPECT_LT((tool.rest(hand, 1).f_H_W - force).norm(), 1e-4) << material;
  }
}

// A rod that a hand drags at 0.3 m/s across a mesh of 327 680 triangles, turning as it goes: the force follows the sphere,
// without steps, and nothing is passed. Oracle: depth of the hand's rod in the exact sphere.
TEST(Ray, RollsOverAFineMeshWithoutSteps) {
  const test::MeshFile mesh(makeSphere(0.05, 7), "fine");
  OneTool tool(rayWorld("<body name=\"ball\" fixed=\"true\" material=\"smooth\"><haptic><mesh file=\"" + mesh.path() +
                            "\"/></haptic></body>",
                        R"(<tool stiffness="1000" turn_stiffness="20"><capsule radius="0.001" length="0.1"/></tool>)"));
  double step = 0, off = 0;
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 3000; ++i) {
    const double depth = 0.001 * std::min(1.0, 1e-3 * i), height = 0.05 + kRod - depth, phase = 6e-3 * i;
    const Vec3 up = Vec3(std::sin(phase), std::cos(0.7 * phase), 0.6).normalized();
    const Quat lie = Quat::FromTwoVectors(Vec3::UnitX(), up) * turned({1, 0, 0}, 30 * std::sin(phase));
    const FingerContact& contact = tool.tick({height * up, lie});
    if (i > 1100) {
      step = std::max(step, (contact.f_H_W - last).norm());
      off = std::max(off, (contact.f_H_W - kHandle * depth * up).norm());
    }
    last = contact.f_H_W;
  }
  std::printf("largest step %.4f N, off by %.4f N, late %u, coarse %u\n", step, off, tool.state().late,
              tool.state().coarse);
  EXPECT_LT(step, 0.05);
  EXPECT_LT(off, 0.05);
  EXPECT_EQ(tool.state().coarse, 0U);
}

TEST(Ray, AHandThatJumpsThroughAPlateLeavesTheRodBehind) {
  const test::MeshFile mesh(makeBox({0.4, 0.4, 0.0005}), "plate");
  for (const std::string& shape :
       {std::string(R"(<box size="0.4 0.4 0.0005"/>)"), "<mesh file=\"" + mesh.path() + "\"/>"}) {
    OneTool tool(
        rayWorld("<body name=\"plate\" fixed=\"true\" material=\"smooth\"><haptic>" + shape + "</haptic></body>"));
    tool.rest({{0, 0, 0.015}, level()}, 10);
    const FingerContact& contact = tool.rest({{0.02, 0.02, -0.3}, turned({1, 1, 0}, 30) * level()}, 500);
    const Pose& X_WT = tool.state().X_WT;
    EXPECT_GT((X_WT * Vec3(0, 0, 0.001)).z(), 0);
    EXPECT_GT((X_WT * Vec3(0, 0, 0.159)).z(), 0);
    EXPECT_GT(contact.f_H_W.z(), 6);
    EXPECT_LT(contact.f_H_W.norm(), 8);
  }
}

// It slides a little while it is still light, and is the less inclined to slide later.
TEST(Ray, StaysOnASlopeUpToTheAngleOfFriction) {
  test::expectStickingOnASlope(
      "ray",
      R"(<tool euler_deg="0 90 0" stiffness="1000" turn_stiffness="2"><capsule radius="0.01" length="0.03"/></tool>)",
      {24, 26, 28, 29});
}

// Oracle: Coulomb. Sliding fast along itself and across itself, the rod feels dynamic friction against its way.
TEST(Ray, SlidesAsCoulombSays) {
  const char* const kMiddle =
      R"(<tool stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.1"/></tool>)";
  for (const double degrees : {0.0, 30.0, 90.0}) {
    SCOPED_TRACE(degrees);
    OneTool tool(rayWorld(slab("rough"), kMiddle));
    tool.tick({{0, 0, 0.02}, level()});
    tool.rest({{0, 0, kRod - 0.001}, level()}, 100);
    const double a = degrees * EIGEN_PI / 180;
    const Vec3 way(std::cos(a), std::sin(a), 0);
    for (int i = 1; i <= 600; ++i) {
      const Vec3 force = tool.tick({1e-4 * i * way + Vec3(0, 0, kRod - 0.001), level()}).f_H_W;
      if (i < 200) continue;
      EXPECT_NEAR(-force.dot(way) / force.z(), 0.4, 0.004) << i;
      EXPECT_LT((force - force.dot(way) * way - force.z() * Vec3::UnitZ()).norm(), 0.004 * force.z()) << i;
    }
  }
}

// Three bodies hold it at once: a mesh, a box and a cylinder.
TEST(Ray, RestsOnThreeBodies) {
  const test::MeshFile mesh(makeSphere(0.01, 4), "third");
  OneTool tool(
      rayWorld(ball("mesh", "<mesh file=\"" + mesh.path() + "\"/>", 0.03) +
               ball("box", R"(<box size="0.02 0.02 0.02"/>)", 0.08) +
               R"(<body name="rod" fixed="true" material="smooth" pos="0.13 0 -0.01" euler_deg="90 0 0"><haptic>
      <cylinder radius="0.01" length="0.04"/></haptic></body>)"));
  tool.tick({{0, 0, 0.02}, level()});
  const FingerContact& contact = tool.rest({{0, 0, kRod - 0.002}, turned({0, 1, 0}, 1) * level()}, 200);
  std::array<double, 3> of{};
  Vec3 torque = Vec3::Zero();
  for (const ToolContact& one : tool.all().contactsOf(contact)) {
    of.at(static_cast<std::size_t>(one.body)) += one.f_H_W.z();
    torque += (one.p_WP - Vec3(0, 0, kRod - 0.002)).cross(one.f_H_W);
  }
  EXPECT_EQ(tool.state().late, 0U);
  EXPECT_NEAR(of[0] + of[1] + of[2], contact.f_H_W.z(), 1e-9);
  EXPECT_LT((torque - contact.t_H_W).norm(), 1e-9);
  EXPECT_GT(std::min({of[0], of[1], of[2]}), -1e-6);
}

TEST(Ray, StartsInsideAMeshAndIsPushedOut) {
  const test::MeshFile mesh(makeBox({0.2, 0.2, 0.1}), "inside");
  OneTool tool(
      rayWorld("<body name=\"slab\" fixed=\"true\" material=\"smooth\" pos=\"0.08 0 -0.05\"><haptic><mesh file=\"" +
               mesh.path() + "\"/></haptic></body>"));
  for (int i = 0; i < 300; ++i) {
    const FingerContact& contact = tool.tick({{-0.06, 0, -0.002}, turned({0, 1, 0}, -1) * level()});
    ASSERT_LE(contact.f_H_W.norm(), 8 + 1e-9) << i;
    ASSERT_TRUE(std::isfinite(contact.t_H_W.norm()));
  }
  EXPECT_GT((tool.state().X_WT * Vec3(0, 0, 0.159)).z(), 0.0009);
}

// A wall that comes at 1 m/s takes the rod along, up to the limits of the handle.
TEST(Ray, AMeshThatMovesIntoARestingRodPushesIt) {
  const test::MeshFile mesh(makeBox({0.4, 0.4, 0.1}), "wall");
  OneTool tool(rayWorld("<body name=\"wall\" material=\"smooth\" pos=\"0 0 -0.06\"><haptic><mesh file=\"" +
                        mesh.path() + R"("/></haptic><physics mass="1"><box size="0.4 0.4 0.1"/></physics></body>)"));
  const Pose hand{{0, 0, 0.02}, level()};
  tool.rest(hand, 5);
  for (int i = 0; i < 40; ++i) {
    BodyMotion& wall = tool.objects().bodies[0];
    wall.X_WB_begin.p.z() = wall.X_WB_end.p.z() = -0.06 + 0.001 * i;
    const FingerContact& contact = tool.tick(hand);
    ASSERT_LT(contact.f_H_W.norm(), 8);
    EXPECT_GT(tool.state().X_WT.p.z() - kRod, wall.X_WB_end.p.z() + 0.05 - 2e-4) << i;
  }
}

// A hand that wanders, turns and presses over real meshes: the rod never goes through a surface, its force keeps its bound.
TEST(Ray, WandersOverRealMeshes) {
  for (const std::string file : {"bunny.obj", "amphora.obj", "cup.obj"}) {
    SCOPED_TRACE(file);
    OneTool tool(
        rayWorld("<body name=\"body\" fixed=\"true\" material=\"rough\"><haptic><mesh file=\"" PRESA_SOURCE_DIR
                 "/config/meshes/" +
                     file + "\"/></haptic></body>",
                 R"(<tool stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.1"/></tool>)"));
    const MeshTree& tree = *tool.world().meshes[0].haptic_tree;
    const Vec3 middle = tree.sphereCenter();
    tool.rest({middle + Vec3(0.2, 0, 0), Quat::Identity()}, 2);
    int touching = 0, through = 0;
    for (int i = 0; i < 20'000; ++i) {
      const double t = 1e-3 * i;
      const Vec3 out(std::cos(0.9 * t), std::sin(0.9 * t), 0.8 * std::sin(0.37 * t));
      const Pose hand{middle + (0.05 + 0.02 * std::sin(3.1 * t)) * out.normalized(),
                      turned({std::sin(0.5 * t), std::cos(0.7 * t), 0.3}, 80 * std::sin(0.61 * t))};
      const FingerContact& contact = tool.tick(hand);
      ASSERT_LT(contact.f_H_W.norm(), 8 + 1e-9) << i;
      touching += tool.state().points > 0;
      if (i % 10 != 0) continue;
      const Pose& X_WT = tool.state().X_WT;
      const Segment axis{X_WT * Vec3(0, 0, -0.05), X_WT * Vec3(0, 0, 0.05)};
      tree.forEachWithin(X_WT.p, 0.06, [&](std::int32_t f) {
        const MeshTree::Facet& facet = tree.facet(f);
        const PreparedTriangle t3(tree.corner(facet, 0), tree.corner(facet, 1), tree.corner(facet, 2));
        through += nearest(axis, t3).where == SegmentNearest::Where::kCrossing;
      });
    }
    std::printf("%s: touching in %d ticks of 20000, late %u, coarse %u, through %d\n", file.c_str(), touching,
                tool.state().late, tool.state().coarse, through);
    EXPECT_GT(touching, 5000);
    EXPECT_EQ(through, 0);
    EXPECT_LT(tool.state().late, 1000U);
  }
}

// The haptic thread runs all of this.
TEST(Ray, NeitherAllocatesNorLocks) {
  const test::MeshFile mesh(makeSphere(0.05, 5), "guarded");
  OneTool tool(rayWorld(mesh.body("ball", "rough") + slab("rough"),
                        R"(<tool stiffness="1000" turn_stiffness="2"><capsule radius="0.001" length="0.1"/></tool>)"));
  tool.rest({{0, 0, 0.06}, level()}, 50);
  const RealTimeGuard guard;
  for (int i = 0; i < 3000; ++i)
    tool.tick({{0.02 * std::sin(0.002 * i), 0.01 * std::sin(0.003 * i), 0.05},
               turned({0, 1, 0}, 5 * std::sin(0.01 * i)) * level()});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_GT(tool.state().points, 0U);
}

TEST(Ray, GivesTheBodyTheOppositeOfWhatTheHandFeels) {
  OneTool tool(rayWorld(slab("rough"), kRodTool));
  test::expectThirdLaw(tool, 1000);
}

TEST(Ray, RefusesWhatSurfacesCouldComeThrough) {
  EXPECT_ANY_THROW(OneTool(rayWorld(slab(), R"(<tool><capsule radius="0.0001" length="0.1"/></tool>)")));
  const auto soft = [](const char* stiffness) {
    return test::toolWorld(kRodTool, slab(), std::string("<ray stiffness=\"") + stiffness + "\"/>", "ray");
  };
  EXPECT_ANY_THROW(OneTool(soft("20000")));
  EXPECT_NO_THROW(OneTool(soft("200000")));
}

// Oracle: nothing moves against anything. Hand, rod and a slab under it travel together; the handle has dampers.
TEST(Ray, TravelsWithABodyWithoutDrag) {
  OneTool tool(rayWorld(R"(<body name="slab" material="rough" pos="0 0 -0.05"><haptic><box size="0.4 0.4 0.1"/></haptic>
    <physics mass="1"><box size="0.4 0.4 0.1"/></physics></body>)",
                        R"(<tool stiffness="1000" turn_stiffness="2" damping="5" turn_damping="0.01">
    <capsule radius="0.001" length="0.1"/></tool>)"));
  tool.tick({{0, 0, 0.02}, level()});
  tool.rest({{0, 0, kRod - 0.001}, level()}, 200);
  for (int i = 1; i <= 200; ++i) {
    const double x = 5e-5 * i;
    BodyMotion& slab = tool.objects().bodies[0];
    slab.X_WB_begin.p.x() = slab.X_WB_end.p.x() = x;
    const Vec3 force = tool.tick({{x, 0, kRod - 0.001}, level()}).f_H_W;
    if (i < 10) continue;
    EXPECT_NEAR(force.x(), 0, 1e-3) << i;
    EXPECT_NEAR(force.z(), 1, 0.01) << i;
  }
}

TEST(Ray, RefusesAToolThatIsNoLine) {
  EXPECT_ANY_THROW(OneTool(rayWorld(slab(), R"(<tool><box size="0.02 0.02 0.02"/></tool>)")));
}

}  // namespace
}  // namespace presa::ray_test
