#pragma once
#include <cstdint>

/// Interface between the framework and the plug-in presa_mesh_import: plain arrays and two C functions, so that the
/// framework depends on no header of the mesh library.
namespace presa {

inline constexpr std::uint32_t kMeshImportAbi = 6;  ///< version of the structs below; see ImportedMesh::abi

/// Maximum size of all files of one mesh together [bytes]: five million triangles as binary STL.
inline constexpr std::uint64_t kMaxMeshBytes = std::uint64_t{256} << 20U;

/// A range of drawn vertices and of their corners, of one material.
struct ImportedPart {
  std::uint32_t first_vertex = 0,  ///< index into ImportedModel::vertices
      vertex_count = 0,            ///< used by this part alone
      first_corner = 0,            ///< index into ImportedModel::corners
      corner_count = 0,            ///< three for each triangle
      material = 0;                ///< index into ImportedModel::materials
};

/// As ModelMaterial (model.h).
struct ImportedMaterial {
  float color[3] = {1, 1, 1};   ///< linear RGB
  float roughness = 0.9F,       ///< 0 to 1
      metallic = 0,             ///< 0 or 1
      relief = 1;               ///< factor of the normal map's slopes
  std::int32_t color_map = -1,  ///< index into ImportedModel::textures; -1: none
      normal_map = -1,          ///< the same
      roughness_map = -1;       ///< the same
  std::uint32_t unmapped = 0;   ///< 1: its maps are left out because a mesh lacks texture coordinates
};

/// Ranges of ImportedModel::text.
struct ImportedTexture {
  std::uint64_t name = 0,  ///< first byte of its name
      name_size = 0,       ///< [bytes]
      bytes = 0,           ///< first byte of the compressed picture
      bytes_size = 0;      ///< [bytes]; 0: a file of that name
};

/// What a file says about colours. No parts: nothing.
struct ImportedModel {
  static constexpr std::size_t kFloats = 11;  ///< of a vertex: position, normal (0: none), texture coordinates, colour
  const float* vertices = nullptr;            ///< kFloats for each vertex
  std::uint64_t vertex_count = 0;             ///< vertices, each of kFloats numbers
  const std::uint32_t* corners = nullptr;     ///< three per triangle; all of them exist
  std::uint64_t corner_count = 0;             ///< three for each triangle
  const ImportedPart* parts = nullptr;        ///< part_count of them
  std::uint64_t part_count = 0;               ///< 0: nothing about colours
  const ImportedMaterial* materials = nullptr;  ///< by ImportedPart::material
  const ImportedTexture* textures = nullptr;    ///< texture_count of them
  std::uint64_t texture_count = 0;              ///< textures of all materials
  const char* text = nullptr;                   ///< names and embedded pictures of all textures, one behind the other
  const char* missing_library = nullptr;        ///< file of materials that is not there; null: none
};

/// Names of the materials of triangles, and grey values of vertex colours; as MeshAttributes (mesh_attributes.h).
struct ImportedAttributes {
  const char* names = nullptr;            ///< of the materials that triangles have, each ended by a zero
  std::uint64_t names_size = 0;           ///< [bytes], with the zeros
  const std::int32_t* part_of = nullptr;  ///< by triangle: which of the names; -1: none
  std::uint64_t part_count = 0;           ///< numbers in `part_of`: triangles of the mesh
  const float* grey = nullptr;            ///< three for each triangle, 0 to 1
  std::uint64_t grey_count = 0;           ///< numbers in `grey`; 0: the file has no colours of vertices
};

/// Content of a file that is read beside its triangles.
enum class MeshWanted : std::uint32_t {
  kTriangles,  ///< nothing
  kModel,      ///< ImportedMesh::model
  kAttributes  ///< ImportedMesh::attributes
};

/// Triangles as stored in the file: not welded, not scaled, not checked. Frame: the file's, turned to z up. Unit: m.
struct ImportedMesh {
  std::uint32_t abi = kMeshImportAbi;     ///< kMeshImportAbi of the plug-in; another one is refused (E300)
  const char* problem = nullptr;          ///< why the mesh could not be read; null: success
  const char* help = nullptr;             ///< suggested remedy; null: none
  std::int32_t code = 0;                  ///< error number when framework/input refused a file; else 0
  const double* coordinates = nullptr;    ///< x y z of each vertex
  std::uint64_t vertex_count = 0;         ///< vertices, each of three numbers
  const std::int32_t* indices = nullptr;  ///< three per triangle; may name vertices that do not exist
  std::uint64_t triangle_count = 0;       ///< triangles, each of three indices
  std::uint64_t ignored_faces = 0;        ///< points and lines, which are skipped
  ImportedModel model;                    ///< only when it is asked for
  ImportedAttributes attributes;          ///< only when they are asked for
};

/// A file to be read.
struct MeshFile {
  const char* file = nullptr;                  ///< path
  const char* extension = nullptr;             ///< its format: lower case, no dot
  MeshWanted wanted = MeshWanted::kTriangles;  ///< beside the triangles
};

/// Symbol kMeshImportSymbol: reads `count` files, several at a time where the machine has several cores; imported[i] is
/// what files[i] holds, never null. Throws only std::bad_alloc; then there is nothing to free. Thread: any.
using ImportMeshesFunction = void (*)(const MeshFile* files, std::uint64_t count, const ImportedMesh** imported);
/// Symbol kMeshReleaseSymbol: frees a result.
using ReleaseMeshFunction = void (*)(const ImportedMesh*);

inline constexpr const char* kMeshImportSymbol = "presaImportMeshes";  ///< an ImportMeshesFunction
inline constexpr const char* kMeshReleaseSymbol = "presaReleaseMesh";  ///< a ReleaseMeshFunction

}  // namespace presa
