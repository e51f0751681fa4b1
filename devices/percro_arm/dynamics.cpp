// Implicit midpoint rule for the Hamiltonian system of joints, structure and tip; each step is solved by Newton's
// method. Dry friction enters each Newton step as a convex minimisation, solved by coordinate descent, so a sticking
// joint has exactly zero velocity.
#include "devices/percro_arm/dynamics.h"

#include <algorithm>
#include <cmath>

namespace presa::percro {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat36 = Eigen::Matrix<double, 3, 6>;

constexpr int kNewtonSteps = 8, kSweeps = 40;
constexpr double kClose = 1e-13;     // Newton tolerance, relative to the largest velocity
const Vec3 kStop{2000, 2000, 50e3};  // stiffness of the joints' end stops: GUESS

/// Distance of each joint beyond its range.
Vec3 beyond(const Geometry& g, const Joints& q) {
  const auto outside = [](double value, double low, double high) { return value - std::clamp(value, low, high); };
  return {outside(q[0], -g.tilt_range, g.tilt_range), outside(q[1], -g.yaw_range, g.yaw_range),
          outside(q[2], 0, g.length_max - g.length_min)};
}

/// Minimises d' A d / 2 - r' d + sum friction_i |w_i + d_i| over d: a Newton step with dry friction. Coordinate descent
/// converges fast, because the diagonal (masses) dominates.
Vec6 stepUnderFriction(const Mat6& a, const Vec6& r, const Vec6& w, const Vec6& friction, int size) {
  Vec6 d = Vec6::Zero();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double max = 0;
    for (int i = 0; i < size; ++i) {
      const double free = w[i] + d[i] + (r[i] - a.row(i).dot(d)) / a(i, i);
      const double held = friction[i] / a(i, i);
      const double next = (free > held ? free - held : free < -held ? free + held : 0) - w[i];
      max = std::max(max, std::abs(next - d[i]));
      d[i] = next;
    }
    if (max <= 0.1 * kClose * (d + w).cwiseAbs().maxCoeff()) break;
  }
  return d;
}

}  // namespace

/// Springs of the structure between joints and tip.
struct ArmDynamics::Springs {
  Mat36 g = Mat36::Zero();    ///< Jacobian of the stretch with respect to (q, x)
  Vec3 k = Vec3::Zero();      ///< [N/m], barrel frame
  Vec6 force = Vec6::Zero();  ///< generalised force on (q, x)
  double energy = 0;
};

ArmDynamics::ArmDynamics(const Parameters& parameters, const Vec3& gravity)
    : parameters_(parameters), gravity_(gravity) {}

Vec3 ArmDynamics::stiffness(double length) const noexcept {
  const double across = 1 / parameters_.structure.compliance(length);
  return {parameters_.structure.axial_stiffness, across, across};
}

ArmDynamics::Springs ArmDynamics::springs(const Joints& q, const Vec3& x, const Vec3& q_dot,
                                          const Vec3& v) const noexcept {
  Springs s;
  const double length = parameters_.geometry.length_min + q[2];
  const Mat3 to_barrel = barrelFrame(q).transpose();
  const Vec3 y = to_barrel * x;
  const Vec3 stretch = y - length * Vec3::UnitX();
  s.g.col(0) = y.cross(Vec3(-std::sin(q[1]), 0, std::cos(q[1])));  // the tilt axis in the barrel frame
  s.g.col(1) = y.cross(Vec3::UnitY());
  s.g.col(2) = -Vec3::UnitX();
  s.g.rightCols<3>() = to_barrel;
  s.k = stiffness(length);
  const Vec3 rate = s.g.leftCols<3>() * q_dot + to_barrel * v;
  const Vec3 pull = s.k.cwiseProduct(stretch + parameters_.structure.damping_time * rate);
  s.force = -s.g.transpose() * pull;
  // the lateral springs soften as the barrel extends
  const Structure& structure = parameters_.structure;
  const double softening = structure.bend_linear + 3 * structure.bend_cubic * length * length;
  const double across = stretch.tail<2>().squaredNorm();
  s.force[2] += 0.5 * across * softening * s.k[1] * s.k[1];
  s.energy = 0.5 * stretch.dot(s.k.cwiseProduct(stretch));
  return s;
}

double ArmDynamics::acrossInertia(double length) const noexcept {
  const Masses& m = parameters_.masses;
  const double centre = length - m.barrel_setback;
  return m.barrel_inertia + m.barrel * centre * centre + m.counterweight * m.counterweight_arm * m.counterweight_arm;
}

double ArmDynamics::tiltInertia(const Joints& q, double across) const noexcept {
  const double c = std::cos(q[1]), s = std::sin(q[1]), ratio = parameters_.geometry.tilt_ratio;
  return parameters_.masses.tilt_inertia + 2 * parameters_.motors.rotor_inertia * ratio * ratio +
         parameters_.masses.roll_inertia * s * s + across * c * c;
}

Vec3 ArmDynamics::inertia(const Joints& q) const noexcept {
  const Geometry& g = parameters_.geometry;
  const Masses& m = parameters_.masses;
  const double across = acrossInertia(g.length_min + q[2]), yaw = g.tilt_ratio * g.yaw_ratio;
  const double rotor = parameters_.motors.rotor_inertia;
  return {tiltInertia(q, across), m.yaw_inertia + 2 * rotor * yaw * yaw + across,
          m.barrel + rotor / (g.drum_radius * g.drum_radius)};
}

/// sum_j dM_j/dq_i q_j'^2 / 2: centrifugal and Coriolis forces beside the change of momentum.
Vec3 ArmDynamics::centrifugal(const Joints& q, const Vec3& q_dot) const noexcept {
  const Masses& m = parameters_.masses;
  const double c = std::cos(q[1]), s = std::sin(q[1]), length = parameters_.geometry.length_min + q[2];
  const double tilt = q_dot[0] * q_dot[0], yaw = q_dot[1] * q_dot[1];
  return {0, s * c * (m.roll_inertia - acrossInertia(length)) * tilt,
          m.barrel * (length - m.barrel_setback) * (c * c * tilt + yaw)};
}

Vec3 ArmDynamics::weight(const Joints& q) const noexcept {
  const Masses& m = parameters_.masses;
  const Mat3 r = barrelFrame(q);
  const double lever =
      m.barrel * (parameters_.geometry.length_min + q[2] - m.barrel_setback) - m.counterweight * m.counterweight_arm;
  const Vec3 line = r.col(0);
  return {-lever * gravity_.dot(Vec3::UnitZ().cross(line)), lever * gravity_.dot(r.col(2)),
          -m.barrel * gravity_.dot(line)};
}

Vec3 ArmDynamics::tipForce(const ArmState& state) const noexcept {
  const Vec3 q_dot = state.p.cwiseQuotient(inertia(state.q));
  return springs(state.q, state.x, q_dot, state.v).force.tail<3>();
}

double ArmDynamics::energy(const ArmState& state, const TipLoad& load) const noexcept {
  const Masses& m = parameters_.masses;
  const double lever = m.barrel * (parameters_.geometry.length_min + state.q[2] - m.barrel_setback) -
                       m.counterweight * m.counterweight_arm;
  const Vec3 stop = beyond(parameters_.geometry, state.q);
  return 0.5 * state.p.cwiseAbs2().cwiseQuotient(inertia(state.q)).sum() + 0.5 * load.mass * state.v.squaredNorm() -
         lever * gravity_.dot(barrelFrame(state.q).col(0)) + 0.5 * stop.dot(kStop.cwiseProduct(stop)) +
         springs(state.q, state.x, Vec3::Zero(), Vec3::Zero()).energy +
         0.5 * load.stiffness * (load.target - state.x).squaredNorm() - load.force.dot(state.x);
}

ArmState ArmDynamics::atRest(const Vec3& p_DT) const noexcept {
  return {jointsAt(parameters_.geometry, p_DT), Vec3::Zero(), p_DT, Vec3::Zero()};
}

void ArmDynamics::step(ArmState& state, const Vec3& joint_torque, const TipLoad& load, double h) const noexcept {
  const Eigen::Map<const Vec3> viscous(parameters_.friction.viscous), coulomb(parameters_.friction.coulomb);
  const double half = 0.5 * h, spring = half * (half + parameters_.structure.damping_time);
  const int size = load.held ? 3 : 6;
  Vec6 before, w, friction = Vec6::Zero();
  before << state.p, load.mass * state.v;
  w << state.p.cwiseQuotient(inertia(state.q)), load.held ? Vec3::Zero() : state.v;
  friction.head<3>() = half * coulomb;
  Vec3 momentum = state.p;  // at the midpoint of the step
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Joints q = state.q + half * w.head<3>();
    const Vec3 x = state.x + half * w.tail<3>(), stop = beyond(parameters_.geometry, q);
    const Springs s = springs(q, x, w.head<3>(), w.tail<3>());
    Vec6 mass, force = s.force, diagonal;
    mass << inertia(q), Vec3::Constant(load.mass);
    force.head<3>() += centrifugal(q, w.head<3>()) - weight(q) - kStop.cwiseProduct(stop) + joint_torque -
                       viscous.cwiseProduct(w.head<3>());
    force.tail<3>() +=
        load.stiffness * (load.target - x) + load.damping * (load.target_velocity - w.tail<3>()) + load.force;
    const Vec6 r = before + half * force - mass.cwiseProduct(w);
    const Vec3 stopping = kStop.cwiseProduct(stop.cwiseAbs().cwiseSign());
    diagonal << mass.head<3>() + half * viscous + half * half * stopping,
        Vec3::Constant(load.mass + half * load.damping + half * half * load.stiffness);
    Mat6 a = spring * s.g.transpose() * s.k.asDiagonal() * s.g;
    a.diagonal() += diagonal;
    const Vec6 d = stepUnderFriction(a, r, w, friction, size);
    w += d;
    momentum = inertia(state.q + half * w.head<3>()).cwiseProduct(w.head<3>());
    if (d.cwiseAbs().maxCoeff() <= kClose * w.cwiseAbs().maxCoeff()) break;
  }
  for (int i = 0; i < 3; ++i)
    state.p[i] = friction[i] > 0 && w[i] == 0 ? 0 : 2 * momentum[i] - state.p[i];  // a sticking joint is at rest
  state.q += h * w.head<3>();
  if (load.held) return;
  state.x += h * w.tail<3>();
  state.v = 2 * w.tail<3>() - state.v;
}

}  // namespace presa::percro
