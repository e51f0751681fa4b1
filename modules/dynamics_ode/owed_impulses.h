#pragma once
#include <cstddef>

#include "framework/core/exchange/bounded_list.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/finger_joints.h"

namespace presa::ode {

/// What the fingers felt and the bodies have not got: in a step that an implicit solve predicts, a body gets the force
/// that its finger should feel at the end of the step; what the finger then feels is known a step later. The difference
/// is given in that step, as forces at the proxies, so that the sums of impulse agree whatever changes the force: a
/// hand that stops, a surface effect, the end of a contact; and those of angular impulse about the centre of mass, but
/// for the angle by which the body turns in a step. Torques about a contact's normal are left to the solve alone. For
/// steps that begin at the sample of the exchange and take as long as it is held.
class OwedImpulses {
 public:
  struct Owed {
    std::int32_t finger = 0, body = kNoBody;
    bool moves = false;    // in this step; else it will be moved from the next one on, or elsewhere
    bool is_new = true;    // no contact of this finger in the exchange before
    bool touches = false;  // in this step's exchange
    // Where the finger's force acts, in coordinates of the body [m]. A prediction is taken back where it was given on the
    // body, not in space: there it would turn a body that is carried at v by the torque h v x f.
    Vec3 p_BP = Vec3::Zero(), p_BP_before = Vec3::Zero();
    Vec3 felt_W = Vec3::Zero();        // by the finger, on the body, to be given in this step [N s]
    Vec3 taken_back_W = Vec3::Zero();  // what the step before predicted, the other way [N s]
    Vec3 predicted_W = Vec3::Zero();   // in this step [N s]
    Vec3 owed() const { return felt_W + taken_back_W; }
  };

  /// Allocates for the contacts of this exchange. Not called: the first step allocates.
  void makeRoom(const ContactExchange& exchange);
  /// Before a step of `period` [s].
  void read(const ContactExchange& exchange, double period, const BodySet& bodies);
  /// In each sub-step, after BodySet::resetForces: the mean force over the period.
  void push(BodySet& bodies);
  /// After the solve of a sub-step of `h` [s].
  void notePredicted(const FingerJoints& fingers, double h);
  const BoundedList<Owed>& all() const noexcept { return all_; }
  /// Takes from the impulses of the last step what it gave in advance, as a prediction of what is not felt yet.
  void leaveOutPredicted(BoundedList<FingerImpulse>& given) const noexcept;

 private:
  void read(std::size_t finger, const ToolContact& contact, const BodySet& bodies);
  Owed* find(std::size_t finger, std::size_t body) noexcept;

  double period_ = 0;  // [s]
  BoundedList<Owed> all_;
};

}  // namespace presa::ode
