#pragma once
#include <cstdint>
#include <vector>

#include "framework/scene/goal_pose.h"
#include "framework/scene/scene.h"
#include "framework/assembly/assembly_state.h"
#include "framework/assembly/attraction.h"
#include "framework/core/state/object_state.h"

namespace presa::assembly {

/// Which body is drawn where, what has arrived, what has to wait. The same states give the same decisions.
/// Thread: one; step() takes no memory.
class Places {
 public:
  Places(const Assembly& assembly, std::size_t bodies);

  /// `period`: since the step before [s].
  void step(const ObjectState& objects, double period);
  /// Takes out what was put last; it is not drawn there again before it has been out of reach.
  void undo();

  const AssemblyState& state() const noexcept { return state_; }
  const Attractions& attractions() const noexcept { return attractions_; }

  static constexpr double kSettle = 0.1;             ///< in its place and slow for so long: it has arrived [s]
  static constexpr double kSlow = 0.01;              ///< [m/s]
  static constexpr double kSlowTurn = 0.2;           ///< [rad/s]
  static constexpr double kLeave = 1.25;             ///< a body that is drawn is let go this much farther away
  static constexpr double kRate = 20, kSpeed = 0.1;  ///< of Attraction [1/s, m/s]
  static constexpr double kRise = 0.3;               ///< in which a place comes to its full pull [s]
  /// What rolls is slowed, as by grass: a drum on even ground would never stop [m/s^2, m/s].
  static constexpr double kGrass = 0.3, kRollsTo = 0.5;
  static constexpr double kBringBackWeights = 1.5;  ///< what friction on the ground does not hold

 private:
  struct Candidate {
    std::size_t goal = 0, body = 0;
    Way way;
    Pose X_WB;  ///< of the goal, turned to suit
  };
  void findCandidates(const ObjectState& objects);
  void assign();
  void settle(const ObjectState& objects, double period);
  void bringBack(const ObjectState& objects, double period);
  void slowDown(const ObjectState& objects);
  void attract(std::size_t body, const Pose& X_WB, bool fixed, bool turns, double weights, double speed);
  std::int32_t missing(std::size_t goal) const;

  const Assembly& assembly_;
  std::vector<char> belongs_;          // by body: some goal is for it
  std::vector<std::int32_t> goal_of_;  // by body: drawn or standing there; kNoGoal
  std::vector<std::int32_t> refused_;  // by body: goal it was taken out of, until it has been away
  std::vector<Pose> placed_;           // by goal: pose in which it is filled
  std::vector<double> drawing_;        // by goal: draws its body for so long [s]
  std::vector<double> settled_;        // by goal: in its place for so long [s]
  std::vector<std::size_t> order_;     // goals as they were filled
  std::vector<double> returning_;      // by body: brought back, for so long without coming nearer [s]
  std::vector<double> nearest_;        // by body: to where it is drawn, so far [m]
  std::vector<char> carried_;          // by body: brought back as a fixed one, through whatever is in the way
  std::vector<Candidate> candidates_;
  AssemblyState state_;
  Attractions attractions_;
};

}  // namespace presa::assembly
