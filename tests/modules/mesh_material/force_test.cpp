// The forces of parts and colours: each part's own stiffness and friction, the slope of the energy at their borders,
// and no energy from closed loops.
#include <gtest/gtest.h>

#include <map>

#include "framework/core/math/random.h"
#include "tests/modules/mesh_material/mesh_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::Block, test::board, test::grid, test::kR, test::kStiffness, test::meshWorld, test::OnBlock, test::Round,
    test::roundOf;

constexpr double kTop = 0.02;              // of the board [m]
constexpr double kProxyPlace = 1e-6 * kR;  // the proxy ends within that of its place [m]
constexpr double kCell = 0.005;            // of the board [m]

World softLeft(const std::string& friction = "", const std::string& shares = R"(stiffness="0.4")") {
  return meshWorld(board().file("board.obj"), R"(<material_part name="gel" )" + shares + "/>", friction);
}

/// Colours of the top from white on the left to black on the right, over 40 mm.
double ramp(double x, double) { return std::clamp(0.5 - x / 0.04, 0.0, 1.0); }

// Within 5 mm of a border its vertices are shared.
TEST(MaterialPart, HasItsStiffness) {
  OnBlock finger(softLeft());
  for (const double depth : {0.0005, 0.001, 0.002, 0.004}) {
    const double most = 1e-3 * kStiffness * depth;
    for (const double y : {-0.012, 0.0037, 0.01}) {
      EXPECT_NEAR(finger.force({-0.02, y, kTop + kR - depth}).z(), 0.4 * kStiffness * depth, 0.4 * most) << y;
      EXPECT_NEAR(finger.force({0.02, y, kTop + kR - depth}).z(), kStiffness * depth, most) << y;
      // a vertex on the border has the angles of both sides alike, except for the diagonals' share
      EXPECT_NEAR(finger.force({0, y, kTop + kR - depth}).z(), 0.7 * kStiffness * depth, most) << y;
    }
  }
}

TEST(MaterialColour, IsLinearInItsGreyValue) {
  for (const char* name : {"ramp.ply", "ramp.obj"}) {
    Block block = board();
    block.grey = ramp;
    block.vertices.clear(), block.triangles.clear();
    OnBlock finger(meshWorld(block.build().file(name), R"(<material_colour stiffness="0.3"/>)"));
    for (const double x : {-0.04, -0.0121, -0.003, 0.0, 0.0084, 0.0172, 0.035}) {
      const double share = 0.3 + 0.7 * ramp(x, 0), depth = 0.001;
      // a colour is rounded to 1 / 255
      EXPECT_NEAR(finger.force({x, 0.0037, kTop + kR - depth}).z(), share * kStiffness * depth,
                  (1e-3 + 0.7 / 510) * kStiffness * depth)
          << name << ' ' << x;
    }
  }
}

// Stiffness of one triangle by differences of its normal force; the share is linear in it, E = k s d^2 / 2.
TEST(MaterialPart, PushesTowardsTheSofterSideByTheSlopeOfTheEnergy) {
  OnBlock finger(softLeft());
  constexpr double kStep = 1e-4;
  for (const double depth : {0.001, 0.003}) {
    const auto energy = [&](double x, double y) { return 0.5 * depth * finger.force({x, y, kTop + kR - depth}).z(); };
    for (const auto& [x, y] : {std::pair(-0.002, 0.0037), {-0.0035, 0.0012}, {0.0013, -0.0081}, {0.004, 0.0003}}) {
      const Vec3 pushed = finger.force({x, y, kTop + kR - depth});
      const double most = kStiffness * depth * kProxyPlace / kStep + kStiffness * kProxyPlace;
      EXPECT_NEAR(pushed.x(), -(energy(x + kStep, y) - energy(x - kStep, y)) / (2 * kStep), most) << x;
      EXPECT_NEAR(pushed.y(), -(energy(x, y + kStep) - energy(x, y - kStep)) / (2 * kStep), most) << x;
      // half of 0.6 over a cell
      EXPECT_NEAR(pushed.x(), -0.5 * depth * depth * kStiffness * 0.3 / kCell, most) << x;
    }
  }
}

/// Bound of the trapezium rule's error over the work moved: within triangles the force is quadratic in the place, and
/// at each of `borders` triangle borders it may jump by k d^2 / 2 times twice the slope, of which half a step counts.
double mostGained(const Round& round, int steps, double depth, double slope, int borders, double length) {
  const double step = length / steps, jump = kStiffness * depth * depth * slope;
  return borders * jump * step / 2 + 1e-5 * round.moved;
}

struct Loop {
  const char* name;
  double middle, swing;  // of the depth [m]
};

// A circle of 25 mm across the border; once around in 4 s takes 2000 steps at 500 Hz, 4000 at 1 kHz, 8000 at 2 kHz.
TEST(ALoopAcrossABorder, GainsNoEnergy) {
  for (const Loop& loop : {Loop{"shallow", 0.0005, 0.0002},
                           {"usual", 0.0015, 0.0005},
                           {"deep", 0.003, 0.001},
                           {"touch and go", 0.00025, 0.00125}}) {
    OnBlock finger(softLeft());
    const auto path = [&](double angle) {
      const double depth = loop.middle + loop.swing * std::sin(angle + 0.3);
      return Vec3(0.004 * std::cos(angle), 0.0013 + 0.004 * std::sin(angle), kTop + kR - depth);
    };
    for (const int steps : {4000, 8000}) {
      const Round round = roundOf(finger, steps, path);
      const double deepest = loop.middle + loop.swing;
      // up to 16 borders of triangles of 5 mm on a way of 25 mm
      EXPECT_LT(std::abs(round.net), mostGained(round, steps, deepest, 0.3 / kCell, 16, 0.027)) << loop.name << steps;
      // without the push towards the softer side the round would gain some k 0.6 d^2 / 2
      EXPECT_LT(std::abs(round.net), 0.02 * 0.5 * 0.6 * kStiffness * deepest * loop.swing) << loop.name;
    }
  }
}

/// Ridges and hollows along y, with slopes of 0.5; parts alternate along both axes.
Block folded() {
  Block block;
  block.xs = grid(-0.06, 0.06, 24);
  block.ys = grid(-0.04, 0.04, 16);
  block.z = [](double x, double) { return 0.02 + 0.5 * std::abs(std::remainder(x, 0.04)); };
  block.part = [](double x, double y) { return std::sin(400 * x + 1) * std::sin(300 * y + 0.4) < 0 ? "gel" : "wood"; };
  return block.build();
}

// Over ridges, through hollows and across borders. Ridges lie at x = 0.02 and -0.02, a hollow at 0, in which two planes
// hold the finger.
TEST(ALoopOverAFoldedMesh, GainsNoEnergy) {
  OnBlock finger(meshWorld(folded().file("folded.obj"), R"(<material_part name="gel" stiffness="0.5"/>)"));
  struct Way {
    double x, y, wide;
  };
  for (const Way& way : {Way{0.02, 0, 0.004}, {0, 0.003, 0.004}, {0, -0.001, 0.012}, {-0.019, 0.004, 0.009}}) {
    double worst[2] = {0, 0};
    Round round;
    for (const int finer : {0, 1}) {
      const int steps = finer == 0 ? 4000 : 16000;
      round = roundOf(finger, steps, [&](double angle) {
        const double x = way.x + way.wide * std::cos(angle), y = way.y + way.wide * std::sin(angle);
        const double fold = std::abs(std::remainder(x, 0.04));
        // of the surface that the finger's centre keeps: a cylinder over a ridge, an edge in a hollow
        const double lean = std::sqrt(1.25), over = std::abs(fold - 0.02);
        const double surface =
            over < kR * 0.5 / lean ? 0.03 + std::sqrt(kR * kR - over * over) : 0.02 + 0.5 * fold + kR * lean;
        return Vec3(x, y, surface - 0.0015 - 0.0008 * std::sin(angle + 0.7));
      });
      worst[finer] = std::abs(round.net);
    }
    // 2 % of k d^2 / 2 at 2.3 mm times the difference of the shares
    EXPECT_LT(worst[0], 0.02 * 0.5 * 0.5 * kStiffness * 0.0023 * 0.0023) << way.x << ' ' << way.wide;
    EXPECT_LT(worst[1], std::max(worst[0] / 2, 1e-3 * 0.5 * kStiffness * 0.0023 * 0.0023)) << way.x << ' ' << way.wide;
    EXPECT_GT(round.moved, 1e-4);
  }
}

/// Every vertex at another height, every cell of another part: the finger touches faces, edges, corners and, in
/// hollows, several triangles at once.
Block rough() {
  RandomStream random(5, "heights");
  std::map<std::pair<double, double>, double> heights;
  Block block;
  block.xs = grid(-0.03, 0.03, 12);
  block.ys = grid(-0.03, 0.03, 12);
  block.z = [&](double x, double y) {
    const auto [at, is_new] = heights.try_emplace({x, y}, 0);
    if (is_new) at->second = 0.02 + 0.0012 * random.uniform();
    return at->second;
  };
  block.part = [&](double, double) { return random.uniform() < 0.5 ? "gel" : "wood"; };
  return block.build();
}

TEST(ALoopOverARoughMesh, GainsNoEnergy) {
  OnBlock finger(meshWorld(rough().file("rough.obj"), R"(<material_part name="gel" stiffness="0.5"/>)"));
  for (const double wide : {0.002, 0.005, 0.011}) {
    for (const int steps : {4000, 8000, 16000}) {
      const Round round = roundOf(finger, steps, [&](double angle) {
        return Vec3(wide * std::cos(angle), 0.001 + wide * std::sin(angle),
                    0.0205 + kR - 0.0015 - 0.0008 * std::sin(angle + 0.7));
      });
      // the force jumps at the borders of some thirty triangles on the way, each by up to a hundredth of itself
      EXPECT_LT(std::abs(round.net), (steps < 16000 ? 2e-4 : 1e-4) * round.moved) << wide << ' ' << steps;
      EXPECT_GT(round.moved, 1e-3);
    }
  }
}

constexpr const char* kFriction = R"(<friction static="0.6" dynamic="0.4"/>)";

/// Smallest and largest tangential over normal force while the finger slides along y at x.
std::pair<double, double> slidingRatio(const World& world, double x) {
  OnBlock finger(world);
  finger.force({x, -0.01, kTop + kR + 0.001});
  std::pair<double, double> ratio{1e9, 0};
  constexpr int kTicks = 400;
  for (int i = 0; i <= kTicks; ++i) {
    const FingerContact& contact = finger.tick({x, -0.01 + 0.02 * i / kTicks, kTop + kR - 0.001});
    if (i < kTicks / 2) continue;  // it has broken away
    EXPECT_TRUE(contact.mode == ContactMode::kSlip) << i;
    const double now = contact.tangential_force_W.norm() / contact.normal_force;
    ratio = {std::min(ratio.first, now), std::max(ratio.second, now)};
  }
  return ratio;
}

TEST(MaterialPart, SlidesByItsOwnFriction) {
  const World world = softLeft(kFriction, R"(stiffness="0.4" friction="0.25")");
  const auto gel = slidingRatio(world, -0.03), wood = slidingRatio(world, 0.03), border = slidingRatio(world, 0);
  EXPECT_NEAR(gel.first, 0.25 * 0.4, 0.005 * 0.1);
  EXPECT_NEAR(gel.second, 0.25 * 0.4, 0.005 * 0.1);
  EXPECT_NEAR(wood.first, 0.4, 0.005 * 0.4);
  EXPECT_NEAR(wood.second, 0.4, 0.005 * 0.4);
  EXPECT_NEAR(border.first, 0.625 * 0.4, 0.005 * 0.4);
}

TEST(MaterialPart, BreaksAwayAtItsOwnFriction) {
  const World world = softLeft(kFriction, R"(friction="0.25")");
  for (const auto& [x, mu] : {std::pair(-0.03, 0.25 * 0.6), {0.03, 0.6}}) {
    OnBlock finger(world);
    constexpr double kDepth = 0.001, kStep = 1e-7;
    finger.force({x, 0, kTop + kR + 0.001});
    double held = 0;
    for (double way = 0; way < kDepth; way += kStep) {
      const FingerContact& contact = finger.tick({x, way, kTop + kR - kDepth});
      if (contact.mode == ContactMode::kSlip) break;
      held = contact.tangential_force_W.norm() / contact.normal_force;
    }
    EXPECT_NEAR(held, mu, 0.005 * mu) << x;
  }
}

TEST(MaterialColour, SlidesByItsOwnFriction) {
  Block block = board();
  block.grey = ramp;
  block.vertices.clear(), block.triangles.clear();
  const World world = meshWorld(block.build().file("ramp.ply"), R"(<material_colour friction="0.25"/>)", kFriction);
  for (const auto& [x, share] : {std::pair(-0.03, 1.0), {0.0, 0.625}, {0.03, 0.25}}) {
    const auto ratio = slidingRatio(world, x);
    EXPECT_NEAR(ratio.first, share * 0.4, 0.005 * share * 0.4) << x;
    EXPECT_NEAR(ratio.second, share * 0.4, 0.005 * share * 0.4) << x;
  }
}

// A triangle at the border of two parts has shares of both, and colours multiply them.
TEST(MaterialParts, OfOneMaterialActTogether) {
  Block block = board();
  block.part = [](double x, double y) { return x >= 0 ? "wood" : y < 0 ? "gel" : "felt"; };
  block.grey = ramp;
  block.vertices.clear(), block.triangles.clear();
  const std::string parts =
      R"(<material_part name="gel" stiffness="0.4"/><material_part name="felt" stiffness="0.6"/>)";
  block.build();
  OnBlock finger(meshWorld(block.file("three.obj"), parts + R"(<material_colour stiffness="0.5"/>)"));
  constexpr double kDepth = 0.001;
  const auto share = [&](double x, double y) {
    return finger.force({x, y, kTop + kR - kDepth}).z() / (kStiffness * kDepth);
  };
  EXPECT_NEAR(share(-0.04, -0.015), 0.4, 1e-3);
  EXPECT_NEAR(share(-0.04, 0.015), 0.6, 1e-3);
  EXPECT_NEAR(share(-0.04, 0), 0.5, 1e-3);
  EXPECT_NEAR(share(0.04, 0), 0.5, 1e-3);
  EXPECT_NEAR(share(-0.01, -0.015), 0.4 * 0.875, 2e-3);
  const Round round = roundOf(finger, 8000, [&](double angle) {
    return Vec3(0.009 * std::cos(angle), 0.009 * std::sin(angle), kTop + kR - 0.0015 - 0.0005 * std::sin(angle + 0.3));
  });
  EXPECT_LT(std::abs(round.net), mostGained(round, 8000, 0.002, 0.3 / kCell, 40, 0.06));
}

// Another renderer with a proxy, which names no triangles: the nearest one counts.
TEST(MaterialPart, IsFoundByTheTouchedPointUnderAnotherRenderer) {
  OnBlock finger(meshWorld(board().file("board.obj"), R"(<material_part name="gel" stiffness="0.4"/>)", "",
                           R"(<haptics renderer="scp"/>)"));
  for (const auto& [x, share] : {std::pair(-0.02, 0.4), {-0.0025, 0.55}, {0.02, 1.0}})
    EXPECT_NEAR(finger.force({x, 0.0037, kTop + kR - 0.001}).z(), share * kStiffness * 0.001, 1e-3) << x;
}

TEST(MeshMaterial, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const char* renderer : {"god_object", "scp"}) {
    OnBlock finger(meshWorld(folded().file("folded.obj"),
                             R"(<material_part name="gel" stiffness="0.5" friction="0.5"/>)", kFriction,
                             std::string("<haptics renderer=\"") + renderer + "\"/>"));
    finger.force({0, 0, 0.03});
    const RealTimeGuard guard;
    for (int i = 0; i < 400; ++i) finger.force({1e-4 * (i - 200), 0, 0.0265});
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
}

}  // namespace
}  // namespace presa
