#include "framework/assembly/goal_choice.h"

#include <algorithm>
#include <numbers>

namespace presa {
namespace {

using Status = GoalState::Status;

constexpr double kReachDegree = std::numbers::pi / 180;

std::size_t placeOf(std::int32_t i) { return static_cast<std::size_t>(i); }

bool isNear(const Assembly& assembly, const AssemblyGoal& goal, const PoseDifference& difference, double slack) {
  return difference.distance < slack * assembly.snapDistanceOf(goal) &&
         difference.angle < slack * assembly.snap_angle_deg * kReachDegree;
}

}  // namespace

PoseDifference differenceTo(const AssemblyGoal& goal, const Pose& X_WB) {
  return poseDifference(nearestTurn(goal.X_WB, goal.fold, X_WB.q), X_WB);
}

bool withinReach(const Assembly& assembly, const AssemblyGoal& goal, const Pose& X_WB, double slack) {
  return isNear(assembly, goal, differenceTo(goal, X_WB), slack);
}

std::int32_t missingBefore(const Assembly& assembly, std::size_t goal, const std::vector<GoalState>& goals) {
  for (const std::size_t before : assembly.goals[goal].after) {
    if (goals[before].status != Status::kFilled) return static_cast<std::int32_t>(before);
  }
  return kNoGoal;
}

GoalChoice::GoalChoice(const Assembly& assembly, std::size_t bodies)
    : assembly_(assembly), goals_(assembly.goals.size()), goal_of_(bodies, kNoGoal), refused_(bodies, kNoGoal) {
  std::size_t pairs = 0;
  for (const AssemblyGoal& goal : assembly.goals) pairs += goal.bodies.size();
  candidates_.reserve(pairs);
}

void GoalChoice::leave(std::int32_t goal, std::int32_t body) {
  goal_of_[placeOf(body)] = kNoGoal;
  refused_[placeOf(body)] = goal;
  goals_[placeOf(goal)] = {};
}

void GoalChoice::noteStanding(const std::vector<GoalState>& standing) {
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    GoalState& goal = goals_[g];
    const auto place = static_cast<std::int32_t>(g);
    const bool stood = goal.status == Status::kFilled, stands = standing[g].status == Status::kFilled;
    if (stood && (!stands || standing[g].body != goal.body)) leave(place, goal.body);
    if (!stands) continue;
    if (goal.body != kNoBody && goal.body != standing[g].body && goal_of_[placeOf(goal.body)] == place)
      goal_of_[placeOf(goal.body)] = kNoGoal;
    goal = standing[g];
    goal_of_[placeOf(goal.body)] = place;
  }
}

// Lists every body within reach of a goal that it fits. A body that is already pulled is released a little farther away
// (hysteresis).
void GoalChoice::findCandidates(const ObjectState& objects) {
  candidates_.clear();
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    if (goals_[g].status == Status::kFilled) continue;
    const AssemblyGoal& goal = assembly_.goals[g];
    for (const std::size_t body : goal.bodies) {
      const std::int32_t there = goal_of_[body];
      if (there != kNoGoal && goals_[placeOf(there)].status == Status::kFilled) continue;
      const PoseDifference difference = differenceTo(goal, objects.bodies[body].X_WB_end);
      const bool near = isNear(assembly_, goal, difference, there == static_cast<std::int32_t>(g) ? kLeave : 1);
      if (refused_[body] == static_cast<std::int32_t>(g)) {
        if (!near) refused_[body] = kNoGoal;
        continue;
      }
      if (near) candidates_.push_back({g, body, difference.distance});
    }
  }
}

// Nearest pair first; a goal pulls one body, and a body is pulled to one goal.
void GoalChoice::assign() {
  std::ranges::stable_sort(candidates_, {}, &Candidate::distance);
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    GoalState& goal = goals_[g];
    if (goal.status == Status::kFilled) continue;
    if (goal.body != kNoBody && goal_of_[placeOf(goal.body)] == static_cast<std::int32_t>(g))
      goal_of_[placeOf(goal.body)] = kNoGoal;
    goal = {};
  }
  for (const Candidate& candidate : candidates_) {
    GoalState& goal = goals_[candidate.goal];
    if (goal.body != kNoBody || goal_of_[candidate.body] != kNoGoal) continue;
    goal.body = static_cast<std::int32_t>(candidate.body);
    goal.missing = missingBefore(assembly_, candidate.goal, goals_);
    goal.status = goal.missing == kNoGoal ? Status::kDrawing : Status::kBlocked;
    if (goal.status == Status::kDrawing) goal_of_[candidate.body] = static_cast<std::int32_t>(candidate.goal);
  }
}

void GoalChoice::step(const ObjectState& objects, const std::vector<GoalState>& standing) {
  noteStanding(standing);
  findCandidates(objects);
  assign();
}

}  // namespace presa
