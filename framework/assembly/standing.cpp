#include "framework/assembly/standing.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "framework/assembly/goal_choice.h"

namespace presa {
namespace {

using Status = GoalState::Status;

constexpr double kStandingDegree = std::numbers::pi / 180;
constexpr double kSlow = 0.02;  // [m/s]
constexpr double kSlack = 2;    // multiple of the tolerances [-]: a viewer's picture is a period old and interpolated

}  // namespace

AssemblyState standing(const Assembly& assembly, const ObjectState& objects) {
  AssemblyState state;
  state.time = objects.time_end;
  state.goals.resize(assembly.goals.size());
  std::vector<char> taken(objects.bodies.size());
  for (std::size_t g = 0; g < assembly.goals.size(); ++g) {
    for (const std::size_t body : assembly.goals[g].bodies) {
      const BodyMotion& motion = objects.bodies[body];
      const PoseDifference difference = differenceTo(assembly.goals[g], motion.X_WB_end);
      if (taken[body] != 0 || motion.v_WB.norm() > kSlow || difference.distance > kSlack * assembly.tolerance ||
          difference.angle > kSlack * assembly.tolerance_angle_deg * kStandingDegree)
        continue;
      taken[body] = 1;
      state.goals[g] = {Status::kFilled, static_cast<std::int32_t>(body), kNoGoal};
      ++state.filled;
      break;
    }
  }
  for (std::size_t g = 0; g < assembly.goals.size(); ++g) {
    if (state.goals[g].status == Status::kFilled) continue;
    const auto waits = std::ranges::find_if(
        assembly.goals[g].after, [&](std::size_t before) { return state.goals[before].status != Status::kFilled; });
    for (const std::size_t body : assembly.goals[g].bodies) {
      const PoseDifference difference = differenceTo(assembly.goals[g], objects.bodies[body].X_WB_end);
      if (taken[body] != 0 || difference.distance > assembly.snapDistanceOf(assembly.goals[g]) ||
          difference.angle > assembly.snap_angle_deg * kStandingDegree)
        continue;
      const bool blocked = waits != assembly.goals[g].after.end();
      state.goals[g] = {blocked ? Status::kBlocked : Status::kDrawing, static_cast<std::int32_t>(body),
                        blocked ? static_cast<std::int32_t>(*waits) : kNoGoal};
    }
  }
  return state;
}

}  // namespace presa
