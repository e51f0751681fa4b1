#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "modules/dynamics_ode/contact_solver/axis_laws.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"

namespace presa::ode {

/// A law on the velocity of two bodies, u = J_A v_A + J_B v_B, of a joint or a motor.
struct AxisRow : AxisLaw {
  using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< linear of the centre of mass, angular

  std::int32_t A = ContactProblem::kFixed, B = ContactProblem::kFixed;
  Vec6 J_A = Vec6::Zero(), J_B = Vec6::Zero();
};

}  // namespace presa::ode
