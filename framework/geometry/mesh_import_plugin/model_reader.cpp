#include "framework/geometry/mesh_import_plugin/model_reader.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <new>

#include "framework/geometry/mesh_import_plugin/equal_vertices.h"
#include "framework/geometry/srgb.h"

namespace presa {
namespace {

constexpr std::size_t kFloats = ImportedModel::kFloats;
using Numbers = std::array<float, kFloats>;

/// One of the file's textures by the name that a material uses; each is kept once.
class Textures {
 public:
  Textures(const aiScene& scene, RawModel& out) : scene_(scene), out_(out) {}

  std::int32_t add(const std::string& name) {
    if (name.empty()) return -1;
    const auto [at, is_new] = known_.try_emplace(name, static_cast<std::int32_t>(out_.textures.size()));
    if (!is_new) return at->second;
    ImportedTexture texture;
    texture.name = out_.text.size(), texture.name_size = name.size();
    out_.text += name;
    texture.bytes = out_.text.size();
    const aiTexture* const inside = scene_.GetEmbeddedTexture(name.c_str());
    if (inside != nullptr && inside->mHeight == 0) {  // compressed: mWidth bytes
      texture.bytes_size = inside->mWidth;
      out_.text.append(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    }
    out_.textures.push_back(texture);
    return at->second;
  }

 private:
  const aiScene& scene_;
  RawModel& out_;
  std::map<std::string, std::int32_t> known_;
};

std::string textureOf(const aiMaterial& material, std::initializer_list<aiTextureType> types) {
  for (const aiTextureType type : types) {
    aiString name;
    if (material.GetTexture(type, 0, &name) == aiReturn_SUCCESS && name.length > 0) return name.C_Str();
  }
  return {};
}

/// OBJ names colours and maps of Phong's model; glTF and its relatives have metal and roughness.
ImportedMaterial materialOf(const aiMaterial& from, bool is_obj, Textures& textures) {
  ImportedMaterial material;
  aiColor4D color(1, 1, 1, 1);
  if (is_obj || from.Get(AI_MATKEY_BASE_COLOR, color) != aiReturn_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  material.color_map = textures.add(textureOf(from, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}));
  const bool only_the_map = is_obj && material.color_map >= 0;  // exporters leave any colour beside a map
  if (!only_the_map) material.color[0] = color.r, material.color[1] = color.g, material.color[2] = color.b;
  material.normal_map =
      textures.add(textureOf(from, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT}));
  material.roughness_map = textures.add(textureOf(from, {aiTextureType_UNKNOWN, aiTextureType_DIFFUSE_ROUGHNESS}));
  if (!is_obj) {
    from.Get(AI_MATKEY_ROUGHNESS_FACTOR, material.roughness);
    from.Get(AI_MATKEY_METALLIC_FACTOR, material.metallic);
    from.Get(AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0), material.relief);
  } else {
    from.Get(AI_MATKEY_BUMPSCALING, material.relief);
    if (material.roughness_map >= 0) material.roughness = 1;
  }
  for (float* const share : {&material.roughness, &material.metallic})
    *share = std::isfinite(*share) ? std::clamp(*share, 0.0F, 1.0F) : 1;
  if (!std::isfinite(material.relief)) material.relief = 1;
  for (float& c : material.color) c = std::isfinite(c) ? std::clamp(c, 0.0F, 1.0F) : 1;
  return material;
}

bool hasMaps(const ImportedMaterial& m) { return m.color_map >= 0 || m.normal_map >= 0 || m.roughness_map >= 0; }

/// Assimp gives meshes without a material one of its own, of a grey or white.
bool says(const aiMaterial& from, const ImportedMaterial& material, const std::string& extension) {
  if (hasMaps(material)) return true;
  if (extension == "ply" || extension == "stl") return false;
  if (extension != "gltf" && extension != "glb") return from.GetName() != aiString(AI_DEFAULT_MATERIAL_NAME);
  return std::ranges::any_of(material.color, [](float c) { return c != 1; });
}

struct Placement {
  aiMatrix4x4 points;
  aiMatrix3x3 normals;  ///< inverse and transposed
  bool mirrored = false;
  explicit Placement(const aiMatrix4x4& m) : points(m), normals(m), mirrored(m.Determinant() < 0) {
    if (normals.Determinant() != 0) normals.Inverse().Transpose();
  }
};

class ModelReader {
 public:
  ModelReader(const aiScene& scene, std::string extension, bool z_up, RawModel& out)
      : scene_(scene), extension_(std::move(extension)), z_up_(z_up), out_(out) {}

  void run() {
    Textures textures(scene_, out_);
    bool colored = false;
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      out_.materials.push_back(materialOf(*scene_.mMaterials[i], extension_ == "obj", textures));
      speaks_.push_back(says(*scene_.mMaterials[i], out_.materials.back(), extension_));
    }
    // a copy of each material without maps, for meshes without texture coordinates
    const std::size_t count = out_.materials.size();
    for (std::size_t i = 0; i < count; ++i) {
      ImportedMaterial plain = out_.materials[i];
      plain.unmapped = hasMaps(plain) ? 1 : 0;
      plain.color_map = plain.normal_map = plain.roughness_map = -1;
      out_.materials.push_back(plain);
    }
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) {
      const aiMesh& mesh = *scene_.mMeshes[m];
      colored = colored || mesh.HasVertexColors(0) || (mesh.mMaterialIndex < count && speaks_[mesh.mMaterialIndex]);
    }
    if (colored && scene_.mRootNode != nullptr) place(*scene_.mRootNode, aiMatrix4x4());
    if (places_.empty()) {
      out_ = {};
      return;
    }
    append();
    dropUnusedTextures();
  }

 private:
  struct Place {
    const aiMesh* mesh;
    aiMatrix4x4 placement;
    std::uint32_t material;
  };

  void place(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 placement = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      if (mesh.mMaterialIndex >= scene_.mNumMaterials) continue;
      const std::uint32_t plain = mesh.HasTextureCoords(0) ? 0 : scene_.mNumMaterials;
      places_.push_back({&mesh, placement, mesh.mMaterialIndex + plain});
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], placement);
  }

  /// All meshes of one material make one part.
  void append() {
    std::ranges::stable_sort(places_, {}, &Place::material);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (i == 0 || places_[i].material != places_[i - 1].material)
        out_.parts.push_back({static_cast<std::uint32_t>(out_.vertices.size() / kFloats), 0,
                              static_cast<std::uint32_t>(out_.corners.size()), 0, places_[i].material});
      append(*places_[i].mesh, Placement(places_[i].placement));
      ImportedPart& part = out_.parts.back();
      part.vertex_count = static_cast<std::uint32_t>(out_.vertices.size() / kFloats) - part.first_vertex;
      part.corner_count = static_cast<std::uint32_t>(out_.corners.size()) - part.first_corner;
    }
  }

  /// Textures of materials that no part has are not looked for.
  void dropUnusedTextures() {
    std::vector<std::int32_t> number(out_.textures.size(), -1);
    std::vector<ImportedTexture> used;
    for (const ImportedPart& part : out_.parts) {
      ImportedMaterial& material = out_.materials[part.material];
      for (std::int32_t* const map : {&material.color_map, &material.normal_map, &material.roughness_map}) {
        if (*map < 0) continue;
        std::int32_t& kept = number[static_cast<std::size_t>(*map)];
        if (kept < 0) {
          kept = static_cast<std::int32_t>(used.size());
          used.push_back(out_.textures[static_cast<std::size_t>(*map)]);
        }
        *map = kept;
      }
    }
    out_.textures = std::move(used);
  }

  void append(const aiMesh& mesh, const Placement& placement) {
    if (out_.vertices.size() / kFloats + mesh.mNumVertices > std::size_t{std::numeric_limits<std::int32_t>::max()})
      throw std::bad_alloc();
    const auto at = [&](unsigned v) { return numbersOf(mesh, v, placement); };
    EqualVertices<kFloats, decltype(at)> equal(mesh.mNumVertices, at);
    std::vector<std::uint32_t> numbers(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const unsigned first = equal.firstOf(v);
      numbers[v] = first == v ? static_cast<std::uint32_t>(out_.vertices.size() / kFloats) : numbers[first];
      if (first != v) continue;
      const Numbers all = at(v);
      out_.vertices.insert(out_.vertices.end(), all.begin(), all.end());
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned i = 2; i < face.mNumIndices; ++i) {
        std::array<std::uint32_t, 3> corners{numbers[face.mIndices[0]], numbers[face.mIndices[i - 1]],
                                             numbers[face.mIndices[i]]};
        if (placement.mirrored) std::swap(corners[1], corners[2]);
        out_.corners.insert(out_.corners.end(), corners.begin(), corners.end());
      }
    }
  }

  Numbers numbersOf(const aiMesh& mesh, unsigned v, const Placement& placement) const {
    Numbers all{};
    const auto put = [&](std::size_t at, const aiVector3D& p) {
      all[at] = p.x;
      all[at + 1] = z_up_ ? 0.0F - p.z : p.y;  // no negative zeros
      all[at + 2] = z_up_ ? p.y : p.z;
    };
    put(0, placement.points * mesh.mVertices[v]);
    if (mesh.HasNormals()) put(3, (placement.normals * mesh.mNormals[v]).NormalizeSafe());
    if (mesh.HasTextureCoords(0)) all[6] = mesh.mTextureCoords[0][v].x, all[7] = mesh.mTextureCoords[0][v].y;
    const bool has_colors = mesh.HasVertexColors(0);
    const aiColor4D c = has_colors ? mesh.mColors[0][v] : aiColor4D(1, 1, 1, 1);
    // glTF has linear colours; scanners write those of a display into PLY and OBJ
    const bool display = has_colors && (extension_ == "ply" || extension_ == "obj");
    const std::array<float, 3> color{c.r, c.g, c.b};
    for (std::size_t i = 0; i < 3; ++i) {
      const float bounded = std::isfinite(color[i]) ? std::clamp(color[i], 0.0F, 1.0F) : 1.0F;
      all[8 + i] = display ? static_cast<float>(srgb::toLinear(bounded)) : bounded;
    }
    for (float& number : all) number = std::isfinite(number) ? number : 0.0F;
    return all;
  }

  const aiScene& scene_;
  const std::string extension_;
  const bool z_up_;
  RawModel& out_;
  std::vector<bool> speaks_;
  std::vector<Place> places_;
};

}  // namespace

void readModel(const aiScene& scene, const std::string& extension, bool z_up, RawModel& out) {
  ModelReader(scene, extension, z_up, out).run();
}

}  // namespace presa
