#pragma once
#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/virtual_coupling.h"

namespace presa {

/// A point of contact of a light tool in a step. Vectors along the world's axes.
struct PressedPoint {
  Vec3 p = Vec3::Zero();      ///< from the tool's origin [m]
  Vec3 nhat = Vec3::UnitZ();  ///< unit, body into tool
  double gap = 0;             ///< along nhat before the step; negative: overlap [m]
  std::uint32_t pair = 0;  ///< friction holds all points of a pair together: of parts (ConvexPairs::indexOf), or a body
  std::uint32_t solid = 0;       ///< its body, by solid
  double force = 0;              ///< along nhat, the problem's solution [N]
  Vec3 friction = Vec3::Zero();  ///< on the tool, square to nhat [N]
  double hold = 0;               ///< stiffness of the spring that stands for friction in the problem; 0: none [N/m]
  double stretch = 0;            ///< way along the surface since the pose that friction holds, after the step [m]
};

inline constexpr std::size_t kMaxPressed = 256;  ///< points of a problem

/// Adds a point; in a full list it takes the place of the highest one, if it is deeper.
void addDeepest(const PressedPoint& point, BoundedList<PressedPoint>& points) noexcept;

/// The step u of a tool, motion and turn, that its springs and inertia want, and the bodies allow:
///   Q u = r + sum of f_i J_i,   0 <= f_i,   0 <= J_i u + gap_i + f_i / k,   one of the two zero,
/// with J_i = (nhat_i, p_i x nhat_i): a linear complementarity problem with a positive definite matrix, which has one
/// solution.
struct ContactProblem {
  Mat6 Q = Mat6::Identity();  ///< resistance to the step, positive definite
  Vec6 r = Vec6::Zero();      ///< force and torque on the tool before it
  double k = 0;               ///< stiffness of a contact [N/m], > 0
  /// Inverse of Q, if it is at hand: few contacts are then solved in their own number of unknowns. Null: it is not.
  const Mat6* inverse = nullptr;
};

/// How a problem was solved.
struct Pivots {
  int count = 0;      ///< sets of contacts that were tried
  bool exact = true;  ///< false: none fitted within the bound; the step is the best one found, its forces fit it
};

/// Writes the forces of the contacts, and returns the step in `u`, which holds a first guess: the nearer it is, the fewer
/// sets are tried. Principal pivoting with a line search, a bounded number of times. Thread: any; nonblocking.
Pivots solveContacts(const ContactProblem& problem, BoundedList<PressedPoint>& contacts, Vec6& u) noexcept;

}  // namespace presa
