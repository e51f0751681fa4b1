#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_constraint.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// The finger contacts of one step: contact constraints (soft coupling) or external forces (explicit coupling: the
/// force of the newest sample; averaged: the mean of what was felt since the last step, so that bodies get the impulse
/// that fingers felt, a step late. Of a finger between two bodies each gets the force of the newest sample).
class FingerJoints {
 public:
  /// Owns the motors of soft fingertips in `ode_world`: destroy it before `ode_world`. No motors if no material has
  /// torsion.
  FingerJoints(DynamicsSettings::Coupling coupling, const Scene& scene, dWorldID ode_world);
  ~FingerJoints();
  FingerJoints(const FingerJoints&) = delete;
  FingerJoints& operator=(const FingerJoints&) = delete;

  /// Makes room for as many contacts as the exchange has room for.
  void makeRoom(const ContactExchange& exchange);
  /// Builds the rows of every finger that touches a moving body, for a step of `h` [s] starting at `time`. External
  /// forces are added to `bodies` at once. Returns the number of invalid finger contacts, which are
  /// ignored.
  std::size_t read(const ContactExchange& exchange, double time, double h, BodySet& bodies);
  /// Creates joints for the fingers on `wanted` islands.
  void addTo(Engine& engine, BodySet& bodies, Islands& islands, const std::vector<char>& wanted);
  /// Stick-to-slip transition, after the solve: fingers that reached their static friction bound within the step get
  /// their dynamic coefficient, as on the haptic side, and their islands are marked in `wanted`. False when there are
  /// none.
  bool stickToSlip(Islands& islands, std::vector<char>& wanted);
  /// The torsional friction of this step, as motors of ContactProblem; bodies by their indices in the scene.
  const std::vector<ContactProblem::Motor>& motors() const noexcept { return torsion_; }
  /// Whether the fingers are external forces of the step and no constraints.
  bool areForces() const noexcept { return coupling_ != DynamicsSettings::Coupling::kSoft; }
  std::size_t count() const noexcept { return active_.size(); }
  /// Finger and moving body of contact i, 0 <= i < count().
  std::size_t finger(std::size_t i) const noexcept { return active_[i].finger; }
  std::size_t body(std::size_t i) const noexcept { return active_[i].body; }
  const FingerConstraint& row(std::size_t i) const noexcept { return active_[i].row; }
  /// Sets the mean force of contact i, solved elsewhere [N].
  void setForce(std::size_t i, const Vec3& f_W);
  /// After the solve: mean force of contact i on its body over the step [N].
  Vec3 force(std::size_t i) const;

 private:
  void add(std::size_t finger, std::size_t body, const FingerContact& contact, FingerConstraint row,
           const ContactExchange& exchange, double time, double h, BodySet& bodies);
  void estimateMotion(const ContactExchange& exchange);
  void resistTurning(std::size_t finger, std::size_t body, const FingerConstraint& row, const BodySet& bodies);
  void twist(std::size_t finger, std::size_t body, const FingerContact& contact, double age, double h, BodySet& bodies);

  /// The newest sample of a finger, and the acceleration since the one before.
  struct Motion {
    double time = -1;  // -1: no sample yet [s]
    Vec3 v_WH = Vec3::Zero(), a_WH = Vec3::Zero();
  };
  struct Active {
    std::size_t finger = 0, body = 0;
    FingerConstraint row;
  };
  const DynamicsSettings::Coupling coupling_;
  const double old_after_;       ///< maximum age of a finger sample before it fades [s]
  std::vector<Motion> motions_;  // by finger
  std::vector<Vec3> given_;      // by finger: impulse that it had felt at the last step [N s]
  std::vector<Active> active_;
  std::vector<dJointFeedback> feedback_;  // as active_, with room for all contacts of the exchange
  std::vector<double> torsional_radius_;  // torsional friction radius by body [m]; empty if no material has torsion
  std::vector<dJointID> motors_;          // by finger: torsional friction
  std::vector<ContactProblem::Motor> torsion_;  // the same for Presa's own solvers
};

/// Calls use(finger, contact, body) for each contact of a finger with a moving body on which fingers act. Returns the
/// number of invalid contacts.
template <class Use>
std::size_t forEachTouch(const ContactExchange& exchange, const BodySet& bodies, Use use) {
  std::size_t invalid = 0;
  const auto judge = [&](std::size_t finger, const FingerContact& contact) {
    const auto body = static_cast<std::size_t>(contact.body);
    if (contact.body < 0 || body >= bodies.size() || !isUsable(contact)) {
      ++invalid;
    } else if (bodies.moves(body) && bodies.isReached(body)) {
      use(finger, contact, body);
    }
  };
  for (std::size_t f = 0; f < exchange.fingers.size(); ++f) {
    const FingerContact& contact = exchange.fingers[f];
    if (contact.mode == ContactMode::kNone) continue;
    if (contact.contact_count < 2 && !contact.has_volume) {
      judge(f, contact);
    } else {
      for (const ToolContact& part : exchange.contactsOf(contact)) judge(f, contactOf(contact, part));
    }
  }
  return invalid;
}

}  // namespace presa::ode
