#include "devices/assembling_hand/planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/math/minimum_jerk.h"

namespace presa::assembling {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFast = 0.25, kSlow = 0.06;  // [m/s]
constexpr double kTurn = 1;                   // [rad/s]
constexpr double kAbove = 0.001;              // a body is let go so far over its place [m]
constexpr double kLoose = 0.48;               // of the grip, while a body finds its own way to hang
constexpr double kHangs = 0.35;               // no more askew than this it may be put down [rad]
constexpr int kMostShakes = 8;
constexpr double kShakeBy = 0.05, kShakeTime = 0.25;  // [m, s]: 4.6 m/s^2
constexpr double kInHand = 0.012;     // a body is held while its spot stays this near to the fingers [m]
constexpr double kOverGround = 1.05;  // centre of a fingertip, in its radii
constexpr double kMoved = 0.004;      // a body that moved by more is aimed at again [m]
constexpr double kPause = 0.5;        // to look again [s]

double yawOf(const Vec3& a_W) { return std::atan2(a_W.y(), a_W.x()); }
double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

const std::vector<std::string>& Planner::phaseNames() {
  static const std::vector<std::string> names{"look",  "rise",  "over",  "down",   "close", "grip", "lift", "loosen",
                                              "shake", "swing", "carry", "settle", "lower", "open", "leave"};
  return names;
}

Planner::Planner(std::shared_ptr<const World> world, double fingertip)
    : world_(std::move(world)), fingertip_(fingertip) {
  for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    Vec3 half = Vec3::Zero();
    for (int axis = 0; axis < 3 && body.physics; ++axis)
      half[axis] = halfWidth(body.physics->shape, world_->meshes[i].physics.get(), Vec3::Unit(axis));
    size_.push_back(half.norm());
  }
  tries_.resize(world_->scene.bodies.size());
  from_.centre = to_.centre = {0, 0, 0.3};
  from_.gap = to_.gap = 0.05;
}

void Planner::go(Phase phase, const PairTarget& to, double duration) noexcept {
  phase_ = phase;
  from_ = to_;
  from_.grip = to.grip > 0 && to_.grip <= 0 ? 0 : to_.grip;
  to_ = to;
  to_.yaw = from_.yaw + wrapped(to.yaw - from_.yaw);
  begin_ = now_;
  end_ = now_ + duration;
}

void Planner::goAt(Phase phase, const PairTarget& to, double speed) noexcept {
  const double way = (to.centre - to_.centre).norm(), turn = std::abs(wrapped(to.yaw - to_.yaw));
  // the peak of a minimum-jerk movement is 1.875 times its mean
  go(phase, to, 0.2 + 1.875 * std::max(way / speed, turn / kTurn));
}

PairTarget Planner::at(double time) const noexcept {
  const double s = end_ > begin_ ? minimumJerk((time - begin_) / (end_ - begin_)) : 1;
  return {from_.centre + s * (to_.centre - from_.centre), from_.yaw + s * (to_.yaw - from_.yaw),
          from_.gap + s * (to_.gap - from_.gap), from_.grip + s * (to_.grip - from_.grip)};
}

PairTarget Planner::rate(double time) const noexcept {
  if (!(end_ > begin_)) return {};
  const double slope = minimumJerkSlope((time - begin_) / (end_ - begin_)) / (end_ - begin_);
  return {slope * (to_.centre - from_.centre), slope * (to_.yaw - from_.yaw), slope * (to_.gap - from_.gap), 0};
}

void Planner::see(const ObjectState& objects, double time) noexcept {
  now_ = time;
  if (time >= end_) next(objects);
}

bool Planner::isFilled(std::size_t goal, const ObjectState& objects) const noexcept {
  const Assembly& assembly = *world_->scene.assembly;
  const AssemblyGoal& place = assembly.goals[goal];
  return std::ranges::any_of(place.bodies, [&](std::size_t body) {
    const BodyMotion& motion = objects.bodies[body];
    const Pose& X_WB = motion.X_WB_end;
    const Way way = wayBetween(nearestTurn(place.X_WB, place.fold, X_WB.q), X_WB);
    return way.distance < assembly.tolerance && way.angle < assembly.tolerance_angle_deg * kPi / 180 &&
           motion.v_WB.norm() < 1e-6;
  });
}

bool Planner::isPlaced(std::size_t body, const ObjectState& objects) const noexcept {
  const auto& goals = world_->scene.assembly->goals;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    const bool fits = std::ranges::find(goals[g].bodies, body) != goals[g].bodies.end();
    if (fits && (goals[g].X_WB.p - objects.bodies[body].X_WB_end.p).norm() < world_->scene.assembly->tolerance &&
        isFilled(g, objects))
      return true;
  }
  return false;
}

double Planner::clearHeight(const ObjectState& objects) const noexcept {
  double top = 0;
  for (std::size_t i = 0; i < size_.size(); ++i) {
    if (!world_->scene.bodies[i].fixed) top = std::max(top, objects.bodies[i].X_WB_end.p.z() + size_[i]);
  }
  return top + kClearance + fingertip_;
}

// The first goal that may be filled, and of the bodies that fit the one that was tried least.
void Planner::look(const ObjectState& objects) noexcept {
  const auto& goals = world_->scene.assembly->goals;
  bool found = false;
  int fewest = 0;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (isFilled(g, objects)) continue;
    if (!std::ranges::all_of(goals[g].after, [&](std::size_t before) { return isFilled(before, objects); })) continue;
    for (const std::size_t body : goals[g].bodies) {
      if (isPlaced(body, objects) || (found && tries_[body] >= fewest)) continue;
      found = true;
      fewest = tries_[body];
      goal_ = g;
      body_ = body;
    }
  }
  PairTarget to = to_;
  to.grip = 0;
  if (!found) return go(kLook, to, kPause);
  ++tries_[body_];
  to.centre.z() = std::max(to.centre.z(), clearHeight(objects));
  goAt(kRise, to, kFast);
}

void Planner::takeAim(const ObjectState& objects) noexcept {
  X_WB_taken_ = objects.bodies[body_].X_WB_end;
  const AssemblyGoal& goal = world_->scene.assembly->goals[goal_];
  X_WG_ = nearestTurn(goal.X_WB, goal.fold, X_WB_taken_.q);
  grasp_ = chooseGrasp(*world_, body_, X_WB_taken_, X_WG_, to_.yaw);
  PairTarget to = to_;
  to.centre.head<2>() = (X_WB_taken_ * grasp_.p_BC).head<2>();
  to.yaw = yawOf(X_WB_taken_.q * grasp_.a_B);
  to.gap = openGap();
  goAt(kOver, to, kFast);
}

bool Planner::holds(const ObjectState& objects) const noexcept {
  return (objects.bodies[body_].X_WB_end * grasp_.p_BC - to_.centre).norm() < kInHand;
}

// It slipped out, or will not be taken: another try.
void Planner::letGo() noexcept {
  PairTarget to = to_;
  to.grip = 0;
  to.gap = openGap();
  go(kLeave, to, kPause);
}

// Hanging, the body has its top up: what is left is a turn about the vertical, the least of those in which it looks the same.
void Planner::carry(const ObjectState& objects) noexcept {
  const AssemblyGoal& goal = world_->scene.assembly->goals[goal_];
  const Pose& X_WB = objects.bodies[body_].X_WB_end;
  X_WG_ = nearestTurn(goal.X_WB, goal.fold, X_WB.q);
  PairTarget to = to_;
  to.grip = grasp_.force;
  to.yaw = to_.yaw + wrapped(yawOf(X_WG_.q * grasp_.a_B) - yawOf(X_WB.q * grasp_.a_B));
  const Vec3 over = X_WG_ * grasp_.p_BC;
  to.centre.x() = over.x();
  to.centre.y() = over.y();
  goAt(kCarry, to, kFast);
}

// Of the body's top from straight up, whatever it looks the same in [rad].
double Planner::tilt(const ObjectState& objects) const noexcept {
  const Quat& q_WG = world_->scene.assembly->goals[goal_].X_WB.q;
  const Vec3 up_W = objects.bodies[body_].X_WB_end.q * (q_WG.conjugate() * Vec3::UnitZ());
  return std::acos(std::clamp(up_W.z(), -1.0, 1.0));
}

// What friction of the fingertips holds askew, or balances on its head, finds its way when it is moved quickly across.
void Planner::shake() noexcept {
  PairTarget to = to_;
  to.centre += (shakes_++ % 2 == 0 ? kShakeBy : -kShakeBy) * Vec3(-std::sin(to_.yaw), std::cos(to_.yaw), 0);
  go(kShake, to, kShakeTime);
}

// By what the body is away from its place now, not by where the fingers were meant to be.
void Planner::lower(const ObjectState& objects) noexcept {
  PairTarget to = to_;
  to.centre += X_WG_.p + kAbove * Vec3::UnitZ() - objects.bodies[body_].X_WB_end.p;
  goAt(kLower, to, kSlow);
}

void Planner::next(const ObjectState& objects) noexcept {
  PairTarget to = to_;
  switch (phase_) {
    case kLook:
    case kLeave:
      return look(objects);
    case kRise:
      return takeAim(objects);
    case kOver:
      if ((objects.bodies[body_].X_WB_end.p - X_WB_taken_.p).norm() > kMoved) return takeAim(objects);  // it rolls
      to.centre = X_WB_taken_ * grasp_.p_BC;
      // over the ground; a flat body's edge is no higher than that
      to.centre.z() = grasp_.lays_down ? kOverGround * fingertip_ : std::max(to.centre.z(), kOverGround * fingertip_);
      return goAt(kDown, to, kFast);
    case kDown:
      to.gap = grasp_.half + fingertip_;
      return go(kClose, to, 0.3);
    case kClose:
      grasp_.p_BC = objects.bodies[body_].X_WB_end.inverseTimes(to_.centre);  // as it came to be
      to.grip = grasp_.force;
      return go(kGrip, to, 0.3);
    case kGrip:
      to.centre.z() = clearHeight(objects) + 2 * size_[body_];
      return goAt(kLift, to, kFast);
    case kLift:
      if (!holds(objects)) return letGo();
      shakes_ = 0;
      // less so each time it slips out
      to.grip = std::min(1.0, kLoose + 0.15 * (tries_[body_] - 1)) * grasp_.force;
      return go(kLoosen, to, 0.3);
    case kLoosen:
    case kShake:
      return go(kSwing, to, kPause);
    case kSwing:
      if (!holds(objects)) return letGo();
      if (grasp_.lays_down) {
        X_WG_.p = X_WB_taken_.p + grasp_.rise * Vec3::UnitZ();
        return lower(objects);
      }
      if (tilt(objects) > kHangs && shakes_ < kMostShakes) return shake();
      return carry(objects);
    case kCarry:
      return go(kSettle, to, kPause);
    case kSettle:
      if (!holds(objects)) return letGo();
      return lower(objects);
    case kLower:
      to.grip = 0;
      to.gap = openGap();
      return go(kOpen, to, 0.5);
    case kOpen:
      to.centre.z() = clearHeight(objects);
      return goAt(kLeave, to, kFast);
  }
}

}  // namespace presa::assembling
