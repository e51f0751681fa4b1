// A peg of 20 mm in holes that leave it 1, 0.2 and 0.05 mm: driven in with 5 N and wobbled by 20 degrees for a minute.
#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <numbers>

#include "framework/haptics/virtual_coupling.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::peg_test {
namespace {

using test::OneTool;
using test::toolWorld;
using test::turned;

constexpr double kPi = std::numbers::pi;
constexpr double kPegRadius = 0.01, kVoxel = 0.05 / 200;

/// A block of 50 x 50 x 30 mm on z = 0 with a blind hole 20 mm deep, of `radius`.
TriMesh socket(double radius) {
  constexpr int kSides = 192;
  TriMesh mesh;
  const auto ring = [&](double z, auto place) {
    for (int i = 0; i < kSides; ++i) {
      const double a = 2 * kPi * i / kSides, r = place(a);
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  };
  const auto square = [](double a) { return 0.025 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))); };
  const auto circle = [&](double) { return radius / std::cos(kPi / kSides); };
  ring(0, square);
  ring(0.03, square);
  ring(0.03, circle);
  ring(0.01, circle);
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, 0.01);
  const int below = 4 * kSides, above = below + 1;
  for (int i = 0; i < kSides; ++i) {
    const int j = (i + 1) % kSides;
    for (int k = 0; k < 3 * kSides; k += kSides) {
      mesh.triangles.push_back({k + i, k + j, k + j + kSides});
      mesh.triangles.push_back({k + i, k + j + kSides, k + i + kSides});
    }
    mesh.triangles.push_back({below, j, i});
    mesh.triangles.push_back({above, 3 * kSides + i, 3 * kSides + j});
  }
  return mesh;
}

test::MeshFile socketFor(double clearance) {
  return {socket(kPegRadius + clearance / 2), "socket_" + std::to_string(std::lround(1e9 * clearance))};
}

const char* const kPeg = R"(<tool stiffness="1000" turn_stiffness="2"><cylinder radius="0.01" length="0.06"/></tool>)";

struct Wobbled {
  double largest = 0;       // force on the hand [N]
  double torque = 0;        // [N m]
  double deepest = 0;       // [m]
  double largest_step = 0;  // of the force from one tick to the next [N]
  double energy = 0;        // to the hand in whole turns of the wobble [J]
  double deepest_peg = 1;   // lowest height of the peg's end [m]
  std::uint32_t late = 0;   // ticks
};

const char* const kStiff = R"(<pointshell stiffness="500000"/>)";

Wobbled wobble(double clearance, const std::string& material, double seconds, const std::string& settings = kStiff) {
  const test::MeshFile socket = socketFor(clearance);
  OneTool tool(toolWorld(kPeg, socket.body("socket", material), settings));
  const Pose above{{0, 0, 0.062}, Quat::Identity()};
  tool.tick(above);
  // 5 mm beyond the hole's bottom: 5 N
  const double down = 0.035;
  for (int i = 0; i < 1000; ++i) tool.tick({{0, 0, above.p.z() + (down - above.p.z()) * i / 1000}, Quat::Identity()});
  Wobbled result;
  Vec3 last_force = tool.rest({{0, 0, down}, Quat::Identity()}, 200).f_H_W;
  const std::uint32_t late = tool.state().late;
  const auto hand = [&](int i) {
    const double t = 1e-3 * i, lean = 20 * std::min(1.0, t) * std::sin(2 * kPi * t);
    return Pose{{0, 0, down}, turned({std::cos(0.2 * kPi * t), std::sin(0.2 * kPi * t), 0}, lean)};
  };
  for (int i = 1; i <= static_cast<int>(1000 * seconds); ++i) {
    const Pose before = hand(i - 1), now = hand(i);
    const FingerContact& contact = tool.tick(now);
    result.largest = std::max(result.largest, contact.f_H_W.norm());
    result.torque = std::max(result.torque, contact.t_H_W.norm());
    result.deepest = std::max(result.deepest, tool.state().depth);
    result.largest_step = std::max(result.largest_step, (contact.f_H_W - last_force).norm());
    result.deepest_peg = std::min(result.deepest_peg, tool.state().X_WT.p.z() - 0.03);
    last_force = contact.f_H_W;
    if (i > 1000) result.energy += contact.t_H_W.dot(turnBetween(before.q, now.q));
  }
  result.late = tool.state().late - late;
  return result;
}

class Peg : public testing::TestWithParam<std::tuple<double, const char*>> {};

TEST_P(Peg, IsDrivenInAndWobbledForAMinute) {
  const auto [clearance, material] = GetParam();
  const Wobbled w = wobble(clearance, material, 61);
  RecordProperty("deepest_um", std::to_string(1e6 * w.deepest));
  std::printf(
      "clearance %.2f mm %s: force %.2f N, step %.3f N, torque %.3f N m, depth %.1f um, energy %.2e J, late %u\n",
      1e3 * clearance, material, w.largest, w.largest_step, w.torque, 1e6 * w.deepest, w.energy, w.late);
  EXPECT_LT(w.deepest, kVoxel) << "less than a voxel deep";
  EXPECT_GT(w.deepest_peg, 0.01 - kVoxel) << "does not leave through the bottom";
  EXPECT_LE(w.largest, 8.0 + 1e-9);
  EXPECT_LE(w.torque, 0.5 + 0.02 * 8);
  EXPECT_LT(w.largest_step, 0.5) << "no jump";
  EXPECT_LE(w.energy, 1e-6) << "no energy to the hand in whole turns";
}

INSTANTIATE_TEST_SUITE_P(Clearances, Peg,
                         testing::Combine(testing::Values(0.001, 0.0002, 0.00005), testing::Values("smooth", "rough")));

// With a mass of its own the peg keeps to the same bounds, and what it swings back it got from the hand before.
TEST(PegWithMass, IsWobbledWithoutGivingEnergy) {
  for (const double clearance : {0.001, 0.00005}) {
    const Wobbled w = wobble(clearance, "rough", 11, R"(<pointshell stiffness="500000" mass="0.15"/>)");
    std::printf(
        "clearance %.2f mm, 150 g: force %.2f N, step %.3f N, torque %.3f N m, depth %.1f um, energy %.2e J, late %u\n",
        1e3 * clearance, w.largest, w.largest_step, w.torque, 1e6 * w.deepest, w.energy, w.late);
    EXPECT_LT(w.deepest, kVoxel);
    EXPECT_GT(w.deepest_peg, 0.01 - kVoxel);
    EXPECT_LT(w.largest_step, 0.5) << "no jump";
    EXPECT_LE(w.energy, 1e-6) << "no energy to the hand in whole turns";
  }
}

// At rest in the hole nothing hums: the force of a hand that holds still is constant.
TEST(PegAtRest, DoesNotHum) {
  for (const double clearance : {0.001, 0.0002, 0.00005}) {
    const test::MeshFile socket = socketFor(clearance);
    OneTool tool(toolWorld(kPeg, socket.body("socket", "rough")));
    tool.tick({{0, 0, 0.062}, Quat::Identity()});
    for (int i = 0; i < 1000; ++i) tool.tick({{0, 0, 0.062 - 0.027e-3 * i}, Quat::Identity()});
    const Pose hand{{0.001, 0, 0.035}, turned({1, 2, 0}, 8)};
    Vec3 last = tool.rest(hand, 500).f_H_W;
    double largest = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 now = tool.tick(hand).f_H_W;
      largest = std::max(largest, (now - last).norm());
      last = now;
    }
    EXPECT_LT(largest, 1e-3) << clearance;
    EXPECT_GT(last.norm(), 1);
  }
}

}  // namespace
}  // namespace presa::peg_test
