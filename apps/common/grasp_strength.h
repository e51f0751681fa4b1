#pragma once
#include <optional>
#include <string>

#include "apps/common/grasp_figures.h"
#include "framework/grasp/quality.h"

namespace presa {

/// How good a grasp is, judged by the contacts of one sample of the trace.
struct GraspStrength {
  double time = 0;  ///< of the sample [s]
  /// The fingers that hold the object then; forces act at the proxies, as in the dynamics. max_normal: the present
  /// normal forces [N].
  GraspSnapshot grasp;
  std::vector<std::size_t> contact_points;  ///< of the fingers, indices into RunResult::contact_points
  std::vector<double> friction_used;        ///< by finger: tangential force over its bound, 1: about to slip
  GraspQuality quality;                     ///< GripBound::kSum: for 1 N of grip in all
  std::string weakest;                      ///< GraspQuality::weakest in words
  double weight = 0;                        ///< m g [N]
  ProvenBounds
      slip_margin;        ///< factor by which the weight may grow while no finger presses harder; infinity: no weight
  ProvenBounds min_grip;  ///< normal force per finger that holds the weight [N]; infinity: none does
};

/// At the end of the hold. None if the object's friction law is not Coulomb's, or fewer than two fingers ever held it.
/// Thread: main; takes up to a few seconds. Throws InputError when the plug-in presa_hull is missing.
std::optional<GraspStrength> graspStrength(const RunResult& result, const GraspFigures& figures);

/// "full", "partial" or "none".
const char* toString(GraspClosure closure);

}  // namespace presa
