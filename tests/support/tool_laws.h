#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/one_tool.h"

/// What every renderer of tools has to give.
namespace presa::test {

/// A block that is moved and turned over a slab, into it and out of it. The bodies bear the opposite of what the hand feels,
/// but for what accelerates a tool with mass.
inline void expectThirdLaw(OneTool& tool, int ticks) {
  tool.tick({{0, 0, 0.02}, Quat::Identity()});
  for (int i = 0; i < ticks; ++i) {
    const Pose hand{{0.01 * std::sin(0.01 * i), 0.01 * std::cos(0.013 * i), 0.01 + 0.004 * std::sin(0.02 * i)},
                    turned({std::sin(0.03 * i), 1, 0.2}, 20 * std::sin(0.005 * i))};
    const FingerContact& contact = tool.tick(hand);
    Vec3 force = tool.state().f_H_W, torque = tool.state().t_H_W;
    for (const ToolContact& one : tool.all().contactsOf(contact)) {
      force += one.f_H_W;
      torque += (one.p_WP - hand.p).cross(one.f_H_W);
    }
    EXPECT_LT((force - contact.f_H_W).norm(), 1e-12) << i;
    EXPECT_LT((torque - contact.t_H_W).norm(), 1e-12) << i;
  }
}

/// Oracle: pressed straight down on a slope of material "rough", a block of 20 mm stays where the tangent of the slope is
/// below static friction, 0.5.
inline void expectStickingOnASlope(const std::string& renderer, const std::string& block,
                                   const std::vector<double>& angles = {24, 26, 27.2, 29}) {
  for (const double degrees : angles) {
    SCOPED_TRACE(degrees);
    const double a = degrees * EIGEN_PI / 180;
    OneTool tool(toolWorld(block,
                           R"(<body name="slope" fixed="true" material="rough" euler_deg="0 )" +
                               std::to_string(degrees) + R"( 0"><haptic><box size="0.4 0.4 0.1"/></haptic></body>)",
                           "", renderer));
    const Quat lie = turned({0, 1, 0}, degrees);
    const Vec3 up(std::sin(a), 0, std::cos(a)), downhill(std::cos(a), 0, -std::sin(a));
    tool.tick({0.07 * up, lie});
    for (int i = 0; i <= 400; ++i) tool.tick({0.06 * up - Vec3(0, 0, 5e-6 * i), lie});
    const Vec3 begin = tool.state().X_WT.p;
    tool.rest({0.06 * up - Vec3(0, 0, 0.002), lie}, 100);
    EXPECT_LT((tool.state().X_WT.p - begin).norm(), 1e-5) << "it rests";
    const double down = (tool.state().X_WT.p - 0.06 * up).dot(downhill);
    if (std::tan(a) < 0.5) {
      EXPECT_LT(down, 5e-5);
    } else {
      EXPECT_GT(down, 0.1 * 0.002 * std::sin(a));
    }
  }
}

}  // namespace presa::test
