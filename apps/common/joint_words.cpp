#include "apps/common/joint_words.h"

#include <algorithm>
#include <numbers>

namespace presa {

JointUnit unitOf(const Joint& joint, std::size_t axis) {
  return isAngle(joint, axis) ? JointUnit{"deg", 180 / std::numbers::pi} : JointUnit{"mm", 1e3};
}

std::string positionName(const Joint& joint, std::size_t axis) {
  return positionCount(joint) > 1 ? joint.name + ' ' + std::to_string(axis + 1) : joint.name;
}

std::vector<const JointLog::Position*> mostMoved(const JointLog& log, bool angles, std::size_t max) {
  std::vector<const JointLog::Position*> found;
  for (const JointLog::Position& position : log.positions())
    if (isAngle(log.jointOf(position), position.axis) == angles) found.push_back(&position);
  const auto range = [](const JointLog::Position* p) { return p->travel.max - p->travel.min; };
  std::ranges::stable_sort(found, std::greater{}, range);
  if (found.size() > max) found.resize(max);
  std::ranges::sort(found);  // they lie in one array, in the order of the scene
  return found;
}

}  // namespace presa
