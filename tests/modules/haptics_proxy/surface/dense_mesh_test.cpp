// A scanned or finely tessellated body is rendered as well as a coarse one, without gaps in coverage.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/shapes.h"

namespace presa::test {
namespace {

constexpr double kSphere = 0.05;

struct Slide {
  double speed;       ///< speed of the fingertip's centre [m/s]
  double press;       ///< depth [m]
  double time = 0.6;  ///< [s]
};

struct Felt {
  std::uint32_t lost = 0, popped = 0;
  double worst_normal = 0;      ///< error relative to k depth
  double worst_tangential = 0;  ///< relative to the normal force
  double worst_step = 0;        ///< force change from tick to tick [N]
};

/// From above down to the surface, then along a great circle oblique to the rows of triangles, with a speed ramp of 0.1
/// s. The fingertip's centre stays outside the sphere, so the exact answer is its projection onto it: depth = radius +
/// sphere - |p_WH|.
Felt slide(FingerRig& rig, const Slide& how) {
  const double radius = rig.touch().radius, orbit = kSphere + radius - how.press;
  const Vec3 start = Vec3(0.31, 0.83, 0.47).normalized(), side = start.cross(Vec3(0.7, -0.2, 0.4)).normalized();
  for (double way = 0.02; way > 0; way -= 0.2e-3) rig.tick((orbit + way) * start);  // 0.2 m/s
  for (int i = 0; i < 20; ++i) rig.tick(orbit * start);
  Felt felt;
  const std::uint32_t lost = rig.all().coverage_lost, popped = rig.all().pop_through;
  Vec3 last = rig.tick(orbit * start).f_H_W;
  double angle = 0;
  for (int i = 0; i < static_cast<int>(how.time * 1000); ++i) {
    angle += how.speed * std::min(1.0, i / 100.0) * 1e-3 / orbit;
    const Vec3 outwards = std::cos(angle) * start + std::sin(angle) * side;
    const FingerContact& contact = rig.tick(orbit * outwards);
    const double ideal = rig.touch().stiffness * how.press, normal = contact.f_H_W.dot(outwards);
    felt.worst_normal = std::max(felt.worst_normal, std::abs(normal - ideal) / ideal);
    felt.worst_tangential = std::max(felt.worst_tangential, (contact.f_H_W - normal * outwards).norm() / ideal);
    felt.worst_step = std::max(felt.worst_step, (contact.f_H_W - last).norm());
    last = contact.f_H_W;
  }
  felt.lost = rig.all().coverage_lost - lost;
  felt.popped = rig.all().pop_through - popped;
  const Vec3 away = std::cos(angle) * start + std::sin(angle) * side;
  for (double way = 0; way < 0.02; way += 0.2e-3) rig.tick((orbit + way) * away);
  for (double back = 1; back > 0; back -= 0.005) {  // return round the sphere, far from it
    const Vec3 free = std::cos(angle * back) * start + std::sin(angle * back) * side;
    rig.tick((orbit + 0.02) * free);
  }
  return felt;
}

void expectGood(const Felt& felt, const FingerRig& rig, const Slide& how, int n) {
  SCOPED_TRACE(testing::Message() << 20 * n * n << " triangles, " << rig.touch().radius * 1e3 << " mm, " << how.speed
                                  << " m/s, collision " << rig.touch().collision_hz << " Hz");
  EXPECT_EQ(felt.lost, 0u);
  EXPECT_EQ(felt.popped, 0u);
  EXPECT_LE(felt.worst_normal, 0.01);
  EXPECT_LE(felt.worst_tangential, 0.01 + facetAngle(n));
  // the spring's end moves with the finger, and the force may rotate by the angle of two facets
  const double force = rig.touch().stiffness * how.press;
  EXPECT_LE(felt.worst_step, 2 * rig.touch().stiffness * how.speed * 1e-3 + 2 * facetAngle(n) * force);
}

void slideOver(int n, double radius, const std::vector<Slide>& ways, const std::vector<double>& rates) {
  const auto mesh = std::make_shared<const TriMesh>(icosphere(n, kSphere));
  for (const double rate : rates) {
    FingerRig rig(mesh, {.radius = radius, .collision_hz = rate});
    for (const Slide& how : ways) expectGood(slide(rig, how), rig, how, n);
  }
}

const std::vector<double> kRates{10, 100, 1000};

TEST(DenseMesh, Of162ThousandTrianglesIsFeltAsASphere) { slideOver(90, 0.008, {{0.2, 0.004}, {0.5, 0.004}}, kRates); }
TEST(DenseMesh, Of318ThousandTrianglesIsFeltAsASphere) { slideOver(126, 0.008, {{0.2, 0.004}}, kRates); }
TEST(DenseMesh, Of648ThousandTrianglesIsFeltAsASphere) { slideOver(180, 0.003, {{0.3, 0.002}}, kRates); }
TEST(DenseMesh, Of1250ThousandTrianglesIsFeltAsASphere) {
  slideOver(250, 0.008, {{0.05, 0.004}, {0.1, 0.004}, {0.5, 0.004}, {2, 0.004, 0.3}}, kRates);
}
TEST(DenseMesh, OfFiveMillionTrianglesIsFeltAsASphere) { slideOver(500, 0.008, {{0.2, 0.004}}, {100}); }

}  // namespace
}  // namespace presa::test
