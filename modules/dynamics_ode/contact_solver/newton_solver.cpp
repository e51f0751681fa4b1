// Newton's method on a convex, piecewise smooth function; the line search makes every step a descent. Invariants: with
// converged cones friction is inside its round cone, opposes slip, and does no positive work; energy never rises but by
// what pushes overlaps apart. Three things make it fast: it starts from what every contact did in the step before, one
// iteration then suffices for a pile at rest; the factorisation is sparse; nothing depends on the order of contacts.
#include "modules/dynamics_ode/contact_solver/newton_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

constexpr double kConverged = 1e-7;      // last step [m/s, rad/s]
constexpr double kNoGain = 1e-18;        // last step with joints, in relation to the energy
constexpr double kConesStand = 1e-3;     // last change of a normal impulse, in relation to the largest
constexpr double kTouches = 1e-3;        // a gap that this closing speed closes within the step touches [m/s]
constexpr double kFlatEnough = 1e-3;     // slope at the end of a line search, in relation to that at its start
constexpr double kMotorSoftness = 1e-8;  // as Options::softness
constexpr int kSearchSteps = 20;
constexpr int kStiffSearchSteps = 60;  // with joints, whose friction and motors give way within 1e-10 of a step
constexpr int kAims = 20;              // corrections of the goals of joints between two minimisations
constexpr double kAimed = 1e-7;        // last of them [m/s, rad/s]
constexpr double kFree = 4;            // (h omega)^2 of a turn up to which a step follows it
constexpr double kShrinks = 0.8;       // each in relation to the one before
constexpr double kTurned = 1e-6;       // the same along the directions at the end [m/s, rad/s]
constexpr int kTurns = 20;             // minimisations for that

Mat3 cross(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

Mat3 frame(const Vec3& nhat, const Vec3& tangent) {
  Mat3 R;
  R.row(0) = nhat;
  R.row(1) = tangent;
  R.row(2) = nhat.cross(tangent);
  return R;
}

}  // namespace

NewtonSolver::NewtonSolver(const Options& options, std::size_t bodies, std::size_t contacts)
    : options_(options), matrix_(bodies) {
  pairs_.reserve(contacts);
  rows_.reserve(contacts);
  mass_.reserve(bodies);
  inertia_W_.reserve(bodies);
  for (Vector* vector : {&free_, &v_, &gradient_, &step_, &other_}) vector->reserve(bodies);
}

bool NewtonSolver::analyse(const ContactProblem& problem, std::size_t max_work) {
  pairs_.clear();
  for (const ContactProblem::Contact& c : problem.contacts) {
    if (c.A != ContactProblem::kFixed) pairs_.emplace_back(c.A, c.B);
  }
  for (const ContactProblem::Joint& joint : problem.joints) {
    if (joint.A != ContactProblem::kFixed && joint.B != ContactProblem::kFixed) pairs_.emplace_back(joint.A, joint.B);
  }
  return matrix_.analyse(problem.bodies.size(), pairs_, max_work);
}

void NewtonSolver::makeMasses(const ContactProblem& problem, double h) {
  const std::size_t count = problem.bodies.size();
  mass_.resize(count);
  inertia_W_.resize(count);
  for (Vector* vector : {&free_, &v_, &gradient_, &step_, &other_}) vector->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ContactProblem::Body& body = problem.bodies[i];
    const Mat3 R = body.q_WB.toRotationMatrix();
    mass_[i] = body.mass;
    inertia_W_[i] = R * body.inertia_B * R.transpose();
    v_[i] << body.v_WCm, body.w_WB;
    free_[i] << body.v_WCm + h / body.mass * body.force_W,
        body.w_WB + h * (R * (body.inverse_inertia_B * (R.transpose() * body.torque_W)));
  }
}

// A joint under tension turns a light body back with a stiffness that a step cannot follow: the lever arm turns while the
// force keeps its direction. Where h omega > 2 of a free turn the joints of the island act along their directions at the
// end of the step, which damps such turns. The stiffness, from the forces of the last step, lets this converge
// [Tournier2015]. Below all is as without.
void NewtonSolver::sumTurning(const ContactProblem& problem) {
  turning_.assign(problem.bodies.size(), Mat3::Zero());
  const auto add = [&](std::int32_t i, const Vec3& p_WJ, const Vec3& f_W) {
    if (i == ContactProblem::kFixed) return;
    const Vec3 r = p_WJ - problem.bodies[index(i)].p_WCm;
    turning_[index(i)] += f_W.dot(r) * Mat3::Identity() - (f_W * r.transpose() + r * f_W.transpose()) / 2;
  };
  for (const ContactProblem::Joint& joint : problem.joints) {
    const Vec3 p_WJ = centreOf(problem, joint.B) * joint.frames.X_BJ.p;
    add(joint.B, p_WJ, joint.f_B_W);
    add(joint.A, p_WJ, -joint.f_B_W);
  }
}

// By norms: a bound of the eigenvalues.
bool NewtonSolver::mayTurnFast(const ContactProblem& problem, double h) const {
  for (std::size_t i = 0; i < turning_.size(); ++i) {
    if (!(h * h * turning_[i].norm() * problem.bodies[i].inverse_inertia_B.norm() < kFree)) return true;
  }
  return false;
}

// Keeps of the sums what turns back. True where a step cannot follow it.
bool NewtonSolver::stiffenTurns(double h) {
  bool any = false;
  for (std::size_t i = 0; i < turning_.size(); ++i) {
    Eigen::SelfAdjointEigenSolver<Mat3> axes;
    axes.computeDirect(turning_[i]);
    turning_[i].setZero();
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = axes.eigenvectors().col(k);
      const double stiffness = h * h * std::max(0.0, axes.eigenvalues()[k]);
      any = any || stiffness > kFree * axis.dot(inertia_W_[i] * axis);
      turning_[i] += stiffness * axis * axis.transpose();
    }
  }
  return any;
}

void NewtonSolver::makeRows(const ContactProblem& problem, double h) {
  rows_.clear();
  rolls_.clear();
  axes_.clear();
  locked_.clear();
  for (const ContactProblem::Contact& contact : problem.contacts) addContact(problem, contact, h);
  for (const ContactProblem::Finger& finger : problem.fingers) addFinger(problem, finger, h);
  for (const ContactProblem::Motor& motor : problem.motors) addMotor(problem, motor, h);
  for (const ContactProblem::Joint& joint : problem.joints) addJoint(problem, joint, h);
}

void NewtonSolver::addContact(const ContactProblem& problem, const ContactProblem::Contact& c, double h) {
  const ContactProblem::Body& B = problem.bodies[index(c.B)];
  Row row{c.A, c.B, Vec3::Zero(), c.point() - B.p_WCm, frame(c.nhat_AB_W, c.nhat_AB_W.unitOrthogonal())};
  double inverse_mass = 1 / B.mass;
  if (c.A != ContactProblem::kFixed) {
    row.rA = c.point() - problem.bodies[index(c.A)].p_WCm;
    inverse_mass += 1 / problem.bodies[index(c.A)].mass;
  }
  row.k_n = row.k_t = 1 / std::min(options_.softness * inverse_mass, options_.max_compliance / h);
  row.mu = row.mu_slip = c.mu;
  row.startFrom(h * c.f_B_W);
  row.goal = row.impulse / row.k_t;
  row.goal.x() = c.gap > 0 ? -c.gap / h : std::min(-options_.erp * c.gap / h, options_.max_push);
  if (c.rolling > 0) addRoll(problem, c, row.R);
  rows_.push_back(row);
}

// Of the contact that becomes the next row.
void NewtonSolver::addRoll(const ContactProblem& problem, const ContactProblem::Contact& c, const Mat3& R) {
  const auto inverseInertia = [&](std::int32_t body) {
    return body == ContactProblem::kFixed ? 0 : problem.bodies[index(body)].inverse_inertia_B.trace() / 3;
  };
  const double k = 1 / (options_.softness * (inverseInertia(c.A) + inverseInertia(c.B)));
  rolls_.push_back({c.A, c.B, rows_.size(), R.bottomRows<2>(), k, c.rolling});
}

void NewtonSolver::addFinger(const ContactProblem& problem, const ContactProblem::Finger& finger, double h) {
  const FingerConstraint& c = *finger.constraint;
  const ContactProblem::Body& body = problem.bodies[index(finger.body)];
  Row row{ContactProblem::kFixed, finger.body, Vec3::Zero(), c.p_WP - body.p_WCm, frame(c.n_in, c.t1)};
  row.k_n = h / c.cfm;
  row.k_t = h / c.slip;
  row.goal = {c.erp / h * c.depth + c.motion_n, c.motion_1, c.motion_2};
  row.mu = c.mu;
  row.mu_slip = c.mu_dynamic;
  row.startFrom(h * c.expected_force_W);
  rows_.push_back(row);
}

void NewtonSolver::addMotor(const ContactProblem& problem, const ContactProblem::Motor& motor, double h) {
  const ContactProblem::Body& body = problem.bodies[index(motor.body)];
  AxisRow row;
  row.B = motor.body;
  row.J_B.segment<3>(motor.turns ? 3 : 0) = motor.axis_W;
  const double inertia = motor.turns ? body.inertia_B.trace() / 3 : body.mass;
  row.k = 1 / (kMotorSoftness / inertia + motor.compliance / h);
  row.goal = motor.velocity;
  row.high = h * motor.max_force;
  row.low = -row.high;
  axes_.push_back(row);
}

void NewtonSolver::addJoint(const ContactProblem& problem, const ContactProblem::Joint& joint, double h) {
  Locked rows;
  rows.first = axes_.size();
  rows.begin = appendRows(problem, joint, centreOf(problem, joint.A), centreOf(problem, joint.B), h, axes_);
  rows.count = rows.begin.count;
  rows.end = axes_.size();
  if (!is_stiff_) {
    for (std::size_t i = 0; i < rows.count; ++i) axes_[rows.first + i].goal += joint.lead[i];
  }
  locked_.push_back(rows);
}

NewtonSolver::Vec6 NewtonSolver::massTimes(std::size_t body, const Vec6& v) const {
  Vec6 p;
  p << mass_[body] * v.head<3>(), inertia_W_[body] * v.tail<3>();
  return p;
}

double NewtonSolver::valueAt(const Vector& v) const {
  double value = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec6 dv = v[i] - free_[i];
    value += massTimes(i, dv).dot(dv) / 2;
  }
  for (const Row& row : rows_) row.addPotential(row.velocityIn(v), value);
  for (const newton::Roll& roll : rolls_) {
    value += newton::huber(roll.k * roll.velocityIn(v).norm(), limitOf(roll), roll.k);
  }
  for (const AxisRow& row : axes_) value += row.potentialOf(row.springAt(newton::velocityIn(row, v)));
  return value;
}

// Gradient and factorised second derivative at v_, with contacts as `respond` says.
bool NewtonSolver::assemble(newton::Response (*respond)(const Row&, const Vec3&)) {
  matrix_.setZero();
  for (std::size_t i = 0; i < v_.size(); ++i) {
    gradient_[i] = massTimes(i, v_[i] - free_[i]);
    BlockCholesky::Block block = BlockCholesky::Block::Zero();
    block.topLeftCorner<3, 3>().diagonal().setConstant(mass_[i]);
    block.bottomRightCorner<3, 3>() = inertia_W_[i];
    matrix_.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(i), block);
  }
  for (const Row& row : rows_) {
    const auto [impulse, stiffness] = respond(row, row.velocityIn(v_));
    const Vec3 f = row.R.transpose() * impulse;
    const Mat3 K = row.R.transpose() * stiffness * row.R;
    Eigen::Matrix<double, 3, 6> J;
    J << Mat3::Identity(), -cross(row.rB);
    gradient_[index(row.B)] -= J.transpose() * f;
    const Eigen::Matrix<double, 3, 6> KJ = K * J;
    matrix_.add(row.B, row.B, J.transpose() * KJ);
    if (row.A == ContactProblem::kFixed) continue;
    J << -Mat3::Identity(), cross(row.rA);
    gradient_[index(row.A)] -= J.transpose() * f;
    matrix_.add(row.A, row.B, J.transpose() * KJ);
    matrix_.add(row.A, row.A, J.transpose() * (K * J));
  }
  for (const newton::Roll& roll : rolls_) assembleRoll(roll);
  for (const AxisRow& row : axes_) assembleAxis(row);
  return matrix_.factorise();
}

void NewtonSolver::assembleAxis(const AxisRow& row) {
  const double spring = row.springAt(newton::velocityIn(row, v_)), impulse = row.clamped(spring);
  const bool has_A = row.A != ContactProblem::kFixed, has_B = row.B != ContactProblem::kFixed,
             gives = row.gives(spring);
  if (has_B) gradient_[index(row.B)] -= impulse * row.J_B;
  if (has_A) gradient_[index(row.A)] -= impulse * row.J_A;
  if (!gives) return;
  if (has_B) matrix_.add(row.B, row.B, row.k * row.J_B * row.J_B.transpose());
  if (has_A) matrix_.add(row.A, row.A, row.k * row.J_A * row.J_A.transpose());
  if (has_A && has_B) matrix_.add(row.A, row.B, row.k * row.J_A * row.J_B.transpose());
}

void NewtonSolver::assembleRoll(const newton::Roll& roll) {
  const Eigen::Vector2d w = roll.velocityIn(v_);
  const Vec3 moment = roll.T.transpose() * roll.impulseAt(w, limitOf(roll));
  BlockCholesky::Block block = BlockCholesky::Block::Zero();
  block.bottomRightCorner<3, 3>() = roll.T.transpose() * roll.stiffnessAt(w, limitOf(roll)) * roll.T;
  gradient_[index(roll.B)].tail<3>() -= moment;
  matrix_.add(roll.B, roll.B, block);
  if (roll.A == ContactProblem::kFixed) return;
  gradient_[index(roll.A)].tail<3>() += moment;
  matrix_.add(roll.A, roll.A, block);
  matrix_.add(roll.A, roll.B, -block);
}

// Where every contact does what it did in the step before, and a new one that would close sticks, the problem is linear.
// Its solution replaces v where it is better.
bool NewtonSolver::guess() {
  for (Row& row : rows_) {
    row.is_new = row.normal <= 0;
    row.closes = !row.is_new || row.goal.x() > -kTouches || row.velocityIn(free_).x() < row.goal.x();
    row.sticks = row.sticks || row.is_new;
  }
  if (!assemble(newton::expectedOf)) return false;
  newtonStep();
  for (std::size_t i = 0; i < v_.size(); ++i) other_[i] = v_[i] + step_[i];
  for (Row& row : rows_) {
    if (row.is_new && row.closes) row.normal = row.impulseAt(row.velocityIn(other_)).x();
  }
  if (valueAt(other_) < valueAt(v_)) std::swap(v_, other_);
  return true;
}

void NewtonSolver::newtonStep() {
  for (std::size_t i = 0; i < v_.size(); ++i) step_[i] = -gradient_[i];
  matrix_.solve(step_);
}

double NewtonSolver::slopeAt(double alpha, const Vector& v, const Vector& dv, double& curvature) const {
  double slope = 0;
  curvature = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec6 p = massTimes(i, dv[i]);
    curvature += p.dot(dv[i]);
    slope += p.dot(v[i] - free_[i]);
  }
  slope += alpha * curvature;
  for (const Row& row : rows_) {
    const Vec3 du = row.velocityIn(dv);
    const auto [impulse, stiffness] = newton::responseOf(row, row.velocityIn(v) + alpha * du);
    slope -= impulse.dot(du);
    curvature += du.dot(stiffness * du);
  }
  for (const newton::Roll& roll : rolls_) {
    const Eigen::Vector2d dw = roll.velocityIn(dv), w = roll.velocityIn(v) + alpha * dw;
    slope -= roll.impulseAt(w, limitOf(roll)).dot(dw);
    curvature += dw.dot(roll.stiffnessAt(w, limitOf(roll)) * dw);
  }
  for (const AxisRow& row : axes_) {
    const double du = newton::velocityIn(row, dv);
    const double spring = row.k * (row.goal - newton::velocityIn(row, v) - alpha * du);
    slope -= row.clamped(spring) * du;
    if (row.gives(spring)) curvature += row.k * du * du;
  }
  return slope;
}

// The slope along dv rises monotonically from a negative value: its zero by safeguarded Newton steps, at most the full
// step.
double NewtonSolver::lineSearch(const Vector& v, const Vector& dv) const {
  double curvature = 0, low = 0, high = 1, alpha = 1;
  const double at_start = slopeAt(0, v, dv, curvature);
  const int steps = locked_.empty() ? kSearchSteps : kStiffSearchSteps;
  for (int i = 0; i < steps; ++i) {
    const double slope = slopeAt(alpha, v, dv, curvature);
    if ((slope <= 0 && alpha == 1) || std::abs(slope) < kFlatEnough * std::abs(at_start)) break;
    (slope > 0 ? high : low) = alpha;
    const double newton = alpha - slope / curvature;
    alpha = newton > low && newton < high ? newton : (low + high) / 2;
  }
  return alpha;
}

// With joints, so stiff that the velocities of light bodies have no more digits, by energy: what the step can still gain
// against what moves, or would at 1 m/s.
bool NewtonSolver::arrived() const noexcept {
  if (locked_.empty()) {
    return std::ranges::all_of(step_, [](const Vec6& dv) { return dv.lpNorm<Eigen::Infinity>() < kConverged; });
  }
  double gain = 0, moves = 0;
  for (std::size_t i = 0; i < v_.size(); ++i) {
    gain -= gradient_[i].dot(step_[i]);
    moves += mass_[i] + massTimes(i, v_[i]).dot(v_[i]);
  }
  return gain < kNoGain * moves;
}

bool NewtonSolver::minimise() {
  ends_stand_ = false;
  const std::size_t affordable = options_.max_products / std::max<std::size_t>(1, matrix_.work());
  const std::size_t iterations = std::clamp(affordable, kMinIterations, options_.max_iterations);
  for (std::size_t i = 0; i < iterations; ++i) {
    ++counts.iterations;
    if (!assemble(newton::responseOf)) return false;
    newtonStep();
    const bool converged = arrived();
    const double alpha = converged ? 1 : lineSearch(v_, step_);
    for (std::size_t k = 0; k < v_.size(); ++k) v_[k] += alpha * step_[k];
    if (converged) return true;
  }
  return false;
}

// Lets the cones stand on the present normal impulses. Returns the largest change relative to the largest impulse.
double NewtonSolver::standCones() {
  double change = 0, largest = 0;
  for (Row& row : rows_) {
    const Vec3 impulse = row.impulseAt(row.velocityIn(v_));
    const bool slips = impulse.x() > 0 && impulse.tail<2>().norm() >= (1 - 1e-6) * row.mu * row.normal;
    if (slips && row.mu_slip < row.mu) {
      row.mu = row.mu_slip;
      change = 1e300;
    }
    change = std::max(change, std::abs(impulse.x() - row.normal));
    largest = std::max(largest, impulse.x());
    row.normal = impulse.x();
  }
  return change > 0 ? change / largest : 0;  // infinite where all contacts part: friction must part, too
}

void NewtonSolver::giveBack(ContactProblem& problem, double h) const {
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    ContactProblem::Body& body = problem.bodies[i];
    const End end = ends_stand_ ? ends_[i] : endOf(body, v_[i], h);
    body.v_WCm = v_[i].head<3>();
    body.p_WCm = end.X_WCm.p;
    body.q_WB = end.X_WCm.q;
    body.w_WB = end.w_WB;
  }
  const auto force = [&](const Row& row) { return Vec3(row.R.transpose() * row.impulseAt(row.velocityIn(v_)) / h); };
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) problem.contacts[i].f_B_W = force(rows_[i]);
  for (const newton::Roll& roll : rolls_) {
    problem.contacts[roll.row].m_B_W = roll.T.transpose() * roll.impulseAt(roll.velocityIn(v_), limitOf(roll)) / h;
  }
  for (std::size_t i = 0; i < problem.fingers.size(); ++i) {
    problem.fingers[i].f_B_W = force(rows_[problem.contacts.size() + i]);
  }
}

NewtonSolver::End NewtonSolver::endOf(const ContactProblem::Body& body, const Vec6& v, double h) const {
  End end{{body.p_WCm + h * v.head<3>(), body.q_WB}, v.tail<3>()};
  const auto turn = locked_.empty() ? driftRotation : magnusRotation;
  turn(end.X_WCm.q, end.w_WB, body.inertia_B, body.inverse_inertia_B, h);
  return end;
}

Pose NewtonSolver::poseAtEnd(std::int32_t i) const {
  return i == ContactProblem::kFixed ? Pose() : ends_[index(i)].X_WCm;
}

// What the joints would miss at the end of the step, as bodies turn and joints with them: to be added to the goals of
// locked directions. Returns the largest [m/s, rad/s].
double NewtonSolver::missOf(const ContactProblem& problem, double h) {
  ends_.resize(problem.bodies.size());
  for (std::size_t i = 0; i < ends_.size(); ++i) ends_[i] = endOf(problem.bodies[i], v_[i], h);
  ends_stand_ = true;
  double largest = 0;
  for (std::size_t j = 0; j < problem.joints.size(); ++j) {
    const ContactProblem::Joint& joint = problem.joints[j];
    Locked& rows = locked_[j];
    const JointGap end = gapOf(joint, poseAtEnd(joint.A), poseAtEnd(joint.B));
    for (std::size_t i = 0; i < rows.count; ++i) {
      const double wanted = rows.begin.of[i] - closable(rows.begin, i, h);
      rows.miss[i] = (wanted - end.of[i]) / h;
      largest = std::max(largest, std::abs(rows.miss[i]));
    }
  }
  return largest;
}

// With all else as it was in the last minimisation.
void NewtonSolver::moveGoals() {
  for (Vec6& dv : step_) dv.setZero();
  for (const Locked& rows : locked_) {
    for (std::size_t i = 0; i < rows.count; ++i) {
      AxisRow& row = axes_[rows.first + i];
      row.goal += rows.miss[i];
      if (row.B != ContactProblem::kFixed) step_[index(row.B)] += row.k * rows.miss[i] * row.J_B;
      if (row.A != ContactProblem::kFixed) step_[index(row.A)] += row.k * rows.miss[i] * row.J_A;
    }
  }
  matrix_.solve(step_);
  for (std::size_t k = 0; k < v_.size(); ++k) v_[k] += step_[k];
  ends_stand_ = false;
}

bool NewtonSolver::hasBounds() const noexcept {
  std::size_t locked = 0;
  for (const Locked& rows : locked_) locked += rows.count;
  return !rows_.empty() || locked < axes_.size();
}

// Joints act along their directions at the end of the step: the nearest velocities at which they close there. The
// stiffness holds on to the velocities of the last iteration, so that it is gone when they stand. True until then.
bool NewtonSolver::turnJoints(const ContactProblem& problem, double h) {
  const bool first = free_turn_.empty();
  if (first) {
    for (const Vec6& v : free_) free_turn_.push_back(v.tail<3>());
    own_inertia_W_ = inertia_W_;
    for (std::size_t i = 0; i < turning_.size(); ++i) inertia_W_[i] += turning_[i];
  }
  if (missOf(problem, h) < kTurned && !first) return false;
  for (std::size_t i = 0; i < turning_.size(); ++i) {
    const Vec3 momentum = own_inertia_W_[i] * free_turn_[i] + turning_[i] * Vec3(v_[i].tail<3>());
    free_[i].tail<3>() = inertia_W_[i].ldlt().solve(momentum);
  }
  for (std::size_t j = 0; j < problem.joints.size(); ++j) {
    const ContactProblem::Joint& joint = problem.joints[j];
    const Locked& rows = locked_[j];
    turned_.clear();
    appendRows(problem, joint, poseAtEnd(joint.A), poseAtEnd(joint.B), h, turned_);
    for (std::size_t i = 0; i < turned_.size(); ++i) {
      AxisRow& row = axes_[rows.first + i];
      row.J_A = turned_[i].J_A;
      row.J_B = turned_[i].J_B;
      if (i < rows.count) row.goal = newton::velocityIn(row, v_) + rows.miss[i];
    }
  }
  return true;
}

// True when contacts, stops and joints have to be looked at again. Where corrections along the directions at the start do
// not shrink, as with light bodies between heavy ones that turn fast, those at the end are taken.
bool NewtonSolver::aimJoints(const ContactProblem& problem, double h) {
  if (problem.joints.empty()) return false;
  if (is_stiff_) return turnJoints(problem, h);
  bool moved = false;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kAims; ++i) {
    const double miss = missOf(problem, h);
    if (miss < kAimed) break;
    if (!(miss < kShrinks * last)) {
      if (miss < kTurned) break;
      is_stiff_ = true;
      sumTurning(problem);
      stiffenTurns(h);
      return turnJoints(problem, h);
    }
    moveGoals();
    moved = true;
    last = miss;
  }
  return moved && hasBounds();
}

void NewtonSolver::giveBackJoints(ContactProblem& problem, double h) const {
  for (std::size_t j = 0; j < problem.joints.size(); ++j) {
    ContactProblem::Joint& joint = problem.joints[j];
    const Locked& rows = locked_[j];
    joint.lead.fill(0);  // that of an axis, too, which has no row here and would run away
    for (std::size_t i = 0; i < rows.count; ++i)
      joint.lead[i] = is_stiff_ ? 0 : axes_[rows.first + i].goal + closable(rows.begin, i, h) / h;
    joint.f_B_W = joint.m_B_W = Vec3::Zero();
    for (std::size_t i = locked_[j].first; i < locked_[j].end; ++i) {
      const AxisRow& row = axes_[i];
      addLoad(row, row.clamped(row.springAt(newton::velocityIn(row, v_))) / h, joint);
    }
  }
}

bool NewtonSolver::solve(ContactProblem& problem, double h) {
  ++counts.solves;
  makeMasses(problem, h);
  free_turn_.clear();
  is_stiff_ = false;
  if (!problem.joints.empty()) {
    sumTurning(problem);
    is_stiff_ = mayTurnFast(problem, h) && stiffenTurns(h);
  }
  makeRows(problem, h);
  bool converged = guess() && minimise();
  for (int cone = 1; converged && cone < options_.max_cones + (is_stiff_ ? kTurns : 0); ++cone) {
    const bool cones_moved = standCones() > kConesStand, joints_moved = aimJoints(problem, h);
    if (!cones_moved && !joints_moved) break;
    converged = minimise();
  }
  if (!converged) {
    ++counts.failures;
    return false;
  }
  giveBackJoints(problem, h);
  giveBack(problem, h);
  return true;
}

}  // namespace presa::ode
