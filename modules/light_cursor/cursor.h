#pragma once
#include <vector>

#include "framework/haptics/convex_pairs.h"
#include "framework/haptics/sticking.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"

namespace presa {

/// How a tool is rendered.
struct CursorLaw {
  double mass = 0;                ///< [kg], > 0
  double stiffness = 0;           ///< of a contact [N/m], > 0
  std::size_t max_contacts = 64;  ///< points in a step
};

/// One tool: a light rigid body on the spring and damper of its handle. Thread: haptic; nonblocking except for
/// construction.
class Cursor {
 public:
  /// `inertia`: of the tool for a density of one, in T. All but `law` and `inertia` must outlive it.
  Cursor(const ConvexSolid& tool, const std::vector<ConvexSolid>& bodies,
         const std::vector<FrictionCoefficients>& friction, const ToolCoupling& coupling, const MassProperties& inertia,
         const CursorLaw& law);

  /// How a step went.
  struct Step {
    bool whole = true;  ///< all points of contact found room
    bool exact = true;  ///< the contact problem was solved exactly
  };
  /// One step of the tick's period. `X_WB`: of the bodies, by solid.
  Step step(const ToolInput& input, const std::vector<Pose>& X_WB, Pose& X_WT) noexcept;
  /// Starts anew at rest, touching nothing.
  void reset() noexcept;

  const BoundedList<PressedPoint>& contacts() const noexcept { return contacts_; }  ///< after the step
  const Sticking& sticking() const noexcept { return sticking_; }                   ///< after the step
  /// Wrench of the handle on the tool about the tool's origin, after the step.
  const Vec6& ofHandle() const noexcept { return of_handle_; }
  double radius() const noexcept { return radius_; }  ///< of the ball around the tool's origin [m]

 private:
  Mat6 massAt(const Quat& q_WT) const noexcept;
  bool findContacts(const Pose& X_WT, double margin) noexcept;
  /// The step that the bodies allow, of one that the handle wants.
  Step meet(const ContactProblem& problem, const StepPoses& poses, Vec6& u) noexcept;

  const ConvexSolid& tool_;
  const ToolCoupling& coupling_;
  ConvexPairs pairs_;
  CursorLaw law_;
  double radius_ = 0;
  Vec3 p_TCm_ = Vec3::Zero();      // centre of mass
  Mat3 inertia_T_ = Mat3::Zero();  // about the tool's origin [kg m^2]
  BoundedList<PressedPoint> contacts_;
  Sticking sticking_;
  Vec6 v_ = Vec6::Zero();  // velocity of the tool's origin, and angular velocity, in W
  Vec6 of_handle_ = Vec6::Zero();
};

}  // namespace presa
