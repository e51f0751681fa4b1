#include <meshoptimizer.h>

#include <algorithm>

#include "framework/geometry/mesh_decimate_abi.h"

extern "C" __attribute__((visibility("default"))) std::uint64_t presaDecimateMesh(
    const std::uint32_t* indices, std::uint64_t index_count, const float* coordinates, std::uint64_t vertex_count,
    std::uint64_t wanted_index_count, float max_error, std::uint32_t* out, float* error) {
  constexpr std::size_t kStride = 3 * sizeof(float);
  const float extent = meshopt_simplifyScale(coordinates, vertex_count, kStride);  // errors are relative to it
  float moved = 0;
  const std::uint64_t count = meshopt_simplify(out, indices, index_count, coordinates, vertex_count, kStride,
                                               wanted_index_count, std::min(1.0F, max_error / extent), 0, &moved);
  if (error != nullptr) *error = moved * extent;
  return count;
}
