#include "devices/assembling_hand/choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "framework/scene/goal_pose.h"

namespace presa::assembling {
namespace {

// What each trouble weighs, against a metre of way.
constexpr double kWay = 1, kFingerBlocked = 3, kCovered = 7, kLies = 0.5, kOnItsHead = 2, kPlaceBlocked = 8,
                 kPlaceTaken = 8, kStandsUp = 3, kMoves = 5, kInVain = 1;
constexpr double kOccupied = 0.004;    // about the middle of a place [m]
constexpr double kFlat = 0.02;         // half a height of which fingertips on the ground reach too little [m]
constexpr double kFingerNeeds = 0.85;  // of its radius: a touch is no obstacle
constexpr int kHigh = 6;               // radii above a grasp through which a finger comes down

}  // namespace

Chooser::Chooser(const World& world, double fingertip, double opening)
    : world_(world), surroundings_(world), fingertip_(fingertip), opening_(opening) {}

// How many of the two fingers find something in their way, closed or open, from above down to the body.
double Chooser::obstacles(const ObjectState& objects, const Grasp& grasp, std::size_t body,
                          const Pose& X_WB) const noexcept {
  Vec3 p_W = X_WB * grasp.p_BC;
  p_W.z() = std::max(p_W.z(), kOverGround * fingertip_);
  const Vec3 a_W = X_WB.q * grasp.a_B;
  double blocked = 0;
  for (const double side : {-1.0, 1.0}) {
    bool is_free = true;
    for (int k = 0; k < 2 * kHigh && is_free; ++k) {
      const double gap = grasp.half + fingertip_ + (k % 2 == 0 ? 0 : opening_);
      const Vec3 at = p_W + side * gap * a_W + (k / 2) * fingertip_ * Vec3::UnitZ();
      is_free = surroundings_.isFree(objects, at, kFingerNeeds * fingertip_, body);
    }
    blocked += is_free ? 0 : 1;
  }
  return blocked;
}

// As low as fingers get: a capital on its head is widest there.
void Chooser::takeLow(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept {
  Vec3 p_W = X_WB * grasp.p_BC;
  p_W.z() = X_WB.p.z() - halfWidth(world_, body, X_WB.q.conjugate() * Vec3::UnitZ()) + kOverGround * fingertip_;
  grasp.p_BC = X_WB.inverseTimes(p_W);
}

void Chooser::weighCarrying(Choice& best, const ObjectState& objects, double effort, double yaw) const noexcept {
  const AssemblyGoal& place = world_.scene.assembly->goals[best.goal];
  const Pose& X_WB = objects.bodies[best.body].X_WB_end;
  const Pose X_WG = nearestTurn(place.X_WB, place.fold, X_WB.q);
  const Vec3 up_B = X_WG.q.conjugate() * Vec3::UnitZ();
  const double up = (X_WB.q * up_B).z();
  if (up < kStands) effort += up < -kStands ? kOnItsHead : kLies;
  const bool top_out_of_reach = up < -kStands && halfWidth(world_, best.body, up_B) < kFlat;

  const Lines lines = linesToHang(world_, best.body, X_WB, up_B, yaw);
  for (const Vec3& a_W : std::span(lines.a_W).first(lines.count)) {
    const Vec3 top_B = top_out_of_reach ? Vec3(up_B.cross(X_WB.q.conjugate() * a_W).normalized()) : up_B;
    Choice choice{best.goal,        best.body,        graspAlong(world_, best.body, X_WB, top_B, a_W, yaw),
                  top_out_of_reach, top_out_of_reach, effort};
    if (top_out_of_reach) takeLow(choice.grasp, best.body, X_WB);
    choice.effort += kFingerBlocked * obstacles(objects, choice.grasp, best.body, X_WB);
    if (!choice.only_moves && obstacles(objects, choice.grasp, best.body, X_WG) > 0) {
      choice.only_moves = up < kStands;  // then it stands, and is taken from another side
      choice.effort += choice.only_moves ? kStandsUp : kPlaceBlocked;
    }
    if (choice.effort < best.effort) best = choice;
  }
}

void Chooser::weighMoving(Choice& best, const ObjectState& objects, std::size_t goal, std::size_t body, double effort,
                          double yaw) const noexcept {
  const Pose& X_WB = objects.bodies[body].X_WB_end;
  const Lines lines = linesToMove(world_, body, X_WB);
  for (const Vec3& a_W : std::span(lines.a_W).first(lines.count)) {
    // by its middle, where it is widest
    Choice choice{goal, body, graspAlong(world_, body, X_WB, Vec3::Zero(), a_W, yaw), true, false, effort + kMoves};
    choice.effort += kFingerBlocked * obstacles(objects, choice.grasp, body, X_WB);
    if (choice.effort < best.effort) best = choice;
  }
}

Choice Chooser::weigh(const ObjectState& objects, std::size_t goal, std::size_t body, const Vec3& p_W,
                      double yaw) const noexcept {
  Choice best{goal, body, {}, true, false, std::numeric_limits<double>::infinity()};
  const std::size_t cover = surroundings_.coverOf(objects, body);
  const std::size_t occupant =
      surroundings_.bodyAt(objects, world_.scene.assembly->goals[goal].X_WB.p, kOccupied, body);
  const double effort = kWay * (objects.bodies[body].X_WB_end.p - p_W).head<2>().norm() +
                        (cover == Surroundings::kNothing ? 0 : kCovered);
  weighCarrying(best, objects, effort + (occupant == Surroundings::kNothing ? 0 : kPlaceTaken), yaw);
  weighMoving(best, objects, goal, body, effort + kInVain, yaw);
  for (const std::size_t other : {cover, occupant}) {
    if (other == Surroundings::kNothing || world_.scene.bodies[other].fixed) continue;
    if (surroundings_.coverOf(objects, other) == Surroundings::kNothing)
      weighMoving(best, objects, goal, other, 0, yaw);
  }
  return best;
}

}  // namespace presa::assembling
