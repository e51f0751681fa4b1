#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/stability/case.h"

/// Bodies as a case sees them from outside.
namespace presa::stability {

/// Calls `use` with every new state of the bodies: once a dynamics step.
StudyRun::Observer atEachStep(std::function<void(const ObjectState&)> use);

/// Index of a body of the scene by its name; throws std::logic_error when there is none.
std::size_t bodyNamed(const World& world, const std::string& name);

/// Boxes standing on each other along z, measured apart from the solver's own idea of contact.
class BoxStack {
 public:
  /// From the lowest to the highest; each a box in its own frame.
  BoxStack(const World& world, const std::vector<std::string>& bodies);
  /// How deep any box is in the next one, by the separating axis test [m]; 0 when none is.
  double penetration(const ObjectState& state) const;
  /// How far the centre of any box has gone from where it was at the start, seen from the lowest one [m].
  double shift(const ObjectState& state) const;

 private:
  struct Member {
    std::size_t body = 0;
    Vec3 size = Vec3::Zero();
    Vec3 p_Lowest = Vec3::Zero();  ///< at the start, in the lowest box's frame
  };
  std::vector<Member> members_;
};

/// Does the run and judges the stack: no overlap beyond 0.5 mm, no displacement (named `metric`, held against `oracle`)
/// beyond 1 mm; with the height of the body `top` as curve.
std::vector<Finding> runAndJudge(StudyRun& run, const BoxStack& stack, const std::string& top,
                                 const std::string& metric, const std::string& oracle);

}  // namespace presa::stability
