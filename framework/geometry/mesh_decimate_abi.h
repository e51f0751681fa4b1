#pragma once
#include <cstdint>

/// Interface between the framework and the plug-in presa_mesh_decimate.
namespace presa {

/// Symbol kMeshDecimateSymbol: writes at most `index_count` corner indices of the simplified mesh to `out` and returns
/// their number. The indices refer to the given vertices. Returns more than `wanted_index_count` when the topology or
/// `max_error` (in the unit of the coordinates) forbids further collapses. Vertices in one place with different numbers
/// are a seam (of a texture): they move together or not at all. `error`: about how far the surface moved; may be null.
using DecimateMeshFunction = std::uint64_t (*)(const std::uint32_t* indices, std::uint64_t index_count,
                                               const float* coordinates, std::uint64_t vertex_count,
                                               std::uint64_t wanted_index_count, float max_error, std::uint32_t* out,
                                               float* error);

inline constexpr const char* kMeshDecimateSymbol = "presaDecimateMesh";  ///< a DecimateMeshFunction

}  // namespace presa
