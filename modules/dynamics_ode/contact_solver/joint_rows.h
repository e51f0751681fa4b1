#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "modules/dynamics_ode/contact_solver/axis_row.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"

/// Joints as rows of a contact solver. The rows of the directions that a joint locks come first; those of its axes
/// follow: stops, friction, motor, spring.
namespace presa::ode {

/// Relative compliance of a stiff row, as NewtonSolver::Options::softness.
inline constexpr double kJointSoftness = 1e-8;
/// Max speeds at which a joint that was pulled apart is closed [m/s], [rad/s].
inline constexpr double kMaxClosing = 1, kMaxTurning = 10;
/// Rows of one joint, at most.
inline constexpr std::size_t kMaxJointRows = 16;
/// Locked directions of one joint, at most.
inline constexpr std::size_t kMaxLocked = 6;

/// How far a joint is open in its locked directions [m, rad], as its rows.
struct JointGap {
  std::size_t count = 0;
  std::array<double, kMaxLocked> of{};
  std::array<bool, kMaxLocked> turns{};
};
/// With A and B at these poses of their centres of mass; a fixed one has the pose of W.
JointGap gapOf(const ContactProblem::Joint& joint, const Pose& X_WA, const Pose& X_WB);

/// Pose of the centre of mass of body `i` of the problem, or of W.
Pose centreOf(const ContactProblem& problem, std::int32_t i);

/// Appends the rows of `joint` for a step of `h` [s], with A and B at these poses of their centres of mass. The goals of
/// locked directions close the gap there, at most at kMaxClosing and kMaxTurning. Returns that gap.
JointGap appendRows(const ContactProblem& problem, const ContactProblem::Joint& joint, const Pose& X_WA,
                    const Pose& X_WB, double h, std::vector<AxisRow>& rows);

/// Takes the positions of the joint's axes from where its bodies are; angles go on from what they were.
void followPosition(const ContactProblem& problem, ContactProblem::Joint& joint);
/// Adds a row's force [N, N m] to what the joint gives its body B.
void addLoad(const AxisRow& row, double force, ContactProblem::Joint& joint);

/// The part of a gap that a step of `h` [s] may close.
double closable(const JointGap& gap, std::size_t i, double h);

}  // namespace presa::ode
