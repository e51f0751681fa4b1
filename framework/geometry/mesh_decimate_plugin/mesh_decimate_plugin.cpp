#include <meshoptimizer.h>

#include "framework/geometry/mesh_decimate_abi.h"

extern "C" __attribute__((visibility("default"))) std::uint64_t presaDecimateMesh(
    const std::uint32_t* indices, std::uint64_t index_count, const float* coordinates, std::uint64_t vertex_count,
    std::uint64_t wanted_index_count, std::uint32_t* out) {
  // target error 1: no error limit, because the caller asks for a count and measures the distance itself
  return meshopt_simplify(out, indices, index_count, coordinates, vertex_count, 3 * sizeof(float), wanted_index_count,
                          1.0F, 0, nullptr);
}
