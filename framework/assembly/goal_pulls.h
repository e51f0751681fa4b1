#pragma once
#include <cstdint>
#include <vector>

#include "framework/assembly/assembly_state.h"
#include "framework/assembly/snap_constraint.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// Carries out what was chosen: pulls bodies to their goals with a soft rise, keeps what has arrived, brings back what
/// has left the workspace, and slows what rolls. It runs beside the dynamics, wherever the choice is made.
/// Deterministic. Thread: one; step() allocates no memory.
class GoalPulls {
 public:
  GoalPulls(const Assembly& assembly, std::size_t bodies);

  /// `chosen`: by goal, the body to be pulled (kDrawing), or none; entries of filled goals do not count. `period`: time
  /// since the last step [s].
  void step(const ObjectState& objects, const std::vector<GoalState>& chosen, double period);
  /// Releases the last placed body; returns its goal, as it was.
  struct Released {
    std::int32_t goal = kNoGoal, body = kNoBody;
  };
  Released undo();

  const AssemblyState& state() const noexcept { return state_; }
  const SnapConstraints& snapConstraints() const noexcept { return snap_constraints_; }

  static constexpr double kSettle = 0.1;    ///< time within tolerance and slow before a body counts as placed [s]
  static constexpr double kSlow = 0.01;     ///< maximum speed of a placed body [m/s]
  static constexpr double kSlowTurn = 0.2;  ///< maximum angular speed of a placed body [rad/s]
  static constexpr double kRate = 20, kSpeed = 0.1;  ///< SnapConstraint::rate [1/s] and ::speed [m/s]
  static constexpr double kRise = 0.3;               ///< time in which the pull rises to its maximum [s]
  /// Slow rolling bodies are braked as by grass, because a drum on even ground would never stop: deceleration [m/s^2],
  /// applied below a speed [m/s].
  static constexpr double kGrass = 0.3, kRollsTo = 0.5;
  static constexpr double kBringBackWeights = 1.5;  ///< pull in weights, more than friction on the ground can hold [-]

 private:
  void take(const ObjectState& objects, const std::vector<GoalState>& chosen);
  void settle(const ObjectState& objects, double period);
  void bringBack(const ObjectState& objects, double period);
  void slowDown(const ObjectState& objects);
  void addSnapConstraint(std::size_t body, const Pose& X_WB, bool fixed, bool turns, double weights, double speed);

  const Assembly& assembly_;
  std::vector<char> belongs_;       // by body: some goal accepts it
  std::vector<char> busy_;          // by body: it is pulled to a goal, or stands there
  std::vector<Pose> placed_;        // by goal: target pose of its body
  std::vector<double> pull_time_;   // by goal: time for which it has pulled its body [s]
  std::vector<double> settled_;     // by goal: time for which its body has been in place [s]
  std::vector<std::size_t> order_;  // filled goals, in order of filling
  std::vector<double> returning_;   // by body: time outside the workspace without progress [s]
  std::vector<double> nearest_;     // by body: smallest distance to its return target so far [m]
  std::vector<char> carried_;       // by body: carried back as a fixed body, through obstacles
  AssemblyState state_;
  SnapConstraints snap_constraints_;
};

}  // namespace presa
