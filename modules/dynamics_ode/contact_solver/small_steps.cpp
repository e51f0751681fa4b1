// Projected Gauss-Seidel in small steps. Invariants: a normal impulse never pulls, friction stays inside its round cone,
// a motor within its force; equal problems give equal bits, since rows are visited in their order and back.
#include "modules/dynamics_ode/contact_solver/small_steps.h"

#include <algorithm>
#include <cmath>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

constexpr double kMinSine = 0.02;  // of a rim's axis, sine

void push(ContactProblem::Body& body, double inverse_mass, const Vec3& d, const Vec3& i, double impulse) {
  body.v_WCm += inverse_mass * impulse * d;
  body.w_WB += impulse * i;
}

}  // namespace

void SmallSteps::turnInertia(std::size_t i) {
  const Mat3 R = problem_->bodies[i].q_WB.toRotationMatrix();
  inverse_inertia_W_[i] = R * problem_->bodies[i].inverse_inertia_B * R.transpose();
}

void SmallSteps::prepare() {
  const std::vector<Body>& bodies = problem_->bodies;
  inverse_inertia_W_.resize(bodies.size());
  begin_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    turnInertia(i);
    begin_[i] = bodies[i].p_WCm;
  }
  contacts_.clear();
  rolls_.clear();
  for (const ContactProblem::Contact& c : problem_->contacts) {
    const Vec3 friction = c.f_B_W - c.f_B_W.dot(c.nhat_AB_W) * c.nhat_AB_W;
    const double length = friction.norm();
    ContactRow& row = contacts_.emplace_back();
    row.A = c.A;
    row.B = c.B;
    connect(row, c.point(), c.nhat_AB_W, length > 1e-12 ? Vec3(friction / length) : c.nhat_AB_W.unitOrthogonal());
    row.gap_begin = row.gap = c.gap;
    if (c.rim_A) row.rim_A = &c.rim_A;
    if (c.rim_B) row.rim_B = &c.rim_B;
    row.reach_begin = reachOf(row);
    row.mu = c.mu;
    row.n.impulse = std::max(0.0, h_ * c.f_B_W.dot(c.nhat_AB_W));
    row.t1.impulse = h_ * length;
    if (c.rolling > 0)
      rolls_.push_back(
          {contacts_.size() - 1, c.rolling, h_ * Eigen::Vector2d(c.m_B_W.dot(row.t1.d), c.m_B_W.dot(row.t2.d))});
  }
  fingers_.clear();
  for (const ContactProblem::Finger& finger : problem_->fingers) {
    const FingerConstraint& c = *finger.constraint;
    FingerRow& row = fingers_.emplace_back();
    row.B = finger.body;
    row.constraint = &c;
    connect(row, c.p_WP, c.n_in, c.t1);
    row.depth = c.spring.depth;
    row.u1 = c.spring.stretch;
    row.mu = c.mu;
    row.n.impulse = std::max(0.0, h_ * c.expected_force_W.dot(c.n_in));
    row.t1.impulse = h_ * c.expected_force_W.dot(c.t1);
  }
  motors_.clear();
  for (const ContactProblem::Motor& motor : problem_->motors) {
    const std::size_t b = index(motor.body);
    const double inverse = motor.turns ? motor.axis_W.dot(inverse_inertia_W_[b] * motor.axis_W) : 1 / bodies[b].mass;
    motors_.push_back({motor, 1 / (inverse + motor.compliance / h_)});
  }
}

SmallSteps::Softness SmallSteps::softnessOf(double stiffness) const {
  const double c = stiffness * (2 * options_.damping + stiffness);
  return {stiffness / h_ / (2 * options_.damping + stiffness), c / (1 + c), 1 / (1 + c)};
}

void SmallSteps::soften() {
  touched_.assign(problem_->bodies.size(), 0);
  for (const FingerRow& finger : fingers_) touched_[index(finger.B)] = 1;
  const double stiffness = fingers_.empty() ? options_.stiffness : options_.touched;
  const Softness usual = softnessOf(stiffness);
  for (ContactRow& row : contacts_) {
    const bool touched =
        touched_[index(row.B)] != 0 || (row.A != ContactProblem::kFixed && touched_[index(row.A)] != 0);
    const double hard = touched ? h_ * std::sqrt(options_.min_touched / row.n.mass) : 0;
    row.soft = hard > stiffness ? softnessOf(hard) : usual;
  }
}

void SmallSteps::connect(Row& row, const Vec3& p_W, const Vec3& nhat, const Vec3& tangent) const {
  const Body& B = problem_->bodies[index(row.B)];
  row.inverse_mass_B = 1 / B.mass;
  row.rB_W = p_W - B.p_WCm;
  row.rB_B = B.q_WB.conjugate() * row.rB_W;
  row.rA_W = row.rA_A = Vec3::Zero();
  if (row.A != ContactProblem::kFixed) {
    const Body& A = problem_->bodies[index(row.A)];
    row.inverse_mass_A = 1 / A.mass;
    row.rA_W = p_W - A.p_WCm;
    row.rA_A = A.q_WB.conjugate() * row.rA_W;
  }
  row.n = axisOf(row, nhat);
  row.t1 = axisOf(row, tangent);
  row.t2 = axisOf(row, nhat.cross(tangent));
}

SmallSteps::Axis SmallSteps::axisOf(const Row& row, const Vec3& direction) const {
  Axis axis;
  axis.d = direction;
  axis.rB_d = row.rB_W.cross(direction);
  axis.iB = inverse_inertia_W_[index(row.B)] * axis.rB_d;
  double inverse = row.inverse_mass_B + axis.rB_d.dot(axis.iB);
  axis.rA_d = axis.iA = Vec3::Zero();
  if (row.A != ContactProblem::kFixed) {
    axis.rA_d = row.rA_W.cross(direction);
    axis.iA = inverse_inertia_W_[index(row.A)] * axis.rA_d;
    inverse += row.inverse_mass_A + axis.rA_d.dot(axis.iA);
  }
  axis.mass = 1 / inverse;
  return axis;
}

void SmallSteps::addForces() {
  for (std::size_t i = 0; i < problem_->bodies.size(); ++i) {
    Body& body = problem_->bodies[i];
    body.v_WCm += h_ / body.mass * body.force_W;
    body.w_WB += h_ * (inverse_inertia_W_[i] * body.torque_W);
  }
}

// Adds to the impulse of an axis.
void SmallSteps::apply(const Row& row, Axis& axis, double impulse) {
  push(problem_->bodies[index(row.B)], row.inverse_mass_B, axis.d, axis.iB, impulse);
  if (row.A != ContactProblem::kFixed) {
    push(problem_->bodies[index(row.A)], row.inverse_mass_A, axis.d, axis.iA, -impulse);
  }
}

void SmallSteps::warmStart() {
  const auto start = [&](Row& row) {
    for (Axis* axis : {&row.n, &row.t1, &row.t2}) apply(row, *axis, axis->impulse);
  };
  for (ContactRow& row : contacts_) start(row);
  for (FingerRow& row : fingers_) start(row);
  for (const RollRow& row : rolls_) turn(row, row.impulse);
  for (MotorRow& row : motors_) row.impulse = 0;
}

double SmallSteps::speedOf(const Row& row, const Axis& axis) const {
  const Body& B = problem_->bodies[index(row.B)];
  const double speed = axis.d.dot(B.v_WCm) + axis.rB_d.dot(B.w_WB);
  if (row.A == ContactProblem::kFixed) return speed;
  const Body& A = problem_->bodies[index(row.A)];
  return speed - axis.d.dot(A.v_WCm) - axis.rA_d.dot(A.w_WB);
}

void SmallSteps::solveContact(ContactRow& row, bool feedback) {
  double bias = row.n.d.dot(row.drift_W), mass_scale = 1, impulse_scale = 0;
  if (row.gap > 0) {
    bias += row.gap / h_;
  } else if (feedback) {
    bias += std::max(row.soft.bias_rate * row.gap, -options_.max_push);
    mass_scale = row.soft.mass_scale;
    impulse_scale = row.soft.impulse_scale;
  }
  const double before = row.n.impulse;
  row.n.impulse =
      std::max(0.0, before - row.n.mass * mass_scale * (speedOf(row, row.n) + bias) - impulse_scale * before);
  apply(row, row.n, row.n.impulse - before);

  const double f1 = row.t1.impulse - row.t1.mass * (speedOf(row, row.t1) + row.t1.d.dot(row.drift_W));
  const double f2 = row.t2.impulse - row.t2.mass * (speedOf(row, row.t2) + row.t2.d.dot(row.drift_W));
  const double limit = row.mu * row.n.impulse, length = std::sqrt(f1 * f1 + f2 * f2);
  const double shrink = length > limit ? limit / length : 1;
  apply(row, row.t1, shrink * f1 - row.t1.impulse);
  apply(row, row.t2, shrink * f2 - row.t2.impulse);
  row.t1.impulse = shrink * f1;
  row.t2.impulse = shrink * f2;
}

// Adds to the angular impulse.
void SmallSteps::turn(const RollRow& row, const Eigen::Vector2d& impulse) {
  const ContactRow& contact = contacts_[row.contact];
  const Vec3 impulse_W = impulse.x() * contact.t1.d + impulse.y() * contact.t2.d;
  problem_->bodies[index(contact.B)].w_WB += inverse_inertia_W_[index(contact.B)] * impulse_W;
  if (contact.A == ContactProblem::kFixed) return;
  problem_->bodies[index(contact.A)].w_WB -= inverse_inertia_W_[index(contact.A)] * impulse_W;
}

void SmallSteps::solveRoll(RollRow& row) {
  const ContactRow& contact = contacts_[row.contact];
  Mat3 inverse = inverse_inertia_W_[index(contact.B)];
  Vec3 w = problem_->bodies[index(contact.B)].w_WB;
  if (contact.A != ContactProblem::kFixed) {
    inverse += inverse_inertia_W_[index(contact.A)];
    w -= problem_->bodies[index(contact.A)].w_WB;
  }
  Eigen::Vector2d wanted = row.impulse;
  wanted.x() -= w.dot(contact.t1.d) / contact.t1.d.dot(inverse * contact.t1.d);
  wanted.y() -= w.dot(contact.t2.d) / contact.t2.d.dot(inverse * contact.t2.d);
  const double limit = row.length * contact.n.impulse, size = wanted.norm();
  if (size > limit) wanted *= limit / size;
  turn(row, wanted - row.impulse);
  row.impulse = wanted;
}

// u + impulse / (h (hk + d)) = k stretch / (hk + d), with u the velocity of the touched point against the finger.
double SmallSteps::springImpulse(const FingerRow& row, const Axis& axis, double k, double d, double stretch) const {
  const double u = speedOf(row, axis) - axis.d.dot(row.constraint->spring.v_WH);
  const double hk_d = h_ * k + d, compliance = 1 / (h_ * hk_d);
  return axis.impulse + (k * stretch / hk_d - u - compliance * axis.impulse) / (1 / axis.mass + compliance);
}

void SmallSteps::solveFinger(FingerRow& row) {
  const FingerConstraint::Spring& spring = row.constraint->spring;
  const double before = row.n.impulse;
  row.n.impulse = std::max(0.0, springImpulse(row, row.n, spring.k, spring.d, row.depth));
  apply(row, row.n, row.n.impulse - before);
  if (!(h_ * spring.k_t + spring.d_t > 0)) return;
  const double f1 = springImpulse(row, row.t1, spring.k_t, spring.d_t, row.u1);
  const double f2 = springImpulse(row, row.t2, spring.k_t, spring.d_t, row.u2);
  const double length = std::sqrt(f1 * f1 + f2 * f2);
  double shrink = 1;
  if (length > row.mu * row.n.impulse) {
    row.mu = row.constraint->mu_dynamic;
    shrink = row.mu * row.n.impulse / length;
  }
  apply(row, row.t1, shrink * f1 - row.t1.impulse);
  apply(row, row.t2, shrink * f2 - row.t2.impulse);
  row.t1.impulse = shrink * f1;
  row.t2.impulse = shrink * f2;
}

void SmallSteps::solveMotor(MotorRow& row) {
  const ContactProblem::Motor& motor = row.motor;
  Body& body = problem_->bodies[index(motor.body)];
  const double u = motor.axis_W.dot(motor.turns ? body.w_WB : body.v_WCm);
  const double wanted = row.impulse + row.mass * (motor.velocity - u - motor.compliance / h_ * row.impulse);
  const double impulse = std::clamp(wanted, -h_ * motor.max_force, h_ * motor.max_force) - row.impulse;
  row.impulse += impulse;
  if (motor.turns) {
    body.w_WB += impulse * (inverse_inertia_W_[index(motor.body)] * motor.axis_W);
  } else {
    body.v_WCm += impulse / body.mass * motor.axis_W;
  }
}

// Forwards with feedback, backwards without: a load reaches both ends of a stack.
void SmallSteps::sweep(bool feedback) {
  joints_.sweep(feedback);
  for (MotorRow& row : motors_) solveMotor(row);
  for (FingerRow& row : fingers_) solveFinger(row);
  if (feedback) {
    for (ContactRow& row : contacts_) solveContact(row, true);
  } else {
    for (auto row = contacts_.rbegin(); row != contacts_.rend(); ++row) solveContact(*row, false);
  }
  for (RollRow& row : rolls_) solveRoll(row);
}

Vec3 SmallSteps::movedAt(const Row& row) const {
  const std::size_t b = index(row.B);
  const Vec3 moved = problem_->bodies[b].p_WCm - begin_[b] + problem_->bodies[b].q_WB * row.rB_B - row.rB_W;
  if (row.A == ContactProblem::kFixed) return moved;
  const std::size_t a = index(row.A);
  return moved - (problem_->bodies[a].p_WCm - begin_[a] + problem_->bodies[a].q_WB * row.rA_A - row.rA_W);
}

void SmallSteps::advance() {
  for (Body& body : problem_->bodies) {
    body.p_WCm += h_ * body.v_WCm;
    driftRotation(body.q_WB, body.w_WB, body.inertia_B, body.inverse_inertia_B, h_);
  }
  for (ContactRow& row : contacts_) row.gap = gapOf(row);
}

// How far the surfaces of the bodies reach along the normal, B's less A's, from where the bodies began.
double SmallSteps::reachOf(const ContactRow& row) const {
  const auto reach = [&](std::int32_t body, const Rim* rim, const Vec3& r_B, double sign) {
    const Body& at = problem_->bodies[index(body)];
    const Vec3 r_W = rim != nullptr ? rim->farthest(at.q_WB, -sign * row.n.d) : at.q_WB * r_B;
    return sign * row.n.d.dot(at.p_WCm - begin_[index(body)] + r_W);
  };
  const double of_B = reach(row.B, row.rim_B, row.rB_B, 1);
  return row.A == ContactProblem::kFixed ? of_B : of_B + reach(row.A, row.rim_A, row.rA_A, -1);
}

double SmallSteps::gapOf(const ContactRow& row) const {
  if (row.rim_A == nullptr && row.rim_B == nullptr) return row.gap_begin + row.n.d.dot(movedAt(row));
  return row.gap_begin + reachOf(row) - row.reach_begin;
}

// Contacts on rims act where they will be `ahead` [s] from now: in the middle of a small step, so that its motion is
// followed to second order, or at its end, where no velocity may be left that lets the rim sink in.
void SmallSteps::followRims(double ahead) {
  for (ContactRow& row : contacts_) {
    if (row.rim_A == nullptr && row.rim_B == nullptr) continue;
    row.drift_W = Vec3::Zero();
    for (const std::int32_t body : {row.A, row.B}) {
      if (body != ContactProblem::kFixed) turnInertia(index(body));
    }
    if (row.rim_B != nullptr) row.rB_W = armAhead(row, *row.rim_B, row.B, 1, ahead);
    if (row.rim_A != nullptr) row.rA_W = armAhead(row, *row.rim_A, row.A, -1, ahead);
    for (Axis* axis : {&row.n, &row.t1, &row.t2}) {
      const double impulse = axis->impulse;
      *axis = axisOf(row, axis->d);
      axis->impulse = impulse;
    }
  }
}

// `sign`: 1 for B, -1 for A. Adds to the drift of the row.
Vec3 SmallSteps::armAhead(ContactRow& row, const Rim& rim, std::int32_t body, double sign, double ahead) const {
  Body later = problem_->bodies[index(body)];
  if (ahead > 0) {  // with the impulses of the warm start
    for (const Axis* axis : {&row.n, &row.t1, &row.t2}) {
      later.w_WB += sign * axis->impulse * (sign > 0 ? axis->iB : axis->iA);
    }
  }
  const Vec3 w_WB = later.w_WB;
  driftRotation(later.q_WB, later.w_WB, later.inertia_B, later.inverse_inertia_B, ahead);
  const Vec3 r_W = rim.farthest(later.q_WB, -sign * row.n.d);
  row.drift_W += sign * (later.w_WB - w_WB).cross(r_W);
  return r_W;
}

// How far the lowest point of a rim runs around it in `period`: as the axis goes round the normal, faster than the body
// turns [rad].
double SmallSteps::runOf(const Rim& rim, std::int32_t body, const Vec3& nhat_W, double period) const {
  if (!rim) return 0;
  const Body& of = problem_->bodies[index(body)];
  const Vec3 axis = of.q_WB * rim.axis_B;
  return period * of.w_WB.cross(axis).norm() / std::max(kMinSine, axis.cross(nhat_W).norm());
}

int SmallSteps::countFor(double period) const {
  if (problem_->bodies.size() > options_.max_wobbling) return options_.count;
  double run = 0;
  for (const ContactProblem::Contact& c : problem_->contacts) {
    run = std::max({run, runOf(c.rim_A, c.A, c.nhat_AB_W, period), runOf(c.rim_B, c.B, c.nhat_AB_W, period)});
  }
  const double count = std::clamp(run / options_.rim_run, double(options_.count), double(options_.max_count));
  return static_cast<int>(count);
}

void SmallSteps::followFingers(double time) {
  for (FingerRow& row : fingers_) {
    const FingerConstraint::Spring& spring = row.constraint->spring;
    row.sum_W += row.n.impulse * row.n.d + row.t1.impulse * row.t1.d + row.t2.impulse * row.t2.d;
    const Vec3 moved = movedAt(row) - time * spring.v_WH;
    row.depth = spring.depth - row.n.d.dot(moved);
    row.u1 = spring.stretch - row.t1.d.dot(moved);
    row.u2 = -row.t2.d.dot(moved);
  }
}

void SmallSteps::giveBack(double period) {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const ContactRow& row = contacts_[i];
    problem_->contacts[i].f_B_W =
        (row.n.impulse * row.n.d + row.t1.impulse * row.t1.d + row.t2.impulse * row.t2.d) / h_;
  }
  for (const RollRow& row : rolls_) {
    const ContactRow& contact = contacts_[row.contact];
    problem_->contacts[row.contact].m_B_W = (row.impulse.x() * contact.t1.d + row.impulse.y() * contact.t2.d) / h_;
  }
  joints_.giveBack(h_);
  for (std::size_t i = 0; i < fingers_.size(); ++i) problem_->fingers[i].f_B_W = fingers_[i].sum_W / period;
}

void SmallSteps::solve(ContactProblem& problem, double period) {
  problem_ = &problem;
  const int count = countFor(period);
  h_ = period / count;
  prepare();
  soften();
  joints_.begin();
  for (int step = 0; step < count; ++step) {
    if (!problem.joints.empty()) {  // before the forces: springs start from the velocities at the begin
      for (std::size_t i = 0; i < problem.bodies.size(); ++i) turnInertia(i);
      joints_.beginStep(problem, inverse_inertia_W_, h_);
    }
    addForces();
    followRims(h_ / 2);
    warmStart();
    sweep(true);
    advance();
    followRims(0);
    sweep(false);
    followFingers((step + 1) * h_);
  }
  giveBack(period);
}

}  // namespace presa::ode
