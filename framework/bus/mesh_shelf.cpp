#include "framework/bus/mesh_shelf.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>

#include "framework/record/checksum/checksum.h"
#include "framework/input/folders.h"
#include "framework/scene/load.h"

namespace presa::bus {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kDigits = 64;
constexpr std::size_t kMostFiles = 20000;  // a folder with more holds no meshes alone
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 30U;

bool isMesh(const fs::directory_entry& entry) {
  static constexpr std::array kEndings{".obj", ".stl", ".ply", ".gltf", ".glb", ".dae"};
  std::error_code unknown;
  std::string ending = entry.path().extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::ranges::find(kEndings, ending) != kEndings.end() && entry.is_regular_file(unknown) &&
         entry.file_size(unknown) <= kMostBytes && !unknown;
}

/// Files by their sums; each is read once, when it is asked for something that was not found before.
class Shelf {
 public:
  explicit Shelf(const std::vector<std::string>& folders) {
    std::error_code unknown;
    for (const std::string& folder : folders) {
      fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, unknown), end;
      for (std::size_t seen = 0; !unknown && at != end && seen < kMostFiles; at.increment(unknown), ++seen)
        if (isMesh(*at)) unread_.push_back(at->path().string());
    }
    std::ranges::sort(unread_);
    std::ranges::reverse(unread_);
  }
  /// Empty: there is none.
  std::string find(const std::string& sum) {
    while (!found_.contains(sum) && !unread_.empty()) {
      const std::string file = std::move(unread_.back());
      unread_.pop_back();
      try {
        found_.try_emplace(sha256OfFile(file), file);
      } catch (const std::system_error&) {
        continue;  // gone, or not ours to read
      }
    }
    const auto at = found_.find(sum);
    return at != found_.end() ? at->second : std::string();
  }

 private:
  std::vector<std::string> unread_;
  std::map<std::string, std::string> found_;
};

std::vector<MeshRef*> meshesOf(Scene& scene) {
  std::vector<MeshRef*> meshes;  // as filesNamedBy
  for (Body& body : scene.bodies) {
    for (auto* geometry : {&body.visual, &body.haptic, &body.physics}) {
      if (!geometry->has_value()) continue;
      if (auto* mesh = std::get_if<MeshRef>(&(*geometry)->shape)) meshes.push_back(mesh);
    }
  }
  return meshes;
}

std::string listOf(const std::vector<std::string>& folders) {
  std::string list;
  for (const std::string& folder : folders) list += (list.empty() ? "" : ", ") + folder;
  return list.empty() ? "no folder is allowed" : "looked in " + list;
}

}  // namespace

std::string sumsOfMeshes(const Scene& scene) {
  std::map<std::string, std::string> known;  // bodies share files
  std::string sums;
  for (const std::string& file : filesNamedBy(scene)) {
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

void takeFromShelf(Scene& scene, const RunInfo& run, const std::vector<std::string>& folders,
                   Diagnostics& diagnostics) {
  const std::vector<MeshRef*> meshes = meshesOf(scene);
  if (meshes.empty()) return;
  for (const std::string& folder : folders) input::allowFolder(folder);  // the user named them, not the run
  Shelf shelf(folders);
  std::istringstream sums(run.mesh_sums);
  std::map<std::string, bool> told;
  for (MeshRef* mesh : meshes) {
    const std::string named = std::exchange(mesh->file, {});
    std::string sum;
    sums >> sum;
    if (sum.size() == kDigits) mesh->file = shelf.find(sum);
    if (mesh->file.empty() && !std::exchange(told[named], true))
      diagnostics.error(755, {scene.file, 0, 0},
                        "no mesh here is the run's " + quote(fs::path(named).filename().string()) +
                            (sum.size() == kDigits ? ", SHA-256 " + quote(sum) : ", of which it sent no checksum") +
                            " (" + listOf(folders) + ")",
                        "copy the file here; --meshes DIR says where, or name the scene file itself");
  }
}

}  // namespace presa::bus
