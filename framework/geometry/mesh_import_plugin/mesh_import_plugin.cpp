#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "framework/geometry/mesh_import_abi.h"
#include "framework/geometry/mesh_import_plugin/isolation.h"
#include "framework/geometry/mesh_import_plugin/mesh_reader.h"

namespace presa {
namespace {

/// Memory limit of a reader: assimp needs less than 100 bytes for each byte of a file (less for ASCII formats), plus
/// its own tables. A header that claims more is wrong.
constexpr std::size_t kBaseMemory = 64u << 20;
constexpr std::size_t kMemoryPerByte = 100;
constexpr std::size_t kMaxMemory = std::size_t{6} << 30;
/// Processor time limit: a megabyte of text takes less than 1 s, several seconds under valgrind (`presa cost
/// --instructions`).
constexpr unsigned kBaseSeconds = 2;
constexpr unsigned kSecondsPerMegabyte = 4;

/// The result with the arrays that it points to.
struct OwnedMesh : ImportedMesh {
  explicit OwnedMesh(RawMesh mesh) : raw(std::move(mesh)) {
    problem = raw.problem.empty() ? nullptr : raw.problem.c_str();
    help = raw.help.empty() ? nullptr : raw.help.c_str();
    code = raw.code;
    coordinates = raw.coordinates.data();
    vertex_count = raw.coordinates.size() / 3;
    indices = raw.indices.data();
    triangle_count = raw.indices.size() / 3;
    ignored_faces = raw.ignored_faces;
    point(model, raw.model);
    attributes.names = raw.attributes.names.data(), attributes.names_size = raw.attributes.names.size();
    attributes.part_of = raw.attributes.part_of.data(), attributes.part_count = raw.attributes.part_of.size();
    attributes.grey = raw.attributes.grey.data(), attributes.grey_count = raw.attributes.grey.size();
  }
  static void point(ImportedModel& to, const RawModel& from) {
    to.vertices = from.vertices.data(), to.vertex_count = from.vertices.size() / ImportedModel::kFloats;
    to.corners = from.corners.data(), to.corner_count = from.corners.size();
    to.parts = from.parts.data(), to.part_count = from.parts.size();
    to.materials = from.materials.data();
    to.textures = from.textures.data(), to.texture_count = from.textures.size();
    to.text = from.text.data();
    to.missing_library = from.missing_library.empty() ? nullptr : from.missing_library.c_str();
  }
  RawMesh raw;
};

IsolationLimits limitsFor(const std::string& file) {
  std::error_code unknown;
  const std::uintmax_t found = std::filesystem::file_size(file, unknown);
  const std::uintmax_t size = unknown ? 0 : found;
  return {std::min(kBaseMemory + kMemoryPerByte * size, kMaxMemory),
          kBaseSeconds + kSecondsPerMegabyte * static_cast<unsigned>(size >> 20)};
}

/// By a child process on each core, to which the files are dealt in turn.
std::vector<RawMesh> importAll(std::span<const MeshFile> files) {
  std::vector<RawMesh> meshes(files.size());
  const std::size_t children = std::min<std::size_t>(files.size(), std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::vector<IsolatedRead>> groups(children);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const MeshFile& file = files[i];
    groups[i % children].push_back({limitsFor(file.file),
                                    [file](RawMesh& out) { readMesh(file.file, file.extension, file.wanted, out); },
                                    &meshes[i]});
  }
  runIsolated(groups);
  return meshes;
}

}  // namespace
}  // namespace presa

extern "C" __attribute__((visibility("default"))) void presaImportMeshes(const presa::MeshFile* files,
                                                                         std::uint64_t count,
                                                                         const presa::ImportedMesh** imported) {
  std::vector<std::unique_ptr<presa::OwnedMesh>> owned;
  for (presa::RawMesh& mesh : presa::importAll({files, count}))
    owned.push_back(std::make_unique<presa::OwnedMesh>(std::move(mesh)));
  for (std::unique_ptr<presa::OwnedMesh>& mesh : owned) *imported++ = mesh.release();
}

extern "C" __attribute__((visibility("default"))) void presaReleaseMesh(const presa::ImportedMesh* mesh) {
  delete static_cast<const presa::OwnedMesh*>(mesh);
}
