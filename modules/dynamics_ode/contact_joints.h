#pragma once
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Friction coefficient between two bodies: geometric mean of their materials' coefficients, static below kRestSpeed,
/// dynamic above.
double pairFriction(const Material& a, const Material& b, double slip_speed);
/// Slip speed below which surfaces count as resting [m/s].
inline constexpr double kRestSpeed = 1e-3;
/// Closing speed up to which bodies do not bounce [m/s].
inline constexpr double kMinBounce = 0.01;

/// First friction direction for unit normal nhat_AB, given the slip velocity predicted without friction [m/s]. ODE
/// bounds friction in two directions separately (a box, up to 41 % too strong diagonally); aligned with the predicted
/// slip it is isotropic. Without slip any direction is right.
Vec3 frictionDirection(const Vec3& nhat_AB, const Vec3& slip);

/// The body-body contacts of one step as ODE joints, with the friction parameters of each, its force in this step and,
/// for a persisting contact, its force in the last step.
class ContactJoints {
 public:
  struct Joint {
    double cfm = 0, mu = 0;
    double rolling = 0, restitution = 0;  // ContactProblem::Contact
    Vec3 direction = Vec3::Zero();        ///< first of the two friction directions; zero: chosen by ODE
    bool slides = false;                  ///< slides so fast along `direction` that friction acts along it alone
    double limit = -1;                    ///< friction bound [N]; < 0: mu times the normal force of the same solve
    Vec3 f_B_W = Vec3::Zero();  ///< force on B [N]: before the solve that of the last step, after it the new one
    Vec3 m_B_W = Vec3::Zero();  ///< the same for the moment of rolling resistance [N m]
  };

  /// Reserves memory for `contacts`; more allocate once.
  ContactJoints(const Scene& scene, const OdeOptions& options, std::size_t contacts);

  /// Starts a step of `h` [s]. `contacts` must be sorted by pair and outlive the step.
  void begin(const std::vector<BodyContact>& contacts, const BodySet& bodies, double h);
  /// Creates joints for the contacts of the `wanted` islands.
  void addTo(Engine& engine, const BodySet& bodies, Islands& islands, const std::vector<char>& wanted, bool friction);
  /// Ends the step and keeps the forces for the next one.
  void end(const BodySet& bodies);
  /// Reads the forces of the last solve for the contacts of the `solved` islands.
  void readForces(Islands& islands, const std::vector<char>& solved);
  /// Slip velocity at contact `i` for the current velocities of the bodies [m/s].
  Vec3 slip(std::size_t i, const BodySet& bodies) const;

  std::size_t size() const noexcept { return joints_.size(); }
  Joint& operator[](std::size_t i) { return joints_[i]; }
  const Joint& operator[](std::size_t i) const { return joints_[i]; }
  const BodyContact& contact(std::size_t i) const { return (*contacts_)[i]; }

 private:
  struct Past {
    std::int32_t A, B;
    Vec3 p_CmC_W, f_B_W, m_B_W;
    bool taken = false;
  };
  void recall(const BodySet& bodies);
  dContact make(const BodyContact& contact, const Joint& joint, bool friction) const;

  struct Pair {
    double at_rest, sliding, rolling, restitution;
  };
  const Pair& pairOf(const BodyContact& contact) const;
  double frictionOf(const Pair& pair, std::size_t i, const BodySet& bodies) const;

  const Scene& scene_;
  const OdeOptions options_;
  std::vector<Pair> coefficients_;  // by pair of materials
  const std::vector<BodyContact>* contacts_ = nullptr;
  double h_ = 0;
  std::vector<Joint> joints_;  // as contacts
  std::vector<dJointFeedback> feedback_;
  std::vector<Past> past_, next_;  // sorted by pair
};

}  // namespace presa::ode
