// The spring and damper between handle and tool: both dampings, and the derivative that Newton's method needs.
#include "framework/haptics/virtual_coupling.h"

#include <gtest/gtest.h>

#include "framework/core/math/random.h"
#include "tests/support/one_tool.h"

namespace presa::coupling_test {
namespace {

using test::OneTool;
using test::slab;
using test::toolWorld;

constexpr double kPeriod = 1e-3;

Vec6 motion(const Vec3& way, const Vec3& turn) {
  Vec6 moved;
  moved << way, turn;
  return moved;
}

ToolCoupling coupling(bool along) {
  return {.stiffness = 500, .turn_stiffness = 3, .damping = 20, .turn_damping = 0.1, .damping_along = along};
}

// Oracle: the printed law, v_d = (v . d) d / |d|^2 with d the displacement at the end of the last tick.
TEST(DampingAlong, CountsOnlyTheWayBackToTheHandle) {
  const ToolCoupling along = coupling(true);
  const Pose tool{Vec3::Zero(), Quat::Identity()};
  const auto force = [&](const Vec3& d, const Vec3& way) {
    // d: at the end of the last tick
    return Vec3(
        couplingForce(along, {d - way, Quat::Identity()}, tool, motion(way, Vec3::Zero()), kPeriod).wrench.head<3>() -
        500 * (d - way));
  };
  const Vec3 d(0.002, 0, 0), way(1e-5, 2e-5, -3e-5);
  EXPECT_LT((force(d, way) - Vec3(-20 * 1e-5 / kPeriod, 0, 0)).norm(), 1e-12) << "along the spring";
  EXPECT_LT(force(d, -way).norm(), 1e-12) << "away from the handle";
  EXPECT_LT(force(d, {0, 1e-5, 0}).norm(), 1e-12) << "across";
  EXPECT_LT(force(Vec3::Zero(), way).norm(), 1e-12) << "no direction yet";
  RandomStream random(1, "damping");
  for (int i = 0; i < 100; ++i) {
    const Vec3 stretch(random.normal(), random.normal(), random.normal());
    const Vec3 moved(random.normal(), random.normal(), random.normal());
    const Vec3 printed = -20 / kPeriod * std::max(0.0, moved.dot(stretch)) / stretch.squaredNorm() * stretch;
    EXPECT_LT((force(1e-3 * stretch, 1e-5 * moved) - 1e-5 * printed).norm(), 1e-9);
  }
}

// The wrench changes with a motion of the tool as the stiffness says: exactly for motions, to first order for turns.
TEST(Coupling, HasTheDerivativeOfItsForce) {
  RandomStream random(2, "damping");
  for (const bool along : {false, true}) {
    for (int i = 0; i < 100; ++i) {
      const auto vector = [&](double size) {
        return Vec3(size * Vec3(random.normal(), random.normal(), random.normal()));
      };
      const Pose handle{vector(1e-3), Quat::Identity()}, start = movedBy(handle, motion(vector(5e-4), vector(5e-3)));
      const Vec6 handle_moved = motion(vector(1e-4), vector(1e-3)), moved = motion(vector(1e-4), vector(1e-3));
      const auto at = [&](const Vec6& step) {
        const Pose now = movedBy(start, moved + step);
        return couplingForce(coupling(along), handle, now, moved + step - handle_moved, kPeriod);
      };
      const CouplingForce here = at(Vec6::Zero());
      for (Eigen::Index axis = 0; axis < 6; ++axis) {
        const Vec6 step = 1e-9 * Vec6::Unit(axis);
        const Vec6 change = (at(step).wrench - at(-step).wrench) / 2e-9;
        EXPECT_LT((change + here.stiffness.col(axis)).norm(),
                  0.02 * here.stiffness.col(axis).norm() + (axis < 3 ? 1e-3 : 0.5))
            << axis;
      }
    }
  }
}

// A hand that presses at 20 mm/s on a block that a slab holds moves away from it: nothing is damped. When it comes back,
// both dampings are the same. Oracle: the springs of handle and contact in series, and c v.
TEST(DampingAlong, IsOffInAHardContact) {
  constexpr double kSeries = 1000.0 * 200000 / 201000, kSpeed = 0.02, kDamping = 10;
  for (const bool along : {false, true}) {
    OneTool tool(toolWorld("<tool stiffness=\"1000\" turn_stiffness=\"2\" damping=\"10\" damping_along=\"" +
                               std::string(along ? "true" : "false") + "\"><box size=\"0.04 0.03 0.02\"/></tool>",
                           slab()));
    tool.tick({{0, 0, 0.0101}, Quat::Identity()});
    double z = 0.0101;
    for (int i = 0; i < 150; ++i) tool.tick({{0, 0, z -= kSpeed * kPeriod}, Quat::Identity()});
    const double depth = 0.01 - z, deepening = tool.all().fingers[0].f_H_W.z();
    EXPECT_NEAR(deepening, kSeries * depth + (along ? 0 : kDamping * kSpeed), 0.002) << along;
    tool.rest({{0, 0, z}, Quat::Identity()}, 20);
    for (int i = 0; i < 50; ++i) tool.tick({{0, 0, z += kSpeed * kPeriod}, Quat::Identity()});
    EXPECT_NEAR(tool.all().fingers[0].f_H_W.z(), kSeries * (0.01 - z) - kDamping * kSpeed, 0.002) << along;
    EXPECT_EQ(tool.state().late, 0U);
  }
}

}  // namespace
}  // namespace presa::coupling_test
