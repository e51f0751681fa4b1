#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

struct IsolationLimits {
  std::size_t memory = 0;  ///< additional memory that the work may allocate [bytes]
  unsigned seconds = 0;    ///< processor time [s]
};

/// Fills in `mesh` within `limits`.
struct IsolatedRead {
  IsolationLimits limits;
  std::function<void(RawMesh&)> work;
  RawMesh* mesh = nullptr;
};

/// Runs each of `groups` in a child process of its own, all at once, and the reads of a group one after the other. No group
/// is empty. An exception, a crash, or exhausted memory or time in a child becomes RawMesh::problem, and another child
/// runs the rest of that group. Reason: the readers of assimp 5.2 crash on some damaged COLLADA, glTF and PLY files and
/// allocate as much as a header claims; a scene with such a file must be refused, not take the program down.
void runIsolated(const std::vector<std::vector<IsolatedRead>>& groups);

}  // namespace presa
