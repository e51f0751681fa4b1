#include "framework/assembly/goal_pulls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/goal_pose.h"

namespace presa {
namespace {

using Status = GoalState::Status;

constexpr double kGravity = 9.81;  // converts weights to accelerations [m/s^2]
constexpr double kWellInside = 0.9,
                 kFarInside = 0.8;          // of the workspace: where a body is released, where it is pulled to
constexpr double kCaught = 2, kInVain = 8;  // without progress: when a body is lifted, when carried [s]
constexpr double kProgress = 0.005;         // smallest approach that counts as progress [m]
constexpr double kClear = 0.01;             // height below the target at which it is lifted first [m]
constexpr double kFar = 0.05;  // farther away, a carried body moves at its distance per second instead of 10 mm/s [m]
constexpr double kPlaceDegree = std::numbers::pi / 180;

std::size_t slotOf(std::int32_t i) { return static_cast<std::size_t>(i); }

Vec3 nearestInside(const Assembly::Workspace& workspace, const Vec3& p, double part) {
  const Vec3 half = part * workspace.size / 2;
  return p.cwiseMax(workspace.centre - half).cwiseMin(workspace.centre + half);
}

}  // namespace

GoalPulls::GoalPulls(const Assembly& assembly, std::size_t bodies)
    : assembly_(assembly),
      belongs_(bodies),
      busy_(bodies),
      placed_(assembly.goals.size()),
      pull_time_(assembly.goals.size()),
      settled_(assembly.goals.size()),
      returning_(bodies),
      nearest_(bodies),
      carried_(bodies) {
  for (const AssemblyGoal& goal : assembly.goals) {
    for (const std::size_t body : goal.bodies) belongs_[body] = 1;
  }
  order_.reserve(assembly.goals.size());
  state_.goals.resize(assembly.goals.size());
  snap_constraints_.bodies.reserve(static_cast<std::size_t>(std::ranges::count(belongs_, 1)));  // each once
}

void GoalPulls::take(const ObjectState& objects, const std::vector<GoalState>& chosen) {
  std::ranges::fill(busy_, 0);
  for (std::size_t g = 0; g < state_.goals.size(); ++g) {
    GoalState& goal = state_.goals[g];
    if (goal.status != Status::kFilled) goal = chosen[g];
    if (goal.status != Status::kDrawing && goal.status != Status::kFilled) continue;
    busy_[slotOf(goal.body)] = 1;
    if (goal.status != Status::kDrawing) continue;
    const AssemblyGoal& place = assembly_.goals[g];
    placed_[g] = nearestTurn(place.X_WB, place.fold, objects.bodies[slotOf(goal.body)].X_WB_end.q);
  }
}

void GoalPulls::settle(const ObjectState& objects, double period) {
  for (std::size_t g = 0; g < assembly_.goals.size(); ++g) {
    GoalState& goal = state_.goals[g];
    if (goal.status == Status::kFilled) continue;
    if (goal.status != Status::kDrawing) {
      pull_time_[g] = settled_[g] = 0;
      continue;
    }
    pull_time_[g] += period;
    const BodyMotion& body = objects.bodies[slotOf(goal.body)];
    const PoseDifference difference = poseDifference(placed_[g], body.X_WB_end);
    const bool there = difference.distance < assembly_.tolerance &&
                       difference.angle < assembly_.tolerance_angle_deg * kPlaceDegree && body.v_WB.norm() < kSlow &&
                       body.w_WB.norm() < kSlowTurn;
    settled_[g] = there ? settled_[g] + period : 0;
    if (settled_[g] < kSettle) continue;
    goal.status = Status::kFilled;
    state_.last_filled = static_cast<std::int32_t>(g);
    ++state_.filled;
    order_.push_back(g);
  }
}

void GoalPulls::addSnapConstraint(std::size_t body, const Pose& X_WB, bool fixed, bool turns, double weights,
                                  double speed) {
  snap_constraints_.bodies.push_back({.body = static_cast<std::int32_t>(body),
                                      .fixed = fixed,
                                      .turns = turns,
                                      .X_WB = X_WB,
                                      .rate = kRate,
                                      .speed = speed,
                                      .max_acceleration = weights * kGravity});
}

// Bodies outside the workspace are pulled back. Without progress, for example at the ground's edge or under it, they
// are carried.
void GoalPulls::bringBack(const ObjectState& objects, double period) {
  state_.brought_back = 0;
  if (!assembly_.workspace) return;
  for (std::size_t body = 0; body < belongs_.size(); ++body) {
    if (belongs_[body] == 0 || busy_[body] != 0) continue;
    const Pose& X_WB = objects.bodies[body].X_WB_end;
    const Vec3& p = X_WB.p;
    const auto is_inside = [&](double part) { return nearestInside(*assembly_.workspace, p, part) == p; };
    const bool returns = returning_[body] > 0 ? !is_inside(kWellInside) : !is_inside(1);
    const Vec3 inside = nearestInside(*assembly_.workspace, p, kFarInside);
    const double away = (inside - p).norm();
    if (!returns || returning_[body] <= 0 || away < nearest_[body] - kProgress) {
      nearest_[body] = away;
      returning_[body] = 0;
    }
    if (returns) returning_[body] += period;
    carried_[body] = returns && (carried_[body] != 0 || returning_[body] > kInVain) ? 1 : 0;
    if (!returns) continue;
    ++state_.brought_back;
    Vec3 to = inside;
    // a body that leans against an edge would be held there by friction: lift it first
    if (returning_[body] > kCaught && p.z() < to.z() - kClear) to.head<2>() = p.head<2>();
    const bool carried = carried_[body] != 0;
    addSnapConstraint(body, {to, X_WB.q}, carried, carried, kBringBackWeights,
                      !carried      ? kSpeed
                      : away > kFar ? away
                                    : 0);
  }
}

void GoalPulls::slowDown(const ObjectState& objects) {
  for (std::size_t body = 0; body < belongs_.size(); ++body) {
    if (belongs_[body] == 0 || busy_[body] != 0 || returning_[body] > 0) continue;
    // sleeping bodies stay asleep; awake ones are held even at rest, otherwise they would roll on from one step's push
    if (objects.bodies[body].asleep || objects.bodies[body].v_WB.norm() > kRollsTo) continue;
    snap_constraints_.bodies.push_back({.body = static_cast<std::int32_t>(body),
                                        .turns = false,
                                        .X_WB = objects.bodies[body].X_WB_end,
                                        .max_acceleration = kGrass});
  }
}

void GoalPulls::step(const ObjectState& objects, const std::vector<GoalState>& chosen, double period) {
  take(objects, chosen);
  settle(objects, period);
  snap_constraints_.bodies.clear();
  for (std::size_t g = 0; g < assembly_.goals.size(); ++g) {
    const GoalState& goal = state_.goals[g];
    if (goal.status == Status::kFilled) addSnapConstraint(slotOf(goal.body), placed_[g], true, true, 0, 0);
    if (goal.status == Status::kDrawing)
      addSnapConstraint(slotOf(goal.body), placed_[g], false, true,
                        assembly_.snap_force * std::min(1.0, pull_time_[g] / kRise), kSpeed);
  }
  bringBack(objects, period);
  slowDown(objects);
}

GoalPulls::Released GoalPulls::undo() {
  if (order_.empty()) return {};
  const std::size_t last = order_.back();
  order_.pop_back();
  const Released released{static_cast<std::int32_t>(last), state_.goals[last].body};
  state_.goals[last] = {};
  pull_time_[last] = settled_[last] = 0;
  --state_.filled;
  state_.last_filled = order_.empty() ? kNoGoal : static_cast<std::int32_t>(order_.back());
  return released;
}

}  // namespace presa
