#include "devices/assembling_hand/planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::assembling {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFast = 0.4, kSlow = 0.06;        // [m/s]
constexpr double kAbove = 0.001;                   // height above the goal at which a body is released [m]
constexpr double kNear = 0.015, kHoverTime = 0.6;  // hover height and time, while the goal aligns the body [m, s]
constexpr double kLoose = 0.48;                    // share of the grip while a body swings freely
constexpr double kLessLoose = 0.15;                // added after each time the body slipped out (three steps)
constexpr double kFirm = 1.6;   // share of the grip while a body on its head is shaken, so that it does not fall out
constexpr double kHangs = 0.3;  // max tilt for putting a body down [rad]
constexpr double kHangsWell = 0.25;  // max tilt that a goal corrects without shaking [rad]
constexpr double kUpright = 0.12;    // max tilt after a failed attempt, in which it may have hit its neighbours [rad]
constexpr int kMaxShakes = 8;
constexpr int kHardest = 3;                           // max number of extra grips added for a stuck body
constexpr int kTips = 4;                              // steps of a quarter turn when tipping over
constexpr double kShakeBy = 0.05, kShakeTime = 0.25;  // [m, s]: 4.6 m/s^2
constexpr double kJerkBy = 0.08;                      // for a body on its head: 7.4 m/s^2
constexpr double kInHand = 0.012;  // max distance of the grasp point from the fingers while a body is held [m]
constexpr double kMoved = 0.004;   // a body that moved farther is aimed at again [m]
constexpr double kPause = 0.5;     // before looking again [s]
constexpr double kGap = 6;         // effort of leaving a free goal between two filled ones
constexpr double kInLine = 1e-3;   // [m]

double yawOf(const Vec3& a_W) { return std::atan2(a_W.y(), a_W.x()); }
double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

}  // namespace

const std::vector<std::string>& Planner::phaseNames() {
  static const std::vector<std::string> names{"look",     "rise",   "over",  "down",  "close", "grip",
                                              "lift",     "loosen", "shake", "swing", "carry", "settle",
                                              "approach", "hover",  "lower", "tip",   "open",  "leave"};
  return names;
}

Planner::Planner(std::shared_ptr<const World> world, double fingertip)
    : PairPlan({.centre = {0, 0, 0.3}, .gap = 0.05}),
      world_(std::move(world)),
      fingertip_(fingertip),
      chooser_(*world_, fingertip, kOpening) {
  for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    Vec3 half = Vec3::Zero();
    for (int axis = 0; axis < 3 && body.physics; ++axis)
      half[axis] = halfWidth(*world_, i, body.physics->X_BG.q * Vec3::Unit(axis));
    size_.push_back(half.norm());
  }
  trials_.resize(world_->scene.bodies.size());
}

bool Planner::isFilled(std::size_t goal, const ObjectState& objects) const noexcept {
  const Assembly& assembly = *world_->scene.assembly;
  const AssemblyGoal& place = assembly.goals[goal];
  return std::ranges::any_of(place.bodies, [&](std::size_t body) {
    const BodyMotion& motion = objects.bodies[body];
    const Pose& X_WB = motion.X_WB_end;
    const PoseDifference way = poseDifference(nearestTurn(place.X_WB, place.fold, X_WB.q), X_WB);
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

// Evaluates one goal per tick and keeps the action of min effort.
void Planner::look(const ObjectState& objects) noexcept {
  const std::size_t goals = world_->scene.assembly->goals.size();
  if (phase() != kLook || looked_at_ == goals) {
    looked_at_ = 0;
    found_ = false;
    for (std::size_t i = 0; i < trials_.size(); ++i) trials_[i].placed = isPlaced(i, objects);
  }
  consider(looked_at_++, objects);
  PairTarget to = target();
  to.grip = 0;
  if (looked_at_ < goals) return go(kLook, to, 0);
  if (!found_) return go(kLook, to, kPause);
  goal_ = best_.goal;
  body_ = best_.body;
  to.centre.z() = std::max(to.centre.z(), clearHeight(objects));
  goAt(kRise, to, kFast);
}

void Planner::consider(std::size_t goal, const ObjectState& objects) noexcept {
  const AssemblyGoal& place = world_->scene.assembly->goals[goal];
  if (isFilled(goal, objects)) return;
  if (!std::ranges::all_of(place.after, [&](std::size_t before) { return isFilled(before, objects); })) return;
  const double gap = leavesGap(goal, objects) ? kGap : 0;
  for (const std::size_t body : place.bodies) {
    if (trials_[body].placed || chooser_.surroundings().isOutOfReach(objects, body)) continue;
    Choice choice = chooser_.weigh(objects, goal, body, target().centre, target().yaw, trials_);
    choice.effort += gap;
    if (found_ && choice.effort >= best_.effort) continue;
    found_ = true;
    best_ = choice;
    wanted_ = body;
  }
}

// True if filling `goal` leaves a free goal between two filled ones, where a body would have to be squeezed in.
bool Planner::leavesGap(std::size_t goal, const ObjectState& objects) const noexcept {
  const auto& goals = world_->scene.assembly->goals;
  const Vec3& a = goals[goal].X_WB.p;
  for (std::size_t f = 0; f < goals.size(); ++f) {
    if (f == goal || !isFilled(f, objects)) continue;
    const Vec3 way = goals[f].X_WB.p - a;
    for (std::size_t g = 0; g < goals.size(); ++g) {
      if (g == goal || g == f || isFilled(g, objects)) continue;
      const Vec3 to = goals[g].X_WB.p - a;
      const double part = to.dot(way) / way.squaredNorm();
      if (part > 0 && part < 1 && (to - part * way).norm() < kInLine) return true;
    }
  }
  return false;
}

void Planner::takeAim(const ObjectState& objects) noexcept {
  const Choice choice = chooser_.weigh(objects, goal_, wanted_, target().centre, target().yaw, trials_);
  body_ = choice.body;
  grasp_ = choice.grasp;
  only_moves_ = choice.only_moves;
  tips_over_ = choice.tips_over;
  tips_ = 0;
  Trial& trial = trials_[body_];
  trial = {trial.count + 1, grasp_.a_B, only_moves_, false, trial.stuck};
  grasp_.force = std::min(kMaxGrip, (1 + trial.stuck) * grasp_.force);
  X_WB_taken_ = objects.bodies[body_].X_WB_end;
  lay_ = tilt(objects) > kHangs;
  const AssemblyGoal& goal = world_->scene.assembly->goals[goal_];
  X_WG_ = nearestTurn(goal.X_WB, goal.fold, X_WB_taken_.q);
  PairTarget to = target();
  to.centre.head<2>() = (X_WB_taken_ * grasp_.p_BC).head<2>();
  to.yaw = yawOf(X_WB_taken_.q * grasp_.a_B);
  to.gap = openGap();
  goAt(kOver, to, kFast);
}

// Carries the body to free space as it hangs.
void Planner::moveAside(const ObjectState& objects) noexcept {
  const auto room = chooser_.surroundings().roomFor(objects, body_, X_WB_taken_.p, fingertip_);
  const Pose& X_WB = objects.bodies[body_].X_WB_end;
  X_WG_.p = room.value_or(X_WB_taken_.p);
  X_WG_.p.z() = halfWidth(*world_, body_, X_WB.q.conjugate() * Vec3::UnitZ());
  PairTarget to = target();
  to.centre.head<2>() += (X_WG_.p - X_WB.p).head<2>();
  goAt(kCarry, to, kFast);
}

bool Planner::holds(const ObjectState& objects) const noexcept {
  return (objects.bodies[body_].X_WB_end * grasp_.p_BC - target().centre).norm() < kInHand;
}

// Opens after a failed grasp, for another attempt.
void Planner::release() noexcept {
  PairTarget to = target();
  to.grip = 0;
  to.gap = openGap();
  go(kLeave, to, kPause);
}

// The hanging body has its top up; turn it about the vertical by the min angle to an equivalent orientation at the
// goal.
void Planner::carry(const ObjectState& objects) noexcept {
  const AssemblyGoal& goal = world_->scene.assembly->goals[goal_];
  const Pose& X_WB = objects.bodies[body_].X_WB_end;
  X_WG_ = nearestTurn(goal.X_WB, goal.fold, X_WB.q);
  X_WG_.p += chooser_.surroundings().awayFromNeighbours(objects, body_, X_WG_);
  PairTarget to = target();
  to.grip = grasp_.force;
  to.yaw = target().yaw + wrapped(yawOf(X_WG_.q * grasp_.a_B) - yawOf(X_WB.q * grasp_.a_B));
  const Vec3 over = X_WG_ * grasp_.p_BC;
  to.centre.x() = over.x();
  to.centre.y() = over.y();
  goAt(kCarry, to, kFast);
}

// Angle between the vertical and the body axis that is vertical at the goal [rad].
double Planner::tilt(const ObjectState& objects) const noexcept {
  const Quat& q_WG = world_->scene.assembly->goals[goal_].X_WB.q;
  const Vec3 up_W = objects.bodies[body_].X_WB_end.q * (q_WG.conjugate() * Vec3::UnitZ());
  return std::acos(std::clamp(up_W.z(), -1.0, 1.0));
}

bool Planner::isOnItsHead(const ObjectState& objects) const noexcept { return tilt(objects) > kPi / 2; }

// Fast lateral motion frees a body that fingertip friction holds askew or that balances on its head. The amplitude
// decreases near the upright position, as in degaussing.
void Planner::shake(const ObjectState& objects) noexcept {
  double by = isOnItsHead(objects) ? kJerkBy : kShakeBy;
  PairTarget to = target();
  if (tilt(objects) < kHangs) by *= 1 - static_cast<double>(shakes_) / (kMaxShakes + 1);
  to.centre += (shakes_++ % 2 == 0 ? by : -by) * Vec3(-std::sin(target().yaw), std::cos(target().yaw), 0);
  go(kShake, to, kShakeTime);
}

// Max tilt before putting down. After a failed attempt a body that had been lying is shaken until upright; others (a
// roof tile for a sloped goal) hang at an angle by design.
double Planner::mayHang() const noexcept { return trials_[body_].count > 1 && lay_ ? kUpright : kHangs; }

// A loose grip lets the body swing; a body on its head is held firmly.
double Planner::swingingGrip(const ObjectState& objects) const noexcept {
  if (isOnItsHead(objects) && !only_moves_) return kFirm * grasp_.force;
  return (kLoose + kLessLoose * ((trials_[body_].count - 1) % 3)) * grasp_.force;
}

// Tips a body that stands on its edge over, with its top up: the fingers move along the circle about that edge.
void Planner::tipOver(const ObjectState& objects) noexcept {
  if (tips_ == 0) {
    const Quat& q_WG = world_->scene.assembly->goals[goal_].X_WB.q;
    const Vec3 top_W = objects.bodies[body_].X_WB_end.q * (q_WG.conjugate() * Vec3::UnitZ());
    tip_along_ = -Vec3(top_W.x(), top_W.y(), 0).normalized();
    tip_about_ = target().centre;
    tip_about_.z() = Chooser::kOverGround * fingertip_;
    tip_high_ = target().centre.z() - tip_about_.z();
  }
  const double angle = kPi / 2 * ++tips_ / kTips;
  PairTarget to = target();
  to.centre = tip_about_ + tip_high_ * (std::sin(angle) * tip_along_ + std::cos(angle) * Vec3::UnitZ());
  goAt(kTip, to, kSlow);
}

// Relative to the measured offset of the body from its goal, not to the planned finger position.
void Planner::lower(const ObjectState& objects) noexcept {
  PairTarget to = target();
  to.centre += X_WG_.p + kAbove * Vec3::UnitZ() - objects.bodies[body_].X_WB_end.p;
  if (phase() == kSettle && target().centre.z() - to.centre.z() > kNear) {
    to.centre.z() += kNear;
    return goAt(kApproach, to, kFast);
  }
  goAt(kLower, to, kSlow);
}

void Planner::next(const ObjectState& objects) noexcept {
  PairTarget to = target();
  switch (phase()) {
    case kLook:
    case kLeave:
      return look(objects);
    case kRise:
      return takeAim(objects);
    case kOver:
      if ((objects.bodies[body_].X_WB_end.p - X_WB_taken_.p).norm() > kMoved) return takeAim(objects);  // it rolls
      to.centre = X_WB_taken_ * grasp_.p_BC;
      to.centre.z() = std::max(to.centre.z(), Chooser::kOverGround * fingertip_);
      return goAt(kDown, to, kFast);
    case kDown:
      to.gap = grasp_.half + fingertip_;
      return go(kClose, to, 0.3);
    case kClose:
      grasp_.p_BC = objects.bodies[body_].X_WB_end.inverseTimes(target().centre);  // actual grasp point after closing
      to.grip = grasp_.force;
      return go(kGrip, to, 0.3);
    case kGrip:
      to.centre.z() = clearHeight(objects) + 2 * size_[body_];
      return goAt(kLift, to, kFast);
    case kLift:
      if (!holds(objects)) {
        // not moved: neighbours hold it, so grip harder next time; moved: it was squeezed out, and more force would not
        // help
        const bool stayed = (objects.bodies[body_].X_WB_end.p - X_WB_taken_.p).norm() < kMoved;
        trials_[body_].stuck = stayed ? std::min(trials_[body_].stuck + 1, kHardest) : 0;
        return release();
      }
      grasp_.force /= 1 + trials_[body_].stuck;  // no longer stuck
      trials_[body_].stuck = 0;
      to.grip = grasp_.force;
      shakes_ = 0;
      if (!only_moves_ && tilt(objects) < std::min(kHangsWell, mayHang())) return carry(objects);
      to.grip = swingingGrip(objects);
      return go(kLoosen, to, 0.3);
    case kLoosen:
    case kShake:
      return go(kSwing, to, kPause);
    case kSwing:
      if (!holds(objects)) return release();
      if (only_moves_) return moveAside(objects);
      if (tilt(objects) > mayHang() && shakes_ < kMaxShakes) {
        if (const double grip = swingingGrip(objects); grip != target().grip) {
          to.grip = grip;
          return go(kLoosen, to, 0.3);
        }
        return shake(objects);
      }
      if (tilt(objects) <= kHangs) return carry(objects);
      only_moves_ = true;
      return moveAside(objects);
    case kCarry:
      return go(kSettle, to, kPause);
    case kSettle:
      if (!holds(objects)) return release();
      return lower(objects);
    case kApproach:
      return go(kHover, to, kHoverTime);
    case kHover:
      return lower(objects);
    case kLower:
    case kTip:
      if (tips_over_ && tips_ < kTips) return tipOver(objects);
      to.grip = 0;
      to.gap = openGap();
      return go(kOpen, to, 0.5);
    case kOpen:
      to.centre.z() = clearHeight(objects);
      return goAt(kLeave, to, kFast);
  }
}

}  // namespace presa::assembling
