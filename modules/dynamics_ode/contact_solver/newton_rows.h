#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/dynamics_ode/contact_solver/axis_row.h"
#include "modules/dynamics_ode/contact_solver/block_cholesky.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"

/// The terms of NewtonSolver's minimisation: what each gives as impulse, potential and stiffness at given velocities.
/// A velocity of a body is a vector of six: of its centre of mass [m/s], angular [rad/s].
namespace presa::ode::newton {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Vector = BlockCholesky::Vector;

/// A spring of stiffness k that gives at most `limit`, as a potential of its unbounded impulse [N s].
double huber(double spring, double limit, double k);

/// A contact or a finger.
struct Row {
  std::int32_t A, B;
  Vec3 rA, rB;                                         // from the centres of mass [m]
  Mat3 R;                                              // rows: normal into B, two tangents
  Vec3 goal = Vec3::Zero();                            // velocity in R at which the springs are relaxed [m/s]
  double k_n = 0, k_t = 0;                             // impulse per velocity [kg]
  double mu = 0, mu_slip = 0;                          // from rest, and once it slips
  double normal = 0;                                   // normal impulse on which the cone stands [N s]
  Vec3 impulse = Vec3::Zero();                         // in R, on B
  bool is_new = false, closes = false, sticks = true;  // expected, see NewtonSolver::guess()

  /// Starts from the impulse of the last step.
  void startFrom(const Vec3& impulse_W);
  /// Of B against A at the contact, in R.
  Vec3 velocityIn(const Vector& v) const;
  Vec3 springAt(const Vec3& u) const;
  Vec3 impulseAt(const Vec3& u) const;
  /// Adds the potential of the springs.
  void addPotential(const Vec3& u, double& value) const;
};

/// Impulse on B in R, and minus its derivative by the velocity.
using Response = std::pair<Vec3, Mat3>;
Response responseOf(const Row& row, const Vec3& u);
/// What the contact does if its state is the expected one: linear.
Response expectedOf(const Row& row, const Vec3& u);

/// Rolling resistance at a contact: a stiff rotational damper whose moment is at most a length times the normal force.
struct Roll {
  std::int32_t A, B;
  std::size_t row;                // the contact
  Eigen::Matrix<double, 2, 3> T;  // two tangents
  double k = 0;                   // angular impulse per angular velocity [kg m^2]
  double length = 0;              // [m]

  Eigen::Vector2d velocityIn(const Vector& v) const;
  Eigen::Vector2d impulseAt(const Eigen::Vector2d& w, double limit) const;  ///< angular, on B [N m s]
  /// Minus the derivative of impulseAt by w.
  Eigen::Matrix2d stiffnessAt(const Eigen::Vector2d& w, double limit) const;
};

/// Velocity that an axis sees.
double velocityIn(const AxisRow& row, const Vector& v);

}  // namespace presa::ode::newton
