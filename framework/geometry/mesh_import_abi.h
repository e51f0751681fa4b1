#pragma once
#include <cstdint>

/// What the plug-in presa_mesh_import and the framework exchange: plain arrays behind two C functions, so that nothing
/// of the library that reads the files shows on this side.
namespace presa {

inline constexpr std::uint32_t kMeshImportAbi = 2;

/// All files of a mesh together [bytes]: five million triangles as binary STL.
inline constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{256} << 20U;

/// Triangles as the file has them: not welded, not scaled, not checked. Frame: the file's, turned to z up; unit: m.
struct ImportedMesh {
  std::uint32_t abi = kMeshImportAbi;
  const char* problem = nullptr;        ///< why there is no mesh, in words; null: read
  const char* help = nullptr;           ///< what to do about it; null: nothing in particular
  std::int32_t code = 0;                ///< of the problem, when it is a file that may not be read; else 0
  const double* coordinates = nullptr;  ///< x y z of each vertex
  std::uint64_t vertex_count = 0;
  const std::int32_t* indices = nullptr;  ///< three of each triangle; may name vertices that do not exist
  std::uint64_t triangle_count = 0;
  std::uint64_t ignored_faces = 0;  ///< points and lines
};

/// Symbol kMeshImportSymbol: reads `file`, whose format is `extension` (lower case, no dot). Never null; throws only std::bad_alloc.
/// Thread: any.
using ImportMeshFunction = const ImportedMesh* (*)(const char* file, const char* extension);
/// Symbol kMeshReleaseSymbol: frees a result.
using ReleaseMeshFunction = void (*)(const ImportedMesh*);

inline constexpr const char* kMeshImportSymbol = "presaImportMesh";
inline constexpr const char* kMeshReleaseSymbol = "presaReleaseMesh";

}  // namespace presa
