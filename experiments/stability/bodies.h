#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/stability/case.h"

/// Measurements on the bodies of a run, independent of the physics engine.
namespace presa::stability {

/// An observer that calls `use` once per dynamics step, with the new state.
StudyRun::Observer atEachStep(std::function<void(const ObjectState&)> use);

/// Index of the body with this name; throws std::logic_error when there is none.
std::size_t bodyNamed(const World& world, const std::string& name);

/// Boxes stacked along z; overlap is measured independently of the solver's contacts.
class BoxStack {
 public:
  /// `bodies` from the lowest to the highest; each must be a box centred in its body frame.
  BoxStack(const World& world, const std::vector<std::string>& bodies);
  /// Max penetration between two successive boxes, by the separating axis test [m]; 0 without overlap.
  double penetration(const ObjectState& state) const;
  /// Max displacement of a box centre since the start, in the frame of the lowest box [m].
  double shift(const ObjectState& state) const;

 private:
  struct Member {
    std::size_t body = 0;
    Vec3 size = Vec3::Zero();
    Vec3 p_Lowest = Vec3::Zero();  ///< position at the start, in the frame of the lowest box
  };
  std::vector<Member> members_;
};

/// Runs and judges a stack: no overlap above 0.5 mm, no displacement (metric `metric`, reference text `oracle`) above 1
/// mm; the height of the body `top` is the curve.
std::vector<Finding> runAndJudge(StudyRun& run, const BoxStack& stack, const std::string& top,
                                 const std::string& metric, const std::string& oracle);

}  // namespace presa::stability
