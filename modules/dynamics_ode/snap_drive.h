#pragma once
#include <ode/ode.h>

#include <optional>
#include <vector>

#include "framework/assembly/snap_constraint.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"
#include "modules/dynamics_ode/sleep.h"

namespace presa::ode {

/// Applies the snap constraints of an assembly (framework/assembly/snap_constraint.h). A pulled body gets a velocity
/// motor of ODE with bounded force, solved together with contacts and friction; a fixed body is carried to its target
/// as an obstacle.
class SnapDrive {
 public:
  /// Owns motors in `ode_world`: destroy it before `ode_world`.
  SnapDrive(const BodySet& bodies, dWorldID ode_world);
  ~SnapDrive();
  SnapDrive(const SnapDrive&) = delete;
  SnapDrive& operator=(const SnapDrive&) = delete;

  /// At the start of a period: takes the current constraints, fixes and frees bodies, and wakes the affected ones.
  void read(const SnapConstraints& snap_constraints, BodySet& bodies, Sleep* sleep);
  /// Moves fixed bodies a limited step towards their targets, because a jump could be felt and would kick neighbours.
  /// Wakes bodies in the way; `sleep` is null when sleeping is off.
  void carry(BodySet& bodies, Sleep* sleep, double h) const;
  /// Sets the motors for the next sub-step of `h` [s].
  void drive(const BodySet& bodies, double h);

  /// The motors of this sub-step; bodies by their indices in the scene.
  const std::vector<ContactProblem::Motor>& motors() const noexcept { return driven_; }

  static constexpr double kCarrySpeed = 0.01;  ///< minimum speed of a carried body [m/s]
  static constexpr double kCarrySpin = 0.2;    ///< angular speed of a carried body [rad/s]

 private:
  bool hasChanged(std::size_t i);
  static void wakeAround(std::size_t i, BodySet& bodies, Sleep& sleep);

  struct Motors {
    dJointID linear = nullptr, angular = nullptr;  ///< null for a fixed body
  };
  SnapConstraints constraints_;
  std::vector<const SnapConstraint*> constraint_of_;   // by body, into constraints_; null: free
  std::vector<std::optional<SnapConstraint>> before_;  // by body: the constraint for which it was last woken
  std::vector<Motors> motors_;                         // by body
  std::vector<ContactProblem::Motor> driven_;          // the same for Presa's own solvers
};

}  // namespace presa::ode
