// Rows of joints. A locked direction is stiff; its error is measured in the axes of A, so that it stays the same however
// the pair moves. The point of application is the joint in B for both bodies: their angular momentum is then kept even
// where the joint is open or has slid. A spring without damping keeps its energy: the trapezoidal rule in the form that
// belongs to velocities at half steps, (m + h^2 K / 4) (v+ - v) = -h K q.
#include "modules/dynamics_ode/contact_solver/joint_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/geometry/index.h"

namespace presa::ode {
namespace {

using Problem = ContactProblem;
using Vec6 = AxisRow::Vec6;

constexpr double kParallel = 1e-6;  // sine of the angle between axes

// A locked rotation: e = error.dot(direction), about `direction`, in the axes of J in A.
struct Turns {
  std::size_t count = 0;
  std::array<Vec3, 3> about;
  std::array<double, 3> error{};
  void add(const Vec3& direction, double e) {
    about[count] = direction;
    error[count++] = e;
  }
};

// A direction that both bodies share: it may not tilt in B against A. `first`: a direction square to it.
void alignAxis(const Vec3& axis_J, const Vec3& first, const Quat& q_J, Turns& turns) {
  const Vec3 tilt = axis_J.cross(q_J * axis_J);
  turns.add(first, tilt.dot(first));
  turns.add(axis_J.cross(first), tilt.dot(axis_J.cross(first)));
}

Turns lockedTurns(const Joint& joint, const Quat& q_J) {
  Turns turns;
  switch (joint.type) {
    case JointType::kFixed:
    case JointType::kSlider: {
      const Vec3 turn = 2 * std::copysign(1.0, q_J.w()) * q_J.vec();
      for (int i = 0; i < 3; ++i) turns.add(Vec3::Unit(i), turn[i]);
      break;
    }
    case JointType::kHinge:
      alignAxis(Vec3::UnitZ(), Vec3::UnitX(), q_J, turns);
      break;
    case JointType::kPrismaticRotary:
      alignAxis(secondAxis(joint), secondAxis(joint).unitOrthogonal(), q_J, turns);
      break;
    case JointType::kUniversal: {
      const Vec3 x = q_J * Vec3::UnitX(), about = x.cross(Vec3::UnitZ());
      const double sine = about.norm();  // torn apart, the axes may be parallel
      turns.add(sine < kParallel ? x.unitOrthogonal() : Vec3(about / sine), std::atan2(x.z(), sine));
      break;
    }
    case JointType::kBall:
      break;
  }
  return turns;
}

// Axes of J along which the joint does not slide.
int lockedMoves(JointType type) { return type == JointType::kSlider || type == JointType::kPrismaticRotary ? 2 : 3; }

JointGap gapOf(const Joint& joint, const JointPose& at, const Turns& turns) {
  JointGap gap;
  for (int i = 0; i < lockedMoves(joint.type); ++i) gap.of[gap.count++] = at.p_J[i];
  for (std::size_t i = 0; i < turns.count; ++i) {
    gap.turns[gap.count] = true;
    gap.of[gap.count++] = turns.error[i];
  }
  return gap;
}

class RowMaker {
 public:
  RowMaker(const Problem& problem, const Problem::Joint& joint, const Pose& X_WA, const Pose& X_WB, double h,
           std::vector<AxisRow>& rows)
      : problem_(problem),
        joint_(joint),
        h_(h),
        rows_(rows),
        X_WA_(X_WA),
        X_WB_(X_WB),
        at_(presa::poseOf(joint.frames, X_WB_, X_WA_)),
        R_WJ_((X_WA_.q * joint.frames.X_AJ.q).toRotationMatrix()),
        p_WJ_(X_WB_ * joint.frames.X_BJ.p) {}

  JointGap make() {
    const Joint& of = *joint_.joint;
    const Turns turns = lockedTurns(of, at_.q_J);
    const JointGap gap = gapOf(of, at_, turns);
    const std::size_t moves = index(lockedMoves(of.type));
    for (std::size_t i = 0; i < gap.count; ++i) {
      rows_.push_back(i < moves ? push(R_WJ_.col(static_cast<int>(i))) : turn(R_WJ_ * turns.about[i - moves]));
      rows_.back().goal = -closable(gap, i, h_) / h_;
    }
    if (of.type == JointType::kBall) {
      if (!of.axes.empty()) brakeBall(of.axes[0]);
    } else {
      for (std::size_t i = 0; i < of.axes.size(); ++i) makeAxis(of.axes[i], i);
    }
    return gap;
  }

 private:
  AxisRow push(const Vec3& along_W) const {
    AxisRow row;
    row.A = joint_.A;
    row.B = joint_.B;
    row.J_B << along_W, (p_WJ_ - X_WB_.p).cross(along_W);
    row.J_A << -along_W, -(p_WJ_ - X_WA_.p).cross(along_W);
    row.k = stiffnessOf(row);
    return row;
  }
  AxisRow turn(const Vec3& about_W) const {
    AxisRow row;
    row.A = joint_.A;
    row.B = joint_.B;
    row.J_B << Vec3::Zero(), about_W;
    row.J_A << Vec3::Zero(), -about_W;
    row.k = stiffnessOf(row);
    return row;
  }
  double stiffnessOf(const AxisRow& row) const {
    return 1 / (kJointSoftness * (compliance(row.A, row.J_A) + compliance(row.B, row.J_B)));
  }
  double compliance(std::int32_t body, const Vec6& J) const {
    if (body == Problem::kFixed) return 0;
    const Problem::Body& of = problem_.bodies[index(body)];
    const Vec3 turn_B = of.q_WB.conjugate() * Vec3(J.tail<3>());
    return J.head<3>().squaredNorm() / of.mass + turn_B.dot(of.inverse_inertia_B * turn_B);
  }
  double speedOf(const AxisRow& row) const {
    double u = 0;
    for (const auto& [body, J] : {std::pair(row.A, &row.J_A), std::pair(row.B, &row.J_B)}) {
      if (body == Problem::kFixed) continue;
      const Problem::Body& of = problem_.bodies[index(body)];
      u += J->head<3>().dot(of.v_WCm) + J->tail<3>().dot(of.w_WB);
    }
    return u;
  }

  AxisRow along(std::size_t i) const {
    const Joint& of = *joint_.joint;
    if (!of.axes[i].turns) return push(R_WJ_.col(2));
    if (i == 0) return turn(R_WJ_.col(2));
    return turn(R_WJ_ * (at_.q_J * (of.type == JointType::kUniversal ? Vec3(Vec3::UnitX()) : secondAxis(of))));
  }

  void makeAxis(const JointAxis& axis, std::size_t i) {
    AxisRow row = along(i);
    const double u = axis.stiffness > 0 ? speedOf(row) : 0;
    const AxisLaws laws = lawsOf(axis, joint_.position[i], u, row.k, h_);
    for (const AxisLaw& law : laws.all()) {
      static_cast<AxisLaw&>(row) = law;
      rows_.push_back(row);
    }
  }

  // Friction acts along the rotation, where there is one: its bound is then the same in all directions.
  void brakeBall(const JointAxis& axis) {
    const auto spin = [&](std::int32_t body) {
      return body == Problem::kFixed ? Vec3(Vec3::Zero()) : problem_.bodies[index(body)].w_WB;
    };
    const Vec3 w = spin(joint_.B) - spin(joint_.A);
    const Vec3 first = w.norm() > 1e-6 ? Vec3(w.normalized()) : Vec3(Vec3::UnitZ());
    const Vec3 second = first.unitOrthogonal();
    for (const Vec3& about : {first, second, Vec3(first.cross(second))}) {
      if (axis.friction > 0) {
        AxisRow& row = rows_.emplace_back(turn(about));
        row.low = -h_ * axis.friction;
        row.high = h_ * axis.friction;
      }
      if (axis.damping > 0) rows_.emplace_back(turn(about)).k = h_ * axis.damping;
    }
  }

  const Problem& problem_;
  const Problem::Joint& joint_;
  const double h_;
  std::vector<AxisRow>& rows_;
  const Pose X_WA_, X_WB_;
  const JointPose at_;
  const Mat3 R_WJ_;
  const Vec3 p_WJ_;
};

}  // namespace

JointGap gapOf(const Problem::Joint& joint, const Pose& X_WA, const Pose& X_WB) {
  const JointPose at = presa::poseOf(joint.frames, X_WB, X_WA);
  return gapOf(*joint.joint, at, lockedTurns(*joint.joint, at.q_J));
}

Pose centreOf(const Problem& problem, std::int32_t i) {
  if (i == Problem::kFixed) return {};
  return {problem.bodies[index(i)].p_WCm, problem.bodies[index(i)].q_WB};
}

double closable(const JointGap& gap, std::size_t i, double h) {
  const double most = h * (gap.turns[i] ? kMaxTurning : kMaxClosing);
  return std::clamp(gap.of[i], -most, most);
}

void followPosition(const ContactProblem& problem, ContactProblem::Joint& joint) {
  const JointPose at = presa::poseOf(joint.frames, centreOf(problem, joint.B), centreOf(problem, joint.A));
  const std::vector<JointAxis>& axes = joint.joint->axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    double& position = joint.position[i];
    const double now = positionOf(*joint.joint, i, at);
    position = axes[i].turns ? position + std::remainder(now - position, 2 * std::numbers::pi) : now;
  }
}

void addLoad(const AxisRow& row, double force, ContactProblem::Joint& joint) {
  const bool on_B = row.B != ContactProblem::kFixed;
  const Vec6& J = on_B ? row.J_B : row.J_A;
  if (!on_B) force = -force;
  const Vec3 along = J.head<3>(), about = J.tail<3>();
  (along.isZero() ? joint.m_B_W : joint.f_B_W) += force * (along.isZero() ? about : along);
}

JointGap appendRows(const Problem& problem, const Problem::Joint& joint, const Pose& X_WA, const Pose& X_WB, double h,
                    std::vector<AxisRow>& rows) {
  return RowMaker(problem, joint, X_WA, X_WB, h, rows).make();
}

}  // namespace presa::ode
