#pragma once
#include <array>
#include <vector>

#include "framework/scene/world.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/contact_solver/contact_problem.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// The joints of a scene between the bodies of a BodySet: their frames about the centres of mass, and their positions.
/// Thread: dynamics.
class JointSet {
 public:
  JointSet(const World& world, const BodySet& bodies);

  std::size_t size() const noexcept { return links_.size(); }
  bool empty() const noexcept { return links_.empty(); }
  /// Joins the islands of bodies that joints hold together.
  void link(const BodySet& bodies, Islands& islands) const;
  /// Reads how all joints stand, and the positions of axes with stops or springs; angles go on from those read last,
  /// beyond half a turn, too, except between two stops less than a turn apart.
  void read(const BodySet& bodies);
  /// A body that moves of joint i, an awake one if there is one; BodySet::size() if there is none.
  std::size_t movingBody(std::size_t i, const BodySet& bodies) const;
  /// Joint i of a problem in which its bodies have the indices A and B, or ContactProblem::kFixed.
  ContactProblem::Joint problemOf(std::size_t i, const BodySet& bodies, std::int32_t A, std::int32_t B) const;
  const Joint& joint(std::size_t i) const { return *links_[i].joint; }
  /// Keeps what the solver found of joint i for the next step, and how its leads go on: as a line, as a cubic where it is
  /// the only joint of its island. In a loop a part of them is undetermined, and would run away on a cubic.
  void keep(std::size_t i, const ContactProblem::Joint& solved, bool alone) {
    Link& link = links_[i];
    link.f_B_W = solved.f_B_W;
    for (std::size_t k = 0; k < solved.lead.size(); ++k) {
      const double grows = solved.lead[k] - link.lead[k], bends = grows - link.grows[k], twists = bends - link.bends[k];
      link.next_lead[k] = solved.lead[k] + grows + (alone ? bends + twists : 0);
      link.lead[k] = solved.lead[k];
      link.grows[k] = grows;
      link.bends[k] = bends;
    }
  }

 private:
  struct Link {
    const Joint* joint = nullptr;
    JointFrames
        frames;       // in the axes of the bodies, from their centres of mass; of what the scene fixes: from its origin
    Pose X_WB, X_WA;  // at the start
    JointPose at;     // at the last read()
    std::array<double, Joint::kMaxAxes> position{};
    std::array<double, 6> lead{}, grows{}, bends{}, next_lead{};  // grows, bends: differences to the step before
    Vec3 f_B_W = Vec3::Zero();                                    // in the last step
  };
  static Pose poseNow(std::size_t body, const Pose& start, const BodySet& bodies);

  std::vector<Link> links_;
};

}  // namespace presa::ode
