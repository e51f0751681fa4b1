#pragma once
#include <cstddef>
#include <functional>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

struct IsolationLimits {
  std::size_t memory = 0;  ///< additional memory that the work may allocate [bytes]
  unsigned seconds = 0;    ///< processor time [s]
};

/// Runs `work` in a child process and returns its mesh. An exception, a crash, or exhausted memory or time in the child
/// becomes RawMesh::problem. Reason: the readers of assimp 5.2 crash on some damaged COLLADA, glTF and PLY files and
/// allocate as much as a header claims; a scene with such a file must be refused, not take the program down.
RawMesh runIsolated(const IsolationLimits& limits, const std::function<void(RawMesh&)>& work);

}  // namespace presa
