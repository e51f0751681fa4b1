#pragma once
#include <array>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_constraint.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// The finger contacts of one step: contact constraints (soft coupling) or external forces (explicit coupling).
class FingerJoints {
 public:
  /// Owns the motors of soft fingertips in `ode_world`: destroy it before `ode_world`. No motors if no material has
  /// torsion.
  FingerJoints(DynamicsSettings::Coupling coupling, const Scene& scene, dWorldID ode_world);
  ~FingerJoints();
  FingerJoints(const FingerJoints&) = delete;
  FingerJoints& operator=(const FingerJoints&) = delete;

  /// Builds the rows of every finger that touches a moving body, for a step of `h` [s] starting at `time`. Forces of
  /// the explicit coupling are added to `bodies` at once. Returns the number of invalid finger contacts, which are
  /// ignored.
  std::size_t read(const ContactExchange& exchange, double time, double h, BodySet& bodies);
  /// Creates joints for the fingers on `wanted` islands.
  void addTo(Engine& engine, BodySet& bodies, Islands& islands, const std::vector<char>& wanted);
  /// Stick-to-slip transition, after the solve: fingers that reached their static friction bound within the step get
  /// their dynamic coefficient, as on the haptic side, and their islands are marked in `wanted`. False when there are
  /// none.
  bool stickToSlip(Islands& islands, std::vector<char>& wanted);
  /// After the solve: mean force of finger `f` on all its bodies over the step [N]; zero without contact.
  Vec3 force(std::size_t f) const;

 private:
  void resistTurning(std::size_t finger, std::size_t body, const FingerConstraint& row, const BodySet& bodies);

  struct Active {
    std::size_t finger = 0, body = 0;
    FingerConstraint row;
  };
  const DynamicsSettings::Coupling coupling_;
  const double old_after_;  ///< maximum age of a finger sample before it fades [s]
  std::vector<Active> active_;
  std::array<dJointFeedback, kMaxFingers * kMaxContactParts> feedback_{};  // as active_
  std::vector<double> torsional_radius_;  // torsional friction radius by body [m]; empty if no material has torsion
  std::vector<dJointID> motors_;          // by finger: torsional friction
};

/// Calls use(finger, contact, body) for each contact of a finger with a moving body: once, or once per part when
/// several bodies share the finger. Returns the number of invalid contacts.
template <class Use>
std::size_t forEachTouch(const ContactExchange& exchange, const BodySet& bodies, Use use) {
  std::size_t invalid = 0;
  const auto judge = [&](std::size_t finger, const FingerContact& contact) {
    const auto body = static_cast<std::size_t>(contact.body);
    if (contact.body < 0 || body >= bodies.size() || !isUsable(contact)) {
      ++invalid;
    } else if (bodies.moves(body)) {
      use(finger, contact, body);
    }
  };
  const auto count = static_cast<std::size_t>(std::clamp(exchange.count, 0, kMaxFingers));
  for (std::size_t f = 0; f < count; ++f) {
    const FingerContact& contact = exchange.fingers[f];
    if (contact.mode == ContactMode::kNone) continue;
    if (contact.part_count < 2) judge(f, contact);
    for (std::int32_t p = 0; p < contact.part_count && contact.part_count > 1; ++p) {
      judge(f, contactOf(contact, contact.parts[static_cast<std::size_t>(p)]));
    }
  }
  return invalid;
}

}  // namespace presa::ode
