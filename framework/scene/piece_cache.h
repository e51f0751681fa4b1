#pragma once
#include <optional>
#include <string>

#include "framework/scene/world.h"

namespace presa {

/// Convex pieces of meshes that took long to cut, kept in the user's cache (framework/input/cache.h) by the content of
/// mesh and settings. A cache that cannot be read or written is none. Thread: before a run.

/// The file for a mesh; "" when the user has no cache folder.
std::string pieceCacheFile(const TriMesh& mesh, const Decomposition& wanted);
/// None when there is no such file, or it is damaged.
std::optional<ConvexPieces> readPieces(const std::string& file);
/// Replaces the file at once, so that a reader never sees a part of it.
void keepPieces(const std::string& file, const ConvexPieces& pieces);

/// The convex pieces of a closed mesh, from the cache or cut anew; kept there if cutting took long. Tells the listener of
/// long work, which may stop it: then it throws WorkStopped.
ConvexPieces cutIntoPieces(const TriMesh& mesh, const Decomposition& wanted);

}  // namespace presa
