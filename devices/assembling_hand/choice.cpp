#include "devices/assembling_hand/choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "devices/assembling_hand/wedge.h"
#include "framework/scene/goal_pose.h"

namespace presa::assembling {
namespace {

// Effort of each difficulty, in metres of travel.
constexpr double kWay = 1, kFingerBlocked = 3, kCovered = 7, kLies = 0.5, kOnItsHead = 2, kPlaceBlocked = 8,
                 kPlaceTaken = 8, kStandsUp = 3, kMoves = 5, kInVain = 1, kTried = 2, kAgain = 6;
constexpr double kSameLine = 0.98;     // cosine: grasps along the same line
constexpr double kOccupied = 0.004;    // radius around the centre of a goal [m]
constexpr double kPlate = 0.006;       // half height below which a body has too little lever to swing upright [m]
constexpr double kFlat = 0.02;         // half height below which fingertips on the ground touch too little [m]
constexpr double kFingerNeeds = 0.85;  // share of its radius that must be free: a light touch is no obstacle
constexpr int kHigh = 6;               // in fingertip radii: height of the free column above a grasp

/// The body axis nearest to a direction, with its sign.
Vec3 nearestAxis(const Vec3& n_B) {
  int axis = 0;
  n_B.cwiseAbs().maxCoeff(&axis);
  return n_B[axis] < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis));
}

bool prefer(Choice& best, Choice choice, const Trial& before) {
  const bool again = before.count > 0 && choice.only_moves == before.only_moves &&
                     std::abs(choice.grasp.a_B.dot(before.a_B)) > kSameLine;
  choice.effort += kTried * before.count + (again ? kAgain : 0);
  if (choice.effort >= best.effort) return false;
  best = choice;
  return true;
}

}  // namespace

Chooser::Chooser(const World& world, double fingertip, double opening)
    : world_(world), surroundings_(world), fingertip_(fingertip), opening_(opening) {}

// Counts obstacles for either finger, closed or open, along its way down to the body.
Chooser::Obstacles Chooser::obstacles(const ObjectState& objects, const Grasp& grasp, std::size_t body,
                                      const Pose& X_WB) const noexcept {
  Vec3 p_W = X_WB * grasp.p_BC;
  p_W.z() = std::max(p_W.z(), kOverGround * fingertip_);
  const Vec3 a_W = X_WB.q * grasp.a_B;
  Obstacles found;
  for (const double side : {-1.0, 1.0}) {
    std::size_t there = Surroundings::kNothing;
    for (int k = 0; k < 2 * kHigh && there == Surroundings::kNothing; ++k) {
      const double gap = grasp.half + fingertip_ + (k % 2 == 0 ? 0 : opening_);
      const Vec3 at = p_W + side * gap * a_W + (k / 2) * fingertip_ * Vec3::UnitZ();
      there = surroundings_.bodyAt(objects, at, kFingerNeeds * fingertip_, body);
    }
    if (there == Surroundings::kNothing) continue;
    ++found.fingers;
    found.first = there;
  }
  return found;
}

// Grasps as low as the fingers can reach: a capital on its head is widest there.
void Chooser::takeLow(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept {
  Vec3 p_W = X_WB * grasp.p_BC;
  p_W.z() = X_WB.p.z() - halfWidth(world_, body, X_WB.q.conjugate() * Vec3::UnitZ()) + kOverGround * fingertip_;
  grasp.p_BC = X_WB.inverseTimes(p_W);
}

// If a plate ends below the middle of the fingertips, they touch its upper edge and also push it down: grip harder.
void Chooser::pressHarder(Grasp& grasp, std::size_t body, const Pose& X_WB) const noexcept {
  const double top = X_WB.p.z() + halfWidth(world_, body, X_WB.q.conjugate() * Vec3::UnitZ());
  const double over = (std::max((X_WB * grasp.p_BC).z(), kOverGround * fingertip_) - top) / fingertip_;
  if (over <= 0) return;
  const double mu = std::max(0.1, world_.scene.materialOf(world_.scene.bodies[body]).friction_dynamic);
  const double holds = mu * std::sqrt(std::max(0.0, 1 - over * over)) - over;
  grasp.force = holds > 0 ? std::min(kMaxGrip, grasp.force * mu / holds) : kMaxGrip;
}

void Chooser::weighCarrying(Choice& best, std::size_t& in_the_way, const ObjectState& objects, double effort,
                            double yaw, std::span<const Trial> trials) const noexcept {
  const std::size_t body = best.body;
  const AssemblyGoal& place = world_.scene.assembly->goals[best.goal];
  const Pose& X_WB = objects.bodies[body].X_WB_end;
  const Pose X_WG = nearestTurn(place.X_WB, place.fold, X_WB.q);
  const Vec3 up_B = X_WG.q.conjugate() * Vec3::UnitZ();
  const double up = (X_WB.q * up_B).z();
  if (up < kStands) effort += up < -kStands ? kOnItsHead : kLies;
  const double half = outTo(world_, body, up_B);  // on a roof the top is not perpendicular to the goal
  const bool tips_over = up < -kStands ? half < kFlat : up < kStands && half < kPlate;

  const Lines lines = linesToHang(world_, body, X_WB, up_B, yaw);
  // a flat body on its head may hang from two edges; a plate on its edge, only from the opposite one
  for (std::size_t k = 0; k < (tips_over ? 2 : 1) * lines.count; ++k) {
    const Vec3& a_W = lines.a_W[k % lines.count];
    const Vec3 edge_B = (k < lines.count ? 1 : -1) * nearestAxis(up_B.cross(X_WB.q.conjugate() * a_W));
    if (tips_over && up > -kStands && (X_WB.q * edge_B).z() < 0) continue;
    Choice choice{best.goal, body,      graspAlong(world_, body, X_WB, tips_over ? edge_B : up_B, a_W, yaw),
                  tips_over, tips_over, effort};
    if (!tips_over && std::abs(up) < kStands)
      choice.grasp = graspOfLyingMesh(world_, body, X_WB, up_B, yaw).value_or(choice.grasp);
    if (tips_over && up < -kStands) takeLow(choice.grasp, body, X_WB);
    pressHarder(choice.grasp, body, X_WB);
    const Obstacles here = obstacles(objects, choice.grasp, body, X_WB);
    choice.effort += kFingerBlocked * here.fingers;
    if (!choice.only_moves && obstacles(objects, choice.grasp, body, X_WG).fingers > 0) {
      choice.only_moves = up < kStands;  // set it down upright first, and then take it from another side
      choice.effort += choice.only_moves ? kStandsUp : kPlaceBlocked;
    }
    if (prefer(best, choice, trials[body])) in_the_way = here.first;
  }
}

void Chooser::weighMoving(Choice& best, const ObjectState& objects, std::size_t goal, std::size_t body, double effort,
                          double yaw, std::span<const Trial> trials) const noexcept {
  const Pose& X_WB = objects.bodies[body].X_WB_end;
  const Lines lines = linesToMove(world_, body, X_WB);
  for (const Vec3& a_W : std::span(lines.a_W).first(lines.count)) {
    // grasp the middle, where the body is widest
    Choice choice{goal, body, graspAlong(world_, body, X_WB, Vec3::Zero(), a_W, yaw), true, false, effort + kMoves};
    pressHarder(choice.grasp, body, X_WB);
    choice.effort += kFingerBlocked * obstacles(objects, choice.grasp, body, X_WB).fingers;
    prefer(best, choice, trials[body]);
  }
}

Choice Chooser::weigh(const ObjectState& objects, std::size_t goal, std::size_t body, const Vec3& p_W, double yaw,
                      std::span<const Trial> trials) const noexcept {
  Choice best{goal, body, {}, true, false, std::numeric_limits<double>::infinity()};
  const std::size_t cover = surroundings_.coverOf(objects, body);
  std::size_t occupant = surroundings_.bodyAt(objects, world_.scene.assembly->goals[goal].X_WB.p, kOccupied, body);
  if (occupant != Surroundings::kNothing && trials[occupant].placed) occupant = Surroundings::kNothing;  // a neighbour
  std::size_t in_the_way = Surroundings::kNothing;
  const double effort = kWay * (objects.bodies[body].X_WB_end.p - p_W).head<2>().norm() +
                        (cover == Surroundings::kNothing ? 0 : kCovered);
  weighCarrying(best, in_the_way, objects, effort + (occupant == Surroundings::kNothing ? 0 : kPlaceTaken), yaw,
                trials);
  weighMoving(best, objects, goal, body, effort + kInVain, yaw, trials);
  for (const std::size_t other : {cover, occupant, in_the_way}) {
    if (other == Surroundings::kNothing || world_.scene.bodies[other].fixed || trials[other].placed) continue;
    if (surroundings_.coverOf(objects, other) == Surroundings::kNothing)
      weighMoving(best, objects, goal, other, 0, yaw, trials);
  }
  return best;
}

}  // namespace presa::assembling
