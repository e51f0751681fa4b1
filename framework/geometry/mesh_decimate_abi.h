#pragma once
#include <cstdint>

/// What the plug-in presa_mesh_decimate and the framework exchange.
namespace presa {

/// Symbol kMeshDecimateSymbol: writes at most `index_count` corner indices of the simplified mesh (its vertices are some of
/// the given ones) to `out` and returns how many; may stop above `wanted_index_count` when the topology forbids more.
using DecimateMeshFunction = std::uint64_t (*)(const std::uint32_t* indices, std::uint64_t index_count,
                                               const float* coordinates, std::uint64_t vertex_count,
                                               std::uint64_t wanted_index_count, std::uint32_t* out);

inline constexpr const char* kMeshDecimateSymbol = "presaDecimateMesh";

}  // namespace presa
