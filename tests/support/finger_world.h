#pragma once
#include <memory>
#include <string>

#include "framework/scene/world.h"

namespace presa::test {

/// The world of a scene whose only device role is "finger", which no device plays. Throws InputError.
std::shared_ptr<const World> fingerWorld(const std::string& scene_xml);

}  // namespace presa::test
