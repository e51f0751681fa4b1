#pragma once
#include <cstdint>

#include "apps/temple/ruins.h"

namespace presa::temple {

/// Ruins without a fall: every block stands upright in front of the building's site, turned at random about the
/// vertical and far enough from the others for two open fingertips. Equal
/// building and seed give equal poses, to the bit. Throws InputError (E977: more blocks than stand on the field).
Ruins standBlocks(const Building& building, std::uint64_t seed);

}  // namespace presa::temple
