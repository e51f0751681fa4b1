#pragma once
#include <cstdint>

#include "framework/scene/world.h"

namespace presa::bus {

/// FNV-1a over what makes two worlds the same to a viewer: the bodies by name, kind, start pose and geometry, meshes vertex by
/// vertex, and the roles of the fingers. Not over file names: another machine may keep its meshes elsewhere.
std::uint64_t sceneHash(const World& world);

}  // namespace presa::bus
