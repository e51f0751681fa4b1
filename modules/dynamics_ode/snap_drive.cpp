// Snap constraints as ODE velocity motors: three linear and three angular axes, the first along the remaining way.
// Target velocity min(rate * way, speed, way / h), so that the way decays exponentially and never overshoots within a
// step; the motor force is bounded by mass * most (linear) and mass * most * rim (angular). Solved together with
// contacts and friction.
#include "modules/dynamics_ode/snap_drive.h"

#include <algorithm>

#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

constexpr double kSamePlace = 1e-4, kSameTurn = 1e-3;  // smaller changes of a target wake nothing [m, rad]
constexpr double kMayTouch = 0.002;  // distance of bounds within which bodies may lean on each other [m]

/// Sets the three axes of a motor, the first along `way`, and adds them to `driven`. `set_axis`, `set_param`: ODE's
/// functions for this kind of motor.
template <class SetAxis, class SetParam>
void setMotor(dJointID motor, SetAxis set_axis, SetParam set_param, const Vec3& way, double velocity, double force,
              std::size_t body, bool turns, std::vector<ContactProblem::Motor>& driven) {
  const double length = way.norm();
  const Vec3 x = length > 1e-12 ? Vec3(way / length) : Vec3::UnitX();
  const Vec3 y = x.unitOrthogonal(), z = x.cross(y);
  int axis = 0;
  for (const Vec3& direction : {x, y, z}) {
    driven.push_back({static_cast<std::int32_t>(body), turns, direction, axis == 0 ? velocity : 0, 0, force});
    set_axis(motor, axis++, 0, direction.x(), direction.y(), direction.z());
  }
  set_param(motor, dParamVel1, velocity);
  set_param(motor, dParamVel2, 0);
  set_param(motor, dParamVel3, 0);
  for (const int parameter : {dParamFMax1, dParamFMax2, dParamFMax3}) set_param(motor, parameter, force);
}

/// Target speed: not faster than what reaches the target within this step.
double towards(double way, const SnapConstraint& to, double speed, double h) {
  return std::min({to.rate * way, speed, way / h});
}

}  // namespace

SnapDrive::SnapDrive(const BodySet& bodies, dWorldID ode_world)
    : constraint_of_(bodies.size(), nullptr), before_(bodies.size()), motors_(bodies.size()) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.moves(i)) continue;
    Motors& motors = motors_[i];
    motors.linear = dJointCreateLMotor(ode_world, nullptr);
    motors.angular = dJointCreateAMotor(ode_world, nullptr);
    dJointSetLMotorNumAxes(motors.linear, 3);
    dJointSetAMotorMode(motors.angular, dAMotorUser);
    dJointSetAMotorNumAxes(motors.angular, 3);
  }
  driven_.reserve(6 * bodies.size());
}

SnapDrive::~SnapDrive() {
  for (const Motors& motors : motors_) {
    if (motors.linear == nullptr) continue;
    dJointDestroy(motors.linear);
    dJointDestroy(motors.angular);
  }
}

void SnapDrive::read(const SnapConstraints& snap_constraints, BodySet& bodies, Sleep* sleep) {
  const std::vector<const SnapConstraint*>::size_type count = constraint_of_.size();
  std::fill(constraint_of_.begin(), constraint_of_.end(), nullptr);
  constraints_ = snap_constraints;
  for (const SnapConstraint& constraint : constraints_.bodies) {
    const auto body = static_cast<std::size_t>(constraint.body);
    if (constraint.body >= 0 && body < count) constraint_of_[body] = &constraint;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const bool fix = constraint_of_[i] != nullptr && constraint_of_[i]->fixed;
    // a body that fell asleep while pulled is held by something; wake it when its target changes
    if (sleep != nullptr && hasChanged(i) && bodies.asleep(i)) sleep->wake(bodies, i);
    if (fix == bodies.isPut(i)) continue;
    fix ? bodies.put(i) : bodies.take(i);
    if (sleep != nullptr) wakeAround(i, bodies, *sleep);
  }
}

// Whether the target of body i has changed; stores it for the next call.
bool SnapDrive::hasChanged(std::size_t i) {
  const SnapConstraint* now = constraint_of_[i];
  std::optional<SnapConstraint>& before = before_[i];
  const bool same =
      now == nullptr ||
      (before && before->fixed == now->fixed && before->max_acceleration == now->max_acceleration &&
       (before->X_WB.p - now->X_WB.p).norm() < kSamePlace && before->X_WB.q.angularDistance(now->X_WB.q) < kSameTurn);
  if (now == nullptr) {
    before.reset();
  } else if (!same) {
    before = *now;
  }
  return !same;
}

// Wakes the sleeping neighbours, which may have leaned on body i, and those joined to it.
void SnapDrive::wakeAround(std::size_t i, BodySet& bodies, Sleep& sleep) {
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (j == i || !bodies.asleep(j)) continue;
    if (!bodies.meet(i, j) || bodies.areNear(i, j, kMayTouch)) sleep.wake(bodies, j);
  }
}

void SnapDrive::carry(BodySet& bodies, Sleep* sleep, double h) const {
  for (std::size_t i = 0; i < constraint_of_.size(); ++i) {
    if (constraint_of_[i] == nullptr || !bodies.isPut(i)) continue;
    const Pose X_WB = bodies.pose(i);
    const Pose& goal = constraint_of_[i]->X_WB;
    const double way = (goal.p - X_WB.p).norm(), turn = turnBetween(X_WB.q, goal.q).norm();
    if (way == 0 && turn == 0) continue;
    const double speed = std::max(kCarrySpeed, constraint_of_[i]->speed);
    const double steps = std::max(way / (speed * h), turn / (kCarrySpin * h));
    bodies.place(i, steps > 1 ? interpolate(X_WB, goal, 1 / steps) : goal);
    // it would pass through sleeping bodies and be released inside them
    if (sleep != nullptr && steps > 1) wakeAround(i, bodies, *sleep);
  }
}

void SnapDrive::drive(const BodySet& bodies, double h) {
  driven_.clear();
  for (std::size_t i = 0; i < constraint_of_.size(); ++i) {
    const Motors& motors = motors_[i];
    if (motors.linear == nullptr) continue;
    const bool is_pulled = constraint_of_[i] != nullptr && !constraint_of_[i]->fixed && bodies.awake(i);
    const bool turns = is_pulled && constraint_of_[i]->turns;
    dJointAttach(motors.linear, is_pulled ? bodies.body(i) : nullptr, nullptr);
    dJointAttach(motors.angular, turns ? bodies.body(i) : nullptr, nullptr);
    if (!is_pulled) continue;
    const SnapConstraint& to = *constraint_of_[i];
    const Pose now = bodies.centrePose(i), goal = bodies.centreOf(i, to.X_WB);
    const Vec3 way = goal.p - now.p;
    setMotor(motors.linear, dJointSetLMotorAxis, dJointSetLMotorParam, way, towards(way.norm(), to, to.speed, h),
             bodies.mass(i) * to.max_acceleration, i, false, driven_);
    if (!turns) continue;
    const double rim = std::max(bodies.extent(i), 1e-3);
    const Vec3 turn = turnBetween(now.q, goal.q);
    setMotor(motors.angular, dJointSetAMotorAxis, dJointSetAMotorParam, turn,
             towards(turn.norm(), to, to.speed / rim, h), bodies.mass(i) * to.max_acceleration * rim, i, true, driven_);
  }
}

}  // namespace presa::ode
