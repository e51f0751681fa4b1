#pragma once
#include <cstdint>
#include <vector>

#include "framework/assembly/assembly_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/goal_pose.h"
#include "framework/scene/scene.h"

namespace presa {

/// Decides which body each open goal pulls, and which goals have to wait; knows nothing of forces. It runs beside the
/// dynamics, or in a viewer that guides the run. Deterministic: equal states give equal decisions.
/// Thread: one; step() allocates no memory.
class GoalChoice {
 public:
  GoalChoice(const Assembly& assembly, std::size_t bodies);

  /// `standing`: the state of each goal in the run, of which only filled goals count. A body that no longer stands
  /// where
  /// it stood in the last step is left alone as after leave().
  void step(const ObjectState& objects, const std::vector<GoalState>& standing);
  /// The body is not pulled to that goal again before it has been out of reach.
  void leave(std::int32_t goal, std::int32_t body);
  /// By goal: filled as in `standing`, else open, blocked, or the body to be pulled.
  const std::vector<GoalState>& goals() const noexcept { return goals_; }

  static constexpr double kLeave = 1.25;  ///< a pulled body is released at this multiple of the reach [-]

 private:
  struct Candidate {
    std::size_t goal = 0, body = 0;
    double distance = 0;  ///< [m]
  };
  void noteStanding(const std::vector<GoalState>& standing);
  void findCandidates(const ObjectState& objects);
  void assign();

  const Assembly& assembly_;
  std::vector<GoalState> goals_;
  std::vector<std::int32_t> goal_of_;  // by body: the goal it is pulled to or stands at; kNoGoal
  std::vector<std::int32_t> refused_;  // by body: goal that undo took it from, until it has been out of reach
  std::vector<Candidate> candidates_;
};

/// How far a body is from a goal, in the goal's nearest symmetric orientation.
PoseDifference differenceTo(const AssemblyGoal& goal, const Pose& X_WB);
/// Whether a body is within `slack` times the reach of a goal, in the goal's nearest symmetric orientation.
bool withinReach(const Assembly& assembly, const AssemblyGoal& goal, const Pose& X_WB, double slack);
/// The first goal that must be filled before `goal` and is not; kNoGoal: none.
std::int32_t missingBefore(const Assembly& assembly, std::size_t goal, const std::vector<GoalState>& goals);

}  // namespace presa
