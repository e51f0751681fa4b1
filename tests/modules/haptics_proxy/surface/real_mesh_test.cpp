// Fingers wander, press and slide over real bodies. Long version: ./dev soak.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"
#include "tests/modules/haptics_proxy/surface/support/wander_run.h"

namespace presa::test {
namespace {

class RealMesh : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    mesh_ = std::make_shared<const TriMesh>(realMesh(GetParam()));  // throws with the name of a missing package
    oracle_ = std::make_unique<const MeshOracle>(*mesh_);
    closed_ = checkMesh(*mesh_).open_edges == 0;
  }
  std::shared_ptr<const TriMesh> mesh_;
  std::unique_ptr<const MeshOracle> oracle_;
  bool closed_ = false;
};

void expectNone(const WanderFaults& faults) {
  EXPECT_EQ(faults.inside, 0) << "ticks; the first at " << faults.first_inside << " s";
  EXPECT_EQ(faults.overlapping, 0) << "ticks; by up to " << faults.deepest * 1e6 << " um";
  EXPECT_EQ(faults.too_strong, 0) << "ticks";
  EXPECT_EQ(faults.not_finite, 0) << "ticks";
  EXPECT_EQ(faults.popped, 0u);
  EXPECT_EQ(faults.lost, 0u) << "ticks";
}

TEST_P(RealMesh, IsNeverEntered) {
  for (const double radius : {0.002, 0.008}) {
    SCOPED_TRACE(testing::Message() << "radius " << radius * 1e3 << " mm");
    WanderRun run(mesh_, *oracle_, {.radius = radius, .friction = 0.5}, 1, false, closed_);
    run.run(1500);
    EXPECT_GT(run.faults().touching, 100);  // otherwise the test would be empty
    expectNone(run.faults());
  }
}

/// Whether a step of 1 to 10 um could bring the fingertip's centre nearer to the HIP: sampled over the directions up to
/// 80 degrees from the straight line.
bool couldComeNearer(const MeshOracle& mesh, const Vec3& p, const Vec3& h, double r) {
  const Vec3 straight = (h - p).normalized(), side = straight.unitOrthogonal(), other = straight.cross(side);
  for (const double angle_deg : {0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    for (int k = 0; k < (angle_deg == 0 ? 1 : 16); ++k) {
      const double turn = k * std::numbers::pi / 8;
      const Vec3 direction =
          std::cos(angle) * straight + std::sin(angle) * (std::cos(turn) * side + std::sin(turn) * other);
      for (const double step : {1e-6, 3e-6, 10e-6}) {
        const Vec3 x = p + step * direction;
        if (mesh.nearest(x, r * (1 - 1e-6)).triangle < 0 && !mesh.crosses(p, x)) return true;
      }
    }
  }
  return false;
}

TEST_P(RealMesh, HoldsTheProxyAtALocalMinimum) {
  constexpr double kRadius = 0.002;
  WanderRun run(mesh_, *oracle_, {.radius = kRadius}, 2, false, closed_);
  int asked = 0, nearer = 0, tick = 0;
  run.run(2000, [&](const FingerContact& felt) {
    // only at sufficient depth for a step of 10 um; every tenth tick, to save time
    if (++tick % 10 != 0 || felt.mode == ContactMode::kNone || (felt.p_WP - felt.p_WH).norm() < 1e-4) return;
    ++asked;
    if (couldComeNearer(*oracle_, felt.p_WP, felt.p_WH, kRadius)) ++nearer;
  });
  RecordProperty("asked", asked);
  RecordProperty("no_minimum", nearer);
  EXPECT_GT(asked, 10);
  EXPECT_EQ(nearer, 0) << "of " << asked << " ticks the proxy was at no local minimum";
  EXPECT_LE(run.faults().worst_growth, 1e-6);  // accuracy of a position: a micrometre
  expectNone(run.faults());
}

INSTANTIATE_TEST_SUITE_P(OfTwenty, RealMesh, testing::ValuesIn(realMeshes()), [](const auto& of) {
  std::string name = of.param;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
});

}  // namespace
}  // namespace presa::test
