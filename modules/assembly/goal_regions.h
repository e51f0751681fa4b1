#pragma once
#include "framework/assembly/goal_choice.h"
#include "framework/assembly/goal_pulls.h"

namespace presa::assembly {

/// Choice and pulls in one place: decides which body is pulled to which goal, what has arrived, and what must wait.
/// Deterministic: equal states give equal decisions. Thread: one; step() allocates no memory.
class GoalRegions {
 public:
  GoalRegions(const Assembly& assembly, std::size_t bodies) : choice_(assembly, bodies), pulls_(assembly, bodies) {}

  /// `period`: time since the last step [s].
  void step(const ObjectState& objects, double period) {
    choice_.step(objects, pulls_.state().goals);
    pulls_.step(objects, choice_.goals(), period);
  }
  /// Releases the last placed body; it is not pulled to that goal again before it has been out of reach.
  void undo() {
    const GoalPulls::Released released = pulls_.undo();
    if (released.goal != kNoGoal) choice_.leave(released.goal, released.body);
  }

  const AssemblyState& state() const noexcept { return pulls_.state(); }
  const SnapConstraints& snapConstraints() const noexcept { return pulls_.snapConstraints(); }

 private:
  GoalChoice choice_;
  GoalPulls pulls_;
};

}  // namespace presa::assembly
