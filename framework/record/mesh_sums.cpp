#include "framework/record/mesh_sums.h"

#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "framework/plugin/plugin_loader.h"
#include "framework/record/checksum/checksum.h"
#include "framework/scene/physics_shapes.h"

namespace presa {
namespace {

constexpr std::size_t kMaxListBytes = 60'000;  // an attribute of HDF5 holds 64 KiB

std::string linesOf(const Scene& scene) {
  std::set<std::string> files;
  for (const MeshRef* mesh : meshesOf(scene)) files.insert(mesh->file);
  std::string lines;
  for (const std::string& file : files) {
    std::error_code missing;
    const bool there = std::filesystem::is_regular_file(file, missing);
    lines += (there ? sha256OfFile(file) : "missing") + ' ' + file + '\n';
  }
  return lines;
}

/// By file.
std::map<std::string, std::string> read(const std::string& sums) {
  std::map<std::string, std::string> by_file;
  std::istringstream lines(sums);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    if (blank != std::string::npos) by_file[line.substr(blank + 1)] = line.substr(0, blank);
  }
  return by_file;
}

}  // namespace

std::string meshSumsOf(const Scene& scene) {
  const std::string lines = linesOf(scene);
  return lines.size() <= kMaxListBytes ? lines : sha256OfText(lines) + " *\n";
}

std::vector<std::string> changedMeshes(const std::string& recording, const Scene& scene) {
  using Read = void (*)(const std::string&, std::string&);
  std::string recorded;
  reinterpret_cast<Read>(pluginSymbol("record", "presaRecordedMeshSums"))(recording, recorded);
  if (recorded.empty()) return {};
  const auto now = read(meshSumsOf(scene));
  std::vector<std::string> changed;
  for (const auto& [file, sum] : read(recorded)) {
    const auto found = now.find(file);
    if (found != now.end() && found->second == sum) continue;
    changed.push_back((file == "*" ? "one of the meshes" : "the mesh '" + file + "'") +
                      " is not the one of the run: SHA-256 " + (found == now.end() ? "unknown" : found->second) +
                      ", recorded " + sum);
  }
  return changed;
}

}  // namespace presa
