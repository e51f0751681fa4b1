#pragma once
#include <cstddef>
#include <functional>

#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {

struct IsolationLimits {
  std::size_t memory = 0;  ///< what the work may allocate [bytes]
  unsigned seconds = 0;    ///< processor time [s]
};

/// Does `work` in a child process and brings its mesh back. Whatever happens to the child (exception, crash, memory or
/// time exhausted) becomes RawMesh::problem. The readers of assimp 5.2 crash on some damaged COLLADA, glTF and PLY
/// files and allocate what a header claims; a scene with such a file must be refused, not take the program down.
RawMesh runIsolated(const IsolationLimits& limits, const std::function<void(RawMesh&)>& work);

}  // namespace presa
