#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <set>
#include <vector>

#include "framework/geometry/mesh_import_plugin/attribute_reader.h"
#include "framework/geometry/mesh_import_plugin/equal_vertices.h"
#include "framework/geometry/mesh_import_plugin/input_system.h"
#include "framework/geometry/mesh_import_plugin/model_reader.h"

namespace presa {
namespace {

/// Removes all readers but those of the extension. Otherwise assimp tries each of its 40-odd readers on a file that the
/// right one refuses.
void keepReadersOf(Assimp::Importer& importer, const std::string& extension) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* reader = importer.GetImporter(i);
    std::set<std::string> extensions;
    reader->GetExtensionList(extensions);
    if (extensions.contains(extension)) continue;
    importer.UnregisterLoader(reader);
    delete reader;  // unregistering hands over ownership
  }
}

bool indicesValid(const aiMesh& mesh) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    for (unsigned i = 0; i < mesh.mFaces[f].mNumIndices; ++i) {
      if (mesh.mFaces[f].mIndices[i] >= mesh.mNumVertices) return false;
    }
  }
  return true;
}

bool verticesFinite(const aiMesh& mesh) {
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const aiVector3D& p = mesh.mVertices[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  }
  return true;
}

/// Whether assimp may triangulate the polygons: it does not check indices and positions itself.
bool sound(const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    if (!indicesValid(*scene.mMeshes[m]) || !verticesFinite(*scene.mMeshes[m])) return false;
  }
  return true;
}

/// Position of a vertex in the scene, in double precision. A vertex that is not finite is returned untransformed, so
/// that the finding shows which coordinate is wrong.
std::array<double, 3> place(const aiMatrix4x4& m, const aiVector3D& v) {
  const double x = v.x, y = v.y, z = v.z;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) return {x, y, z};
  return {m.a1 * x + m.a2 * y + m.a3 * z + m.a4, m.b1 * x + m.b2 * y + m.b3 * z + m.b4,
          m.c1 * x + m.c2 * y + m.c3 * z + m.c4};
}

/// Appends one instance of a mesh, placed by the accumulated transforms of its node.
void append(const aiMesh& mesh, const aiMatrix4x4& placement, RawMesh& out) {
  if ((out.coordinates.size() / 3) + mesh.mNumVertices > std::size_t{std::numeric_limits<std::int32_t>::max()}) {
    throw std::bad_alloc();
  }
  const auto at = [&](unsigned v) {
    const aiVector3D& p = mesh.mVertices[v];
    return std::array<float, 3>{p.x, p.y, p.z};
  };
  EqualVertices<3, decltype(at)> equal(mesh.mNumVertices, at);
  std::vector<std::int32_t> numbers(mesh.mNumVertices);
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    const unsigned first = equal.firstOf(v);
    numbers[v] = first == v ? static_cast<std::int32_t>(out.coordinates.size() / 3) : numbers[first];
    if (first != v) continue;
    const std::array<double, 3> p = place(placement, mesh.mVertices[v]);
    out.coordinates.insert(out.coordinates.end(), p.begin(), p.end());
  }
  const auto number = [&](unsigned index) { return index < mesh.mNumVertices ? numbers[index] : -1; };  // -1: none
  const bool mirrored = placement.Determinant() < 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    out.ignored_faces += face.mNumIndices < 3;
    for (unsigned i = 2; i < face.mNumIndices; ++i) {
      const std::int32_t a = number(face.mIndices[0]), b = number(face.mIndices[i - 1]), c = number(face.mIndices[i]);
      out.indices.insert(out.indices.end(), {a, mirrored ? c : b, mirrored ? b : c});
    }
  }
}

void appendNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, RawMesh& out) {
  const aiMatrix4x4 placement = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) append(*scene.mMeshes[node.mMeshes[i]], placement, out);
  for (unsigned i = 0; i < node.mNumChildren; ++i) appendNode(scene, *node.mChildren[i], placement, out);
}

/// Assimp delivers glTF and COLLADA with y up (it turns COLLADA's own up axis to y and applies its unit).
void turnToZUp(std::vector<double>& coordinates) {
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    const double y = coordinates[i + 1], z = coordinates[i + 2];
    coordinates[i + 1] = 0.0 - z;  // no negative zeros
    coordinates[i + 2] = y;
  }
}

}  // namespace

void readMesh(const std::string& file, const std::string& extension, MeshWanted wanted, RawMesh& out) {
  InputSystem files(file);
  Assimp::Importer importer;
  keepReadersOf(importer, extension);
  importer.SetIOHandler(&files);
  const aiScene* scene = importer.ReadFile(file, 0);
  importer.SetIOHandler(nullptr);
  if (files.problem()) {
    out.code = files.problem()->code;
    out.problem = files.problem()->what;
    out.help = files.problem()->help;
    return;
  }
  const bool is_sound = scene != nullptr && sound(*scene);
  if (is_sound) scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (scene == nullptr) {
    const std::string reason = importer.GetErrorString();
    out.problem = reason.empty() ? "it cannot be read" : reason;
    return;
  }
  if (scene->mRootNode != nullptr) appendNode(*scene, *scene->mRootNode, aiMatrix4x4(), out);
  const bool z_up = extension == "dae" || extension == "gltf" || extension == "glb";
  if (z_up) turnToZUp(out.coordinates);
  if (!is_sound) return;
  if (wanted == MeshWanted::kAttributes) readAttributes(*scene, out.attributes);
  if (wanted != MeshWanted::kModel) return;
  readModel(*scene, extension, z_up, out.model);
  out.model.missing_library = files.missingLibrary();
}

}  // namespace presa
