#pragma once
#include <string>

#include "framework/scene/scene.h"

/// Joints in words, for people.
namespace presa {

/// A position of axis i with its unit: "34.2°", "-12.0 mm".
std::string positionText(const Joint& joint, std::size_t i, double position);

/// What a joint is, in one line: "hinge of door to the world about 0 0 1, from 0.0° to 110.0°, friction 0.02 N m".
std::string describeJoint(const Scene& scene, const Joint& joint);

}  // namespace presa
