#include "framework/bus/mesh_store.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>

#include "framework/input/folders.h"
#include "framework/record/checksum/checksum.h"
#include "framework/scene/manifest.h"
#include "framework/scene/physics_shapes.h"

namespace presa::bus {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kDigits = 64;
constexpr std::size_t kMaxFiles = 20000;  // search limit per folder
constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 30U;

bool isMesh(const fs::directory_entry& entry) {
  static constexpr std::array kEndings{".obj", ".stl", ".ply", ".gltf", ".glb", ".dae"};
  std::error_code unknown;
  std::string ending = entry.path().extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kEndings, ending) != kEndings.end() && entry.is_regular_file(unknown) &&
         entry.file_size(unknown) <= kMaxBytes && !unknown;
}

/// Mesh files by checksum. Each file is read at most once, only when an unknown checksum is requested.
class MeshStore {
 public:
  explicit MeshStore(const std::vector<std::string>& folders) {
    std::error_code unknown;
    for (const std::string& folder : folders) {
      fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, unknown), end;
      for (std::size_t seen = 0; !unknown && at != end && seen < kMaxFiles; at.increment(unknown), ++seen)
        if (isMesh(*at)) unread_.push_back(at->path().string());
    }
    std::ranges::sort(unread_);
    std::ranges::reverse(unread_);
  }
  /// Path of the file with this checksum, or "".
  std::string find(const std::string& sum) {
    while (!found_.contains(sum) && !unread_.empty()) {
      const std::string file = std::move(unread_.back());
      unread_.pop_back();
      try {
        found_.try_emplace(sha256OfFile(file), file);
      } catch (const std::system_error&) {
        continue;  // deleted or not readable
      }
    }
    const auto at = found_.find(sum);
    return at != found_.end() ? at->second : std::string();
  }

 private:
  std::vector<std::string> unread_;
  std::map<std::string, std::string> found_;
};

/// A viewer makes no effects, so it needs none of the files that elements of plug-ins name.
void forgetPluginFiles(Scene& scene) {
  for (PluginElement& element : scene.plugin_elements) {
    const Manifest::Element* known = findElement(element.element);
    if (known == nullptr) continue;
    for (const Manifest::Attribute& attribute : known->attributes)
      if (attribute.type == "file") element.attributes[attribute.name].clear();
  }
}

std::string listOf(const std::vector<std::string>& folders) {
  std::string list;
  for (const std::string& folder : folders) list += (list.empty() ? "" : ", ") + folder;
  return list.empty() ? "no folder to search" : "looked in " + list;
}

}  // namespace

std::string sumsOfMeshes(const Scene& scene) {
  std::map<std::string, std::string> known;  // bodies share files
  std::string sums;
  for (const MeshRef* mesh : meshesOf(scene)) {
    const std::string& file = mesh->file;
    std::string& sum = known[file];
    try {
      if (sum.empty()) sum = sha256OfFile(file);
    } catch (const std::system_error&) {
      sum.assign(kDigits, '0');
    }
    sums += (sums.empty() ? "" : " ") + sum;
  }
  return sums;
}

void takeFromMeshStore(Scene& scene, const RunInfo& run, const std::vector<std::string>& folders,
                       Diagnostics& diagnostics) {
  forgetPluginFiles(scene);
  const std::vector<MeshRef*> meshes = meshesOf(scene);
  if (meshes.empty()) return;
  for (const std::string& folder : folders) input::allowFolder(folder);  // named by the user, not by the run
  MeshStore store(folders);
  std::istringstream sums(run.mesh_sums);
  std::map<std::string, bool> told;
  for (MeshRef* mesh : meshes) {
    const std::string named = std::exchange(mesh->file, {});
    std::string sum;
    sums >> sum;
    if (sum.size() == kDigits) mesh->file = store.find(sum);
    if (mesh->file.empty() && !std::exchange(told[named], true))
      diagnostics.error(
          755, {scene.file, 0, 0},
          "no local file equals the run's mesh " + quote(fs::path(named).filename().string()) +
              (sum.size() == kDigits ? ", SHA-256 " + quote(sum) : ", for which it sent no checksum") + " (" +
              listOf(folders) + ")",
          "copy the mesh to this machine and name its folder with --meshes DIR, or name the scene file itself");
  }
}

}  // namespace presa::bus
