#include "framework/geometry/mesh_import_plugin/attribute_reader.h"

#include <assimp/material.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace presa {
namespace {

class AttributeReader {
 public:
  AttributeReader(const aiScene& scene, RawAttributes& out) : scene_(scene), out_(out) {}

  void run() {
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) colored_ = colored_ || scene_.mMeshes[m]->HasVertexColors(0);
    if (scene_.mRootNode != nullptr) walk(*scene_.mRootNode, aiMatrix4x4());
  }

 private:
  void walk(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 placement = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      append(*scene_.mMeshes[node.mMeshes[i]], placement.Determinant() < 0);
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], placement);
  }

  void append(const aiMesh& mesh, bool mirrored) {
    const std::int32_t part = partOf(mesh);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      for (unsigned i = 2; i < face.mNumIndices; ++i) {
        out_.part_of.push_back(part);
        if (!colored_) continue;
        std::array<float, 3> grey{greyOf(mesh, face.mIndices[0]), greyOf(mesh, face.mIndices[i - 1]),
                                  greyOf(mesh, face.mIndices[i])};
        if (mirrored) std::swap(grey[1], grey[2]);
        out_.grey.insert(out_.grey.end(), grey.begin(), grey.end());
      }
    }
  }

  /// Assimp gives meshes without a material one without a name, or of its own name.
  std::int32_t partOf(const aiMesh& mesh) {
    if (mesh.mMaterialIndex >= scene_.mNumMaterials || mesh.mNumFaces == 0) return -1;
    const std::string name = scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str();
    if (name.empty() || name == AI_DEFAULT_MATERIAL_NAME) return -1;
    const auto [at, is_new] = known_.try_emplace(name, static_cast<std::int32_t>(known_.size()));
    if (is_new) out_.names.append(name.c_str(), name.size() + 1);
    return at->second;
  }

  static float greyOf(const aiMesh& mesh, unsigned v) {
    if (!mesh.HasVertexColors(0)) return 1;
    const aiColor4D& c = mesh.mColors[0][v];
    const float grey = 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
    return std::isfinite(grey) ? std::clamp(grey, 0.0F, 1.0F) : 1.0F;
  }

  const aiScene& scene_;
  RawAttributes& out_;
  bool colored_ = false;
  std::map<std::string, std::int32_t> known_;
};

}  // namespace

void readAttributes(const aiScene& scene, RawAttributes& out) { AttributeReader(scene, out).run(); }

}  // namespace presa
