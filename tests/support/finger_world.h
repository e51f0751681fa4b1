#pragma once
#include <memory>
#include <string>

#include "framework/scene/world.h"

namespace presa::test {

/// The world of a scene whose only device role is "finger", which no device plays. Throws InputError.
std::shared_ptr<const World> fingerWorld(const std::string& scene_xml);

/// The world of one element of a plug-in: a free cube of 70 mm at W's origin, which has the element if its manifest says
/// in="body", and one fingertip of 8 mm; gravity [m/s^2]. Throws InputError with every finding.
std::shared_ptr<const World> elementWorld(const std::string& element, const std::string& gravity = "0 0 0");

}  // namespace presa::test
