#pragma once
#include <cstdint>

#include "framework/scene/world.h"

namespace presa::bus {

/// FNV-1a hash of everything that a viewer draws: bodies by name, kind, start pose and geometry, meshes vertex by
/// vertex, and the roles of the fingers. File names are excluded, because another machine may keep its meshes
/// elsewhere.
std::uint64_t sceneHash(const World& world);

}  // namespace presa::bus
