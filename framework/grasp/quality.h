#pragma once
#include "framework/grasp/wrench_space.h"

namespace presa {

/// Which wrenches a grasp can resist, however hard its fingers press.
enum class GraspClosure {
  kFull,     ///< force closure: every wrench
  kPartial,  ///< all but some motions that no contact opposes (two point fingers: turns about the line between them)
  kNone,     ///< they push to one side: some wrench they can exert, but not its opposite (or not provably)
};

/// A figure between two bounds that are both proven: from a hull within the set, and from the exact support function.
/// They meet within kMeet of each other, unless the hull grew beyond what is affordable.
struct ProvenBounds {
  double at_least = 0, at_most = 0;
  static constexpr double kMeet = 0.01;
  bool met() const noexcept { return at_least >= (1 - kMeet) * at_most; }
};

struct GraspQuality {
  GraspClosure closure = GraspClosure::kNone;
  /// Ferrari and Canny's epsilon: the largest wrench (torque over the length) that is resisted in every direction, by
  /// fingers within the grip bound [N]. Exactly 0 without full closure.
  ProvenBounds epsilon;
  /// kPartial: the same among the wrenches that the contacts can exert at all; otherwise equal to epsilon.
  ProvenBounds within_span;
  /// The motion that the contacts oppose least, unit length. Where closure is not full, they do not oppose it at all.
  Vec6 weakest = Vec6::Zero();
  int unopposed = 0;  ///< dimensions of motion that no contact opposes in either sense: 6 minus the rank of the space
};

/// Quality of a grasp of at least one contact. [FerrariCanny1992]; round cones and growth of the hull as in
/// [Zheng2013]. Does not depend on the frame, nor on the unit of length. Another finger never lowers epsilon, while
/// centre and length stay the same. Thread: main; takes milliseconds to seconds. Throws InputError when the plug-in
/// presa_hull is missing.
GraspQuality graspQuality(const GraspSnapshot& grasp, GripBound bound);

/// Factor by which `load` on the body (force [N], torque about the centre of mass [N m]) may grow before the grasp
/// cannot hold it: contacts slip unless some finger presses harder than its max_normal. 0: the load is not held. A load
/// of which over 5 % lies across all that the contacts can exert is not held; below, that part is left out.
/// Two opposite fingers that carry a weight between them: 2 mu N / (m g).
ProvenBounds loadFactor(const GraspSnapshot& grasp, const Wrench& load);

/// The smallest bound of every finger's normal force with which the grasp holds `load` [N]; infinity: none does.
/// Ignores max_normal. Two opposite fingers and a weight: m g / (2 mu).
ProvenBounds minGrip(const GraspSnapshot& grasp, const Wrench& load);

}  // namespace presa
