#pragma once
#include <vector>

#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/engine.h"
#include "modules/dynamics_ode/friction.h"
#include "modules/dynamics_ode/islands.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// The contacts between bodies of one step as ODE's joints. Knows how friction acts at each, what it did in this step and, where
/// the contact was there already, in the last.
class ContactJoints {
 public:
  struct Joint {
    double cfm = 0, mu = 0;
    Vec3 direction = Vec3::Zero();  ///< first of the two that ODE bounds separately; zero: ODE's choice
    bool slides = false;            ///< along `direction`, and so fast that friction acts along it alone
    double limit = -1;              ///< of friction [N]; < 0: mu times the normal force of the same solve
    Vec3 f_B_W = Vec3::Zero();      ///< on B [N]: before the solve that of the last step, after it the new one
  };

  /// With room for `contacts`; more take memory once.
  ContactJoints(const Scene& scene, const OdeOptions& options, std::size_t contacts);

  /// Starts a step of `h` with these contacts (sorted by pair), which stay the caller's.
  void begin(const std::vector<BodyContact>& contacts, const BodySet& bodies, double h);
  /// Joints for the contacts of `wanted` islands.
  void addTo(Engine& engine, const BodySet& bodies, Islands& islands, const std::vector<char>& wanted, bool friction);
  /// Ends the step: what was found is what the next one remembers.
  void end(const BodySet& bodies);
  /// Takes the forces from the solve just made, for the contacts of `solved` islands.
  void readForces(Islands& islands, const std::vector<char>& solved);
  /// Slip at contact `i` with the velocities that the bodies have now.
  Vec3 slip(std::size_t i, const BodySet& bodies) const;

  std::size_t size() const noexcept { return joints_.size(); }
  Joint& operator[](std::size_t i) { return joints_[i]; }
  const BodyContact& contact(std::size_t i) const { return (*contacts_)[i]; }

 private:
  struct Past {
    std::int32_t A, B;
    Vec3 p_CmC_W, f_B_W;
  };
  void recall(const BodySet& bodies);
  dContact make(const BodyContact& contact, const Joint& joint, bool friction) const;

  double coefficient(std::size_t i, const BodySet& bodies) const;

  const Scene& scene_;
  const OdeOptions options_;
  struct Coefficients {
    double at_rest, sliding;
  };
  std::vector<Coefficients> coefficients_;  // by pair of materials
  const std::vector<BodyContact>* contacts_ = nullptr;
  double h_ = 0;
  std::vector<Joint> joints_;  // as contacts
  std::vector<dJointFeedback> feedback_;
  std::vector<Past> past_;  // sorted by pair
};

}  // namespace presa::ode
