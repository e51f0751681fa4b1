#pragma once
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"
#include "modules/dynamics_ode/finger_joints.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/joints/joint_set.h"

namespace presa::ode {

/// Counts energy that appears from nothing: by island and step, what the kinetic energy and the energy in gravity of its
/// bodies gain beyond the work of fingers and external forces. Contacts and friction can only take energy, so every
/// gain is an error of the method, or the push that separates an overlap. Islands on which motors or body effects act
/// are not counted: their work is not known. Nor are those with joints: their velocities belong to half steps, so that
/// the energy at the end of a step goes up and down by h omega / 2 while the motion itself keeps it.
class EnergyBook {
 public:
  EnergyBook(const Vec3& gravity_W, std::size_t bodies) : gravity_W_(gravity_W), gain_(bodies), unknown_(bodies) {}

  /// After a step that began with BodySet::beginStep.
  void settle(const BodySet& bodies, Islands& islands, const FingerJoints& fingers,
              const std::vector<ContactProblem::Motor>* motors, const JointSet* links);
  double created() const noexcept { return created_; }       ///< since the start [J]
  double worstStep() const noexcept { return worst_step_; }  ///< the most in one step, over all islands [J]

 private:
  Vec3 gravity_W_;
  std::vector<double> gain_;   // by island [J]
  std::vector<char> unknown_;  // by island
  double created_ = 0, worst_step_ = 0;
};

}  // namespace presa::ode
