#pragma once
#include <string>
#include <vector>

#include "apps/common/joint_log.h"

/// Positions of joints as they are told: in degrees and in the unit of the text.
namespace presa {

struct JointUnit {
  const char* name;
  double factor;  ///< from [rad] or [m]
};
/// Degrees or millimetres.
JointUnit unitOf(const Joint& joint, std::size_t axis);
/// "door", and "gimbal 2" where a joint has several positions.
std::string positionName(const Joint& joint, std::size_t axis);
/// Of the positions with that unit, at most `max` that changed most; in the order of the scene.
std::vector<const JointLog::Position*> mostMoved(const JointLog& log, bool angles, std::size_t max);

}  // namespace presa
