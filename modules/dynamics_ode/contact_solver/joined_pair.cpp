// Everything is in the axes of J in A at the start of the step, W where A does not move. Six rows: B moves against A along
// x, y, z and turns about x, y, z; those that the joint leaves free are taken out of the matrix.
#include "modules/dynamics_ode/contact_solver/joined_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "framework/geometry/index.h"
#include "modules/dynamics_ode/contact_solver/joint_rows.h"
#include "modules/dynamics_ode/joints/joint_pose.h"
#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace {

using Row6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kMaxCloses = 8;         // corrections
constexpr double kClosed = 1e-7;      // last of them [m/s, rad/s]
constexpr double kKeepsOn = 0.8;      // each in relation to the one before
constexpr std::size_t kAxisLead = 5;  // of the axis of a hinge or a slider, among the leads
constexpr double kTurnsFast = 4;      // (h omega)^2 of a body under the joint's force that a step does not follow

// Rows that a joint locks, in the order of joint_rows.h.
std::span<const int> lockedRowsOf(JointType type) {
  static constexpr std::array<int, 6> all{0, 1, 2, 3, 4, 5};
  static constexpr std::array<int, 5> slider{0, 1, 3, 4, 5};
  switch (type) {
    case JointType::kFixed:
      return all;
    case JointType::kHinge:
      return std::span(all).first<5>();
    case JointType::kSlider:
      return slider;
    case JointType::kBall:
      return std::span(all).first<3>();
    default:
      return {};
  }
}

bool isOneJoint(const ContactProblem& problem) {
  if (problem.joints.size() != 1 || problem.bodies.size() > 2) return false;
  if (!problem.contacts.empty() || !problem.fingers.empty() || !problem.motors.empty()) return false;
  const Joint& joint = *problem.joints[0].joint;
  return !lockedRowsOf(joint.type).empty() && (joint.type != JointType::kBall || joint.axes.empty());
}

Mat3 crossing(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

// Inverse of a symmetric positive definite matrix by its blocks of 3 x 3.
class Inverse6 {
 public:
  void compute(const Matrix6& m) {
    first_ = m.topLeftCorner<3, 3>().inverse();
    across_ = m.bottomLeftCorner<3, 3>() * first_;
    rest_ = (m.bottomRightCorner<3, 3>() - across_ * m.topRightCorner<3, 3>()).inverse();
  }
  Row6 operator*(const Row6& b) const {
    const Vec3 low = rest_ * (b.tail<3>() - across_ * b.head<3>());
    Row6 x;
    x << first_ * b.head<3>() - across_.transpose() * low, low;
    return x;
  }

 private:
  Mat3 first_, across_, rest_;
};

// One of the two bodies; empty where it does not move.
struct Side {
  ContactProblem::Body* body = nullptr;
  Mat3 inverse_inertia, lever;  // lever: cross matrix of the way from the centre of mass to the joint
  Vec3 v, w;                    // without the joint
  Vec3 v_end_W, w_end_W;
  Pose X_WCm;  // at the end of the step

  void take(ContactProblem& problem, std::int32_t i, const Mat3& R_JW, const Vec3& p_WJ, double h);
  void addTo(Matrix6& compliance) const;
  Row6 velocity() const;
  /// All but its turn.
  void move(const Mat3& R_JW, const Row6& impulse, double h);
  void turnAlone(double h) { magnusRotation(X_WCm.q, w_end_W, body->inertia_B, body->inverse_inertia_B, h); }
  Turning turning() { return {X_WCm.q, w_end_W, body->inertia_B, body->inverse_inertia_B}; }
  bool turnsFast(double force, double h) const {
    if (body == nullptr) return false;
    const double reach = std::sqrt(lever.squaredNorm() / 2);
    return !(h * h * force * reach * body->inverse_inertia_B.norm() < kTurnsFast);
  }
};

void Side::take(ContactProblem& problem, std::int32_t i, const Mat3& R_JW, const Vec3& p_WJ, double h) {
  if (i == ContactProblem::kFixed) return;
  body = &problem.bodies[index(i)];
  const Mat3 R_JB = R_JW * body->q_WB.toRotationMatrix();
  inverse_inertia = R_JB * body->inverse_inertia_B * R_JB.transpose();
  lever = crossing(R_JW * (p_WJ - body->p_WCm));
  v = R_JW * (body->v_WCm + h / body->mass * body->force_W);
  w = R_JW * body->w_WB;
  if (!body->torque_W.isZero(0)) w += h * (inverse_inertia * (R_JW * body->torque_W));
}

void Side::addTo(Matrix6& compliance) const {
  if (body == nullptr) return;
  const Mat3 turned = inverse_inertia * lever;
  compliance.topLeftCorner<3, 3>().noalias() -= lever * turned;
  compliance.topLeftCorner<3, 3>().diagonal().array() += 1 / body->mass;
  compliance.bottomLeftCorner<3, 3>() += turned;
  compliance.topRightCorner<3, 3>() += turned.transpose();
  compliance.bottomRightCorner<3, 3>() += inverse_inertia;
}

// At the joint.
Row6 Side::velocity() const {
  Row6 u = Row6::Zero();
  if (body != nullptr) u << v - lever * w, w;
  return u;
}

void Side::move(const Mat3& R_JW, const Row6& impulse, double h) {
  if (body == nullptr) return;
  const Vec3 push = impulse.head<3>(), turn = impulse.tail<3>();
  v_end_W = R_JW.transpose() * (v + push / body->mass);
  w_end_W = R_JW.transpose() * (w + inverse_inertia * (lever * push + turn));
  X_WCm = {body->p_WCm + h * v_end_W, body->q_WB};
}

void turn(Side& A, Side& B, double h) {
  if (A.body != nullptr && B.body != nullptr) return magnusRotations(A.turning(), B.turning(), h);
  for (Side* side : {&A, &B}) {
    if (side->body != nullptr) side->turnAlone(h);
  }
}

// What the joint is open in its six rows.
Row6 gapIn(JointType type, const JointPose& at) {
  Row6 gap;
  if (type == JointType::kHinge) {
    const Vec3 z = rotated(at.q_J, Vec3::UnitZ());
    gap << at.p_J, -z.y(), z.x(), 0;
  } else {
    gap << at.p_J, 2 * std::copysign(1.0, at.q_J.w()) * at.q_J.vec();
  }
  return gap;
}

class Pair {
 public:
  Pair(ContactProblem& problem, double h)
      : joint_(problem.joints[0]), type_(joint_.joint->type), locked_(lockedRowsOf(type_)), h_(h) {
    const Pose X_WA = centreOf(problem, joint_.A), X_WB = centreOf(problem, joint_.B);
    R_JW_ = (X_WA.q * joint_.frames.X_AJ.q).conjugate().toRotationMatrix();
    const Vec3 p_WJ = X_WB.p + rotated(X_WB.q, joint_.frames.X_BJ.p);  // for both: their angular momentum is then kept
    A_.take(problem, joint_.A, R_JW_, p_WJ, h);
    B_.take(problem, joint_.B, R_JW_, p_WJ, h);
  }

  bool solve() {
    const double force = joint_.f_B_W.norm();
    if (A_.turnsFast(force, h_) || B_.turnsFast(force, h_)) return false;
    free_ = B_.velocity() - A_.velocity();
    factorise();
    aim();
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMaxCloses; ++i) {
      push();
      const double miss = correct();
      if (miss < kClosed) {
        giveBack();
        return true;
      }
      if (!(miss < kKeepsOn * last)) return false;
      last = miss;
    }
    return false;
  }

 private:
  // Of the locked rows; beside them, what an impulse along a free axis with laws does.
  void factorise() {
    Matrix6 compliance = Matrix6::Zero();
    A_.addTo(compliance);
    B_.addTo(compliance);
    std::array<bool, 6> is_locked{};
    for (const int i : locked_) is_locked[index(i)] = true;
    if (type_ == JointType::kHinge || type_ == JointType::kSlider) axis_ = type_ == JointType::kHinge ? 5 : 2;
    if (axis_ >= 0) {
      along_ = compliance.col(axis_);
      inertia_ = along_[axis_];
      along_[axis_] = 0;
    }
    for (int i = 0; i < 6; ++i) {
      if (is_locked[index(i)]) continue;
      compliance.row(i).setZero();
      compliance.col(i).setZero();
      compliance(i, i) = 1;
    }
    inverse_.compute(compliance);
    if (axis_ < 0 || !hasLaws(joint_.joint->axes[0])) return;
    const JointAxis& axis = joint_.joint->axes[0];
    response_ = inverse_ * along_;
    inertia_ = 1 / (inertia_ - along_.dot(response_));
    const double u = axis.stiffness > 0 ? speedAtBegin() : 0;
    laws_ = lawsOf(axis, joint_.position[0], u, inertia_ / kJointSoftness, h_);
  }

  double speedAtBegin() const {
    const int part = axis_ / 3 * 3;
    const Vec3 along_W = R_JW_.row(axis_ - part).transpose();
    double u = 0;
    for (const auto& [side, sign] : {std::pair(&B_, 1.0), std::pair(&A_, -1.0)}) {
      if (side->body == nullptr) continue;
      const ContactProblem::Body& body = *side->body;
      const Vec3 lever_W = R_JW_.transpose() * (side->lever * (R_JW_ * body.w_WB));
      u += sign * (part == 0 ? along_W.dot(body.v_WCm - lever_W) : along_W.dot(body.w_WB));
    }
    return u;
  }

  // Velocities of the locked rows at which the joint should close, as it did in the last steps.
  void aim() {
    begin_ = gapIn(type_, joint_.begin);
    if (laws_.count > 0) turning_ = joint_.lead[kAxisLead];
    for (std::size_t i = 0; i < locked_.size(); ++i) {
      const int row = locked_[i];
      const double most = h_ * (row < 3 ? kMaxClosing : kMaxTurning);
      closes_[row] = std::clamp(begin_[row], -most, most);
      goal_[row] = joint_.lead[i] - closes_[row] / h_;
    }
  }

  void push() {
    Row6 wanted = Row6::Zero();
    for (const int i : locked_) wanted[i] = goal_[i] - free_[i];
    impulse_ = inverse_ * wanted;
    if (laws_.count > 0) {
      const double u_free = free_[axis_] + turning_ + along_.dot(impulse_);
      const double along = inertia_ * (speedUnder(laws_, inertia_, u_free) - u_free);
      impulse_ -= along * response_;
      impulse_[axis_] = along;
      speed_ = u_free + along / inertia_ - turning_;
    }
    A_.move(R_JW_, -impulse_, h_);
    B_.move(R_JW_, impulse_, h_);
    turn(A_, B_, h_);
  }

  // Moves the goals by what the joint misses at the end of the step; returns the largest [m/s, rad/s].
  double correct() {
    const JointPose at = jointPoseOf(joint_.frames, B_.X_WCm, A_.X_WCm);
    const Row6 end = gapIn(type_, at);
    double largest = 0;
    if (laws_.count > 0) {
      const double turning = wayOf(joint_.begin, at) / h_ - speed_;
      largest = std::abs(std::exchange(turning_, turning) - turning);
    }
    for (const int i : locked_) {
      const double miss = (begin_[i] - closes_[i] - end[i]) / h_;
      largest = std::max(largest, std::abs(miss));
      miss_[i] = miss;
    }
    if (largest >= kClosed) goal_ += miss_;
    return largest;
  }

  // Along the axis [m, rad].
  double wayOf(const JointPose& from, const JointPose& to) const {
    if (type_ == JointType::kSlider) return to.p_J.z() - from.p_J.z();
    const Quat &a = from.q_J, &b = to.q_J;
    return 2 * std::atan((a.w() * b.z() - a.z() * b.w()) / (a.w() * b.w() + a.z() * b.z()));
  }

  void giveBack() {
    for (Side* side : {&A_, &B_}) {
      if (side->body == nullptr) continue;
      side->body->p_WCm = side->X_WCm.p;
      side->body->q_WB = side->X_WCm.q;
      side->body->v_WCm = side->v_end_W;
      side->body->w_WB = side->w_end_W;
    }
    joint_.f_B_W = R_JW_.transpose() * impulse_.head<3>() / h_;
    // with the miss that was small enough: otherwise the next guess repeats it, and they add up
    const Row6 lead = goal_ + miss_ + closes_ / h_;
    for (std::size_t i = 0; i < locked_.size(); ++i) joint_.lead[i] = lead[locked_[i]];
    if (axis_ >= 0) joint_.lead[kAxisLead] = turning_;
  }

  ContactProblem::Joint& joint_;
  const JointType type_;
  const std::span<const int> locked_;
  const double h_;
  Mat3 R_JW_;
  Side A_, B_;
  Inverse6 inverse_;
  int axis_ = -1;          // a free row that may have laws
  Row6 along_, response_;  // velocities by a unit impulse along it; impulses that keep the locked rows as they are then
  double inertia_ = 0;     // along it
  AxisLaws laws_;
  double speed_ = 0;    // along it, at the start of the step
  double turning_ = 0;  // what it is faster over the step, as the bodies turn: the laws are about the way
  Row6 free_, impulse_, begin_;
  Row6 goal_ = Row6::Zero(), closes_ = Row6::Zero(), miss_ = Row6::Zero();
};

}  // namespace

bool stepJoinedPair(ContactProblem& problem, double h) noexcept {
  return isOneJoint(problem) && Pair(problem, h).solve();
}

}  // namespace presa::ode
