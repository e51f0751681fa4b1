#include "apps/temple/models/felt_cache.h"

#include <bit>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "apps/common/atomic_file.h"
#include "framework/core/math/fnv.h"
#include "framework/geometry/obj_text.h"
#include "framework/input/cache.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kTouchMeshVersion = 2;  // of touchMesh

std::string fileFor(const TriMesh& mesh, double max_error) {
  const std::string folder = input::cacheFolder("felt");
  if (folder.empty()) return {};
  Fnv1a hash;
  hash.addWord(kTouchMeshVersion);
  hash.addWord(std::bit_cast<std::uint64_t>(max_error));
  for (const Vec3& v : mesh.vertices)
    for (const double x : v) hash.addWord(std::bit_cast<std::uint64_t>(x));
  for (const TriMesh::Triangle& t : mesh.triangles)
    for (const std::int32_t corner : t) hash.addWord(static_cast<std::uint32_t>(corner));
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.obj", static_cast<unsigned long long>(hash.value()));
  return (fs::path(folder) / name).string();
}

/// None: there is no such file, or it is no closed mesh any more. Its distance is measured anew, which takes less time than
/// the search for the mesh.
FeltMesh readKept(const std::string& file, const TriMesh& mesh, double max_error) {
  std::error_code missing;
  if (file.empty() || !fs::exists(file, missing)) return {};
  Diagnostics ignored;
  TouchMesh kept{importMesh(file, {}, {}, ignored), {}, {}};
  if (ignored.hasErrors() || kept.mesh.triangles.empty()) return {};
  measureTouchMesh(kept, mesh, max_error);
  constexpr double kInFile = 1.01;  // a file rounds
  return kept.distance() <= kInFile * max_error ? FeltMesh{kept.mesh, kept.distance()} : FeltMesh{};
}

}  // namespace

FeltMesh feltMesh(const TriMesh& mesh, double max_error) {
  const std::string file = fileFor(mesh, max_error);
  FeltMesh felt = readKept(file, mesh, max_error);
  if (!felt.mesh.triangles.empty()) return felt;
  const TouchMesh made = touchMesh(mesh, max_error);
  try {
    if (!file.empty()) {
      fs::create_directories(fs::path(file).parent_path());
      writeFileAtomically(file, objText(made.mesh));
    }
    felt = readKept(file, mesh, max_error);  // the first start feels what later ones do
  } catch (const std::system_error&) {       // no cache
  }
  return felt.mesh.triangles.empty() ? FeltMesh{made.mesh, made.distance()} : felt;
}

}  // namespace presa::temple
