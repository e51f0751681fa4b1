#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/geometry/tri_mesh.h"

/// Mesh files as they are drawn: with colours and textures. Only the view looks at them; what is felt and moved has the
/// triangles alone.
namespace presa {

inline constexpr int kMaxTextureSide = 4096;                    ///< [pixel]
inline constexpr std::uint64_t kMaxTextureBytes = 64ULL << 20;  ///< of one compressed texture
/// Of all textures of a model together [pixel]: eight of the largest.
inline constexpr std::uint64_t kMaxTexels = 8ULL * kMaxTextureSide * kMaxTextureSide;

/// A compressed picture, PNG or JPEG: in a file of its own, or in the model's (then `bytes` holds it).
struct ModelTexture {
  std::string name;   ///< as the model calls it
  std::string file;   ///< path; empty: embedded
  std::string bytes;  ///< of an embedded one
  int width = 0,      ///< [pixel]
      height = 0;     ///< [pixel]
};

/// A surface under light. Maps are indices into Model::textures; -1: none.
struct ModelMaterial {
  Vec3 color = Vec3::Ones();  ///< linear; a factor of the colour map
  double roughness = 0.9;     ///< 0 (a mirror) to 1 (chalk); a factor of the map's green channel
  double metallic = 0;        ///< 0 or 1; a factor of the map's blue channel
  double relief = 1;          ///< factor of the normal map's slopes
  int color_map = -1;         ///< sRGB
  int normal_map = -1;        ///< normals in the tangent frame, or, when it is grey, heights
  int roughness_map = -1;     ///< its green channel: roughness; blue: metallic
};

/// Single precision: the graphics card's.
struct ModelVertex {
  std::array<float, 3> position{};      ///< [m]
  std::array<float, 3> normal{};        ///< unit; zero: the file has none
  std::array<float, 2> at{};            ///< in the textures, from their lower left corner
  std::array<float, 3> color{1, 1, 1};  ///< linear; a factor
};

/// A mesh file with what it says about colours, in the mesh's frame and unit (tri_mesh.h). Constant, any thread.
struct Model {
  std::vector<ModelVertex> vertices;   ///< part by part
  std::vector<std::uint32_t> corners;  ///< three for each triangle, counter-clockwise seen from outside
  /// A range of vertices that only its own triangles use, of one material.
  struct Part {
    std::uint32_t first_vertex = 0,  ///< index into `vertices`
        vertex_count = 0,            ///< used by this part alone
        first_corner = 0,            ///< index into `corners`
        corner_count = 0;            ///< three for each triangle
    ModelMaterial material;          ///< its maps are indices into `textures`
  };
  std::vector<Part> parts;                                      ///< in the order of the file
  std::vector<ModelTexture> textures;                           ///< named by the materials of `parts`
  std::string file;                                             ///< path of the mesh file
  std::size_t triangles() const { return corners.size() / 3; }  ///< of all parts
};

/// Result of importDrawn.
struct DrawnMesh {
  TriMesh mesh;                        ///< as by importMesh; empty after an error
  std::shared_ptr<const Model> model;  ///< null: the file has neither colours nor textures
};
/// importMesh (tri_mesh.h), and the model in the same file; no model: the file has neither colours nor textures.
/// Textures are looked at, not decoded: E260 missing or unreadable, E261 neither PNG nor JPEG, E262 too large, E692
/// outside of the folders that the file may name; W263 no texture coordinates, W264 no material library. Thread and
/// errors as importMesh.
DrawnMesh importDrawn(const std::string& file, const ImportOptions& options, const SourceLocation& where,
                      Diagnostics& diagnostics);

/// A file for importMeshes.
struct MeshOrder {
  std::string file;       ///< path
  ImportOptions options;  ///< as for importMesh
  SourceLocation where;   ///< of the findings
  bool drawn = false;     ///< as importDrawn; else as importMesh, without a model
};
/// Several files at once, in a fraction of the time that they take one by one; the results in the order of `orders`.
std::vector<DrawnMesh> importMeshes(std::span<const MeshOrder> orders, Diagnostics& diagnostics);

}  // namespace presa
