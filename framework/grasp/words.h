#pragma once
#include <string>
#include <vector>

#include "framework/grasp/grasp.h"

namespace presa {

/// A motion (v, length * angular velocity) of the grasped body as a person would say it: "turns about the line between
/// the fingers", "slides down". Grasp and `up` are in one frame; `names` of the contacts, in their order, say which of
/// more than two: "turns about the line between thumb and middle". `up` may be zero: then nothing is upright.
std::string motionWords(const GraspSnapshot& grasp, const Vec6& motion, const std::vector<std::string>& names,
                        const Vec3& up);

}  // namespace presa
