#pragma once
#include <cstdint>

/// Interface between the framework and the plug-in presa_mesh_import: plain arrays and two C functions, so that the
/// framework depends on no header of the mesh library.
namespace presa {

inline constexpr std::uint32_t kMeshImportAbi = 2;

/// Maximum size of all files of one mesh together [bytes]: five million triangles as binary STL.
inline constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{256} << 20U;

/// Triangles as stored in the file: not welded, not scaled, not checked. Frame: the file's, turned to z up. Unit: m.
struct ImportedMesh {
  std::uint32_t abi = kMeshImportAbi;
  const char* problem = nullptr;        ///< why the mesh could not be read; null: success
  const char* help = nullptr;           ///< suggested remedy; null: none
  std::int32_t code = 0;                ///< error number when framework/input refused a file; else 0
  const double* coordinates = nullptr;  ///< x y z of each vertex
  std::uint64_t vertex_count = 0;
  const std::int32_t* indices = nullptr;  ///< three per triangle; may name vertices that do not exist
  std::uint64_t triangle_count = 0;
  std::uint64_t ignored_faces = 0;  ///< points and lines, which are skipped
};

/// Symbol kMeshImportSymbol: reads `file` in the format `extension` (lower case, no dot). Never null; throws only
/// std::bad_alloc. Thread: any.
using ImportMeshFunction = const ImportedMesh* (*)(const char* file, const char* extension);
/// Symbol kMeshReleaseSymbol: frees a result.
using ReleaseMeshFunction = void (*)(const ImportedMesh*);

inline constexpr const char* kMeshImportSymbol = "presaImportMesh";
inline constexpr const char* kMeshReleaseSymbol = "presaReleaseMesh";

}  // namespace presa
