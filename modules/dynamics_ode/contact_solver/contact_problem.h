#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/scene/joints/joint.h"
#include "modules/dynamics_ode/contact_solver/rim.h"
#include "modules/dynamics_ode/finger_constraint.h"

namespace presa::ode {

/// One island for one step, as Presa's own solvers see it: bodies that move, their contacts, fingers and motors. The
/// solvers replace the state of the bodies by that at the end of the step, and the forces by those of the step.
struct ContactProblem {
  /// Index of something that does not move.
  static constexpr std::int32_t kFixed = -1;

  struct Body {
    Vec3 p_WCm = Vec3::Zero(), v_WCm = Vec3::Zero(), w_WB = Vec3::Zero();  ///< in: before the step; out: after it
    Quat q_WB = Quat::Identity();
    double mass = 0;
    Mat3 inertia_B = Mat3::Identity(), inverse_inertia_B = Mat3::Identity();  ///< about Cm
    Vec3 force_W = Vec3::Zero(), torque_W = Vec3::Zero();                     ///< external, at Cm, with gravity
  };
  struct Contact {
    std::int32_t A = kFixed, B = 0;  ///< indices of bodies
    Vec3 p_W = Vec3::Zero(), nhat_AB_W = Vec3::UnitZ();
    double gap = 0;  ///< negative: overlap [m]
    double mu = 0;
    double rolling = 0;         ///< moment of rolling resistance over normal force [m]
    double restitution = 0;     ///< [-]
    Vec3 f_B_W = Vec3::Zero();  ///< in: force in the last step; out: at the end of this one [N]
    Vec3 m_B_W = Vec3::Zero();  ///< the same for the moment of rolling resistance [N m]
    Rim rim_A, rim_B;           ///< of what moves

    /// Where the forces act [m]. Where a body bounces off something fixed, the touched point of its surface: friction
    /// acts there once the gap has closed. Between two bodies one point for both keeps angular momentum.
    Vec3 point() const { return restitution > 0 && A == kFixed ? Vec3(p_W + std::max(0.0, gap) / 2 * nhat_AB_W) : p_W; }
  };
  /// A finger as a spring-damper (finger_constraint.h).
  struct Finger {
    std::int32_t body = 0;
    const FingerConstraint* constraint = nullptr;
    Vec3 f_B_W = Vec3::Zero();  ///< out: mean force on the body [N]
  };
  /// Drives one degree of freedom to a velocity with a bounded force: J v + compliance * force = velocity.
  struct Motor {
    std::int32_t body = 0;
    bool turns = false;  ///< about `axis_W` through Cm; else Cm moves along it
    Vec3 axis_W = Vec3::UnitZ();
    double velocity = 0;    ///< [m/s or rad/s]
    double compliance = 0;  ///< [m/(N s) or rad/(N m s)]
    double max_force = 0;   ///< [N or N m]
  };
  /// A joint between two bodies of the problem, or of one with something that does not move.
  struct Joint {
    std::int32_t A = kFixed, B = kFixed;
    const presa::Joint* joint = nullptr;
    JointFrames frames;  ///< in the axes of A and B, from their centres of mass; fixed: in W
    JointPose begin;     ///< at the start of the step
    std::array<double, presa::Joint::kMaxAxes> position{};  ///< of its axes; angles are continued beyond half a turn
    Vec3 f_B_W = Vec3::Zero(), m_B_W = Vec3::Zero();  ///< on B at the joint [N], [N m]; in: last step; out: this one
    /// Velocities by which the locked directions were led so that the joint closes at the end of the step; in: the
    /// first guess [m/s, rad/s].
    std::array<double, 6> lead{};
  };
  std::vector<Body> bodies;
  std::vector<Contact> contacts;
  std::vector<Finger> fingers;
  std::vector<Motor> motors;
  std::vector<Joint> joints;

  void clear() {
    bodies.clear();
    contacts.clear();
    fingers.clear();
    motors.clear();
    joints.clear();
  }
};

}  // namespace presa::ode
