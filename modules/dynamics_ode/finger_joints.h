#pragma once
#include <array>
#include <vector>

#include "framework/core/state/contact_exchange.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/finger_row.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// The fingers of one step: as contact joints (soft coupling) or as forces (explicit coupling).
class FingerJoints {
 public:
  /// The motors of soft fingertips live in `ode_world` and go before it; there are none where no material has torsion.
  FingerJoints(DynamicsSettings::Coupling coupling, const Scene& scene, dWorldID ode_world);
  ~FingerJoints();
  FingerJoints(const FingerJoints&) = delete;
  FingerJoints& operator=(const FingerJoints&) = delete;

  /// Takes the rows of every finger that touches a moving body, for a step of `h` from `time` on; forces of the explicit
  /// coupling go to `bodies` at once. Returns how many fingers made no sense and were left out.
  std::size_t read(const ContactExchange& exchange, double time, double h, BodySet& bodies);
  /// Joints for the fingers on `wanted` islands.
  void addTo(Engine& engine, BodySet& bodies, Islands& islands, const std::vector<char>& wanted);
  /// After the solve: fingers whose friction came to its static bound within the step slip at its end, as the haptic side will
  /// render. Gives them their dynamic coefficient and marks their islands in `wanted`; false when there is none.
  bool letGo(Islands& islands, std::vector<char>& wanted);
  /// After the solve: the mean force of finger `f` on its bodies, all together [N]; zero without contact.
  Vec3 force(std::size_t f) const;

 private:
  void resistTurning(std::size_t finger, std::size_t body, const FingerRow& row, const BodySet& bodies);

  struct Active {
    std::size_t finger = 0, body = 0;
    FingerRow row;
  };
  const DynamicsSettings::Coupling coupling_;
  const double old_after_;  ///< of a finger [s]
  std::vector<Active> active_;
  std::array<dJointFeedback, kMaxFingers * kMaxContactParts> feedback_{};  // as active_
  std::vector<double> torsion_;   // by body [m]; empty where no fingertip is soft
  std::vector<dJointID> motors_;  // by finger: hold it from turning about its normal, with a bounded torque
};

/// Calls use(finger, contact, body) for each touch of a moving body: one for a finger on one body, and one for each part of a
/// finger that several bodies hold. Returns how many made no sense.
template <class Use>
std::size_t forEachTouch(const ContactExchange& exchange, const BodySet& bodies, Use use) {
  std::size_t nonsense = 0;
  const auto judge = [&](std::size_t finger, const FingerContact& contact) {
    const auto body = static_cast<std::size_t>(contact.body);
    if (contact.body < 0 || body >= bodies.size() || !isUsable(contact)) {
      ++nonsense;
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
  return nonsense;
}

}  // namespace presa::ode
