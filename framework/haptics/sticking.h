#pragma once
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/contact_lcp.h"
#include "framework/scene/scene.h"

namespace presa {

/// Where tool and bodies are in a step.
struct StepPoses {
  const Pose& X_WT;               ///< of the tool, before the step
  const std::vector<Pose>& X_WB;  ///< of the bodies, by solid
};

/// Coulomb friction on top of the frictionless contact problem: for each pair of parts the pose at which friction holds
/// the tool on the body. The stretch of a point of contact is its way along the surface since then; its stiffness is its
/// share of the pair's by pressure, so that all points of a pair break away at once. A pair that slides has the force of
/// dynamic friction against its way; where this force changes the way, a spring so weak that it gives just that force at the
/// end of the step. Thread: haptic; nonblocking except for construction.
class Sticking {
 public:
  /// `stiffness`: of a pair, along the surface [N/m]. `friction`: by solid; must outlive it. For so many `pairs` in
  /// contact.
  Sticking(double stiffness, const std::vector<FrictionCoefficients>& friction, std::size_t pairs)
      : stiffness_(stiffness), friction_(friction), anchors_(pairs) {}

  /// Begins a step: every pair is thought to hold; if `steady`, those that slid in the last step to slide on as fast.
  void begin(bool steady = false) noexcept;
  /// Adds friction to the problem, for the forces of `contacts`: a spring where it holds, a force where it slides, or a
  /// weak spring where that force changes the way.
  void addTo(ContactProblem& problem, const StepPoses& poses, BoundedList<PressedPoint>& contacts) noexcept;
  /// Friction of the contacts of pairs that were found to slide in this step, for their forces and the step u.
  void slide(const Vec6& u, const StepPoses& poses, BoundedList<PressedPoint>& contacts) const noexcept;
  /// Finds the friction of all contacts after the step u. False: a pair slides that was thought to hold, or the friction in
  /// the problem was more than 2 % of its limit off.
  bool update(const Vec6& u, const StepPoses& poses, BoundedList<PressedPoint>& contacts) noexcept;
  /// Ends the step, with the tool at X_WT: friction holds what touches there, and follows what slides.
  void keep(const Pose& X_WT, const StepPoses& poses, const BoundedList<PressedPoint>& contacts) noexcept;
  bool slides(const PressedPoint& contact) const noexcept;  ///< in this step
  void letGo() noexcept { anchors_.clear(); }               ///< the tool touches nothing

 private:
  struct Anchor {
    std::uint32_t pair = 0, solid = 0;
    Pose X_BT;
    bool slid = false, slides = false;           // in the last step, in this one
    bool is_spring = false;                      // while it slides
    bool holds = false;                          // the spring of a pair that slides is that of one that does not
    double missed = 0;                           // friction in the problem less that after it [N]
    double pressure = 0, limit = 0, wanted = 0;  // of its contacts: force, friction at most, friction to hold [N]
    double stretched = 0;                        // sum of forces times stretches [N m]
  };
  const Anchor* anchorOf(const PressedPoint& contact) const noexcept;
  Anchor* anchorOf(const PressedPoint& contact) noexcept;
  /// Before the step.
  static Vec3 stretchOf(const PressedPoint& contact, const Anchor& anchor, const StepPoses& poses) noexcept;

  double stiffness_;
  const std::vector<FrictionCoefficients>& friction_;
  BoundedList<Anchor> anchors_;
};

/// Solves the step with friction: frictionless first, then for those pressures, until every pair holds or slides as was
/// thought. `without`: the problem without friction. `u`: as in solveContacts(). True: the problem was solved exactly, with
/// friction that fits it. Thread: haptic; nonblocking.
bool solveWithFriction(const ContactProblem& without, const StepPoses& poses, Sticking& sticking,
                       BoundedList<PressedPoint>& contacts, Vec6& u) noexcept;

}  // namespace presa
