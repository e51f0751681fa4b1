#include "modules/pointshell/field_cache.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/core/math/fnv.h"
#include "framework/geometry/mesh_distance.h"
#include "framework/input/cache.h"
#include "framework/input/input.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLong{200};  // what takes longer is kept for the next load
constexpr std::uintmax_t kMost = 256U << 20U;    // of all fields in the cache [bytes]

/// "" when the user has no cache folder.
std::string fileOf(const TriMesh& mesh, double thickness, const DistanceField::Settings& settings) {
  const std::string folder = input::cacheFolder("fields");
  if (folder.empty()) return {};
  Fnv1a hash;
  hash.addWord(std::bit_cast<std::uint64_t>(settings.voxel));
  hash.addWord(std::bit_cast<std::uint64_t>(settings.band));
  if (thickness > 0) hash.addWord(std::bit_cast<std::uint64_t>(thickness));
  for (const Vec3& v : mesh.vertices) {
    for (const double x : v) hash.addWord(std::bit_cast<std::uint64_t>(x));
  }
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) hash.addWord(static_cast<std::uint32_t>(corner));
  }
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.field", static_cast<unsigned long long>(hash.value()));
  return (fs::path(folder) / name).string();
}

// The sum comes first, so that damage inside of a number is seen, too.
std::uint64_t sumOf(const std::string& bytes) {
  Fnv1a hash;
  hash.add(std::string_view(bytes));
  return hash.value();
}

std::optional<DistanceField> readField(const std::string& file, std::size_t max_bytes) {
  input::Refusal refusal;
  std::optional<std::string> bytes = input::read(file, max_bytes + sizeof(std::uint64_t) + 4096, refusal);
  std::uint64_t sum = 0;
  if (!bytes || bytes->size() < sizeof sum) return std::nullopt;
  bytes->copy(reinterpret_cast<char*>(&sum), sizeof sum);
  bytes->erase(0, sizeof sum);
  return sumOf(*bytes) == sum ? DistanceField::fromBytes(*bytes) : std::nullopt;
}

/// The oldest fields make room.
void prune(const fs::path& folder) {
  std::error_code failure;
  std::vector<std::pair<fs::file_time_type, fs::path>> fields;
  std::uintmax_t total = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.path().extension() != ".field") continue;
    total += entry.file_size(failure);
    fields.emplace_back(entry.last_write_time(failure), entry.path());
  }
  std::sort(fields.begin(), fields.end());
  for (const auto& [time, file] : fields) {
    if (total <= kMost) break;
    const std::uintmax_t size = fs::file_size(file, failure);
    if (fs::remove(file, failure)) total -= std::min(total, size);
  }
}

void keepField(const std::string& file, const DistanceField& field) {
  if (file.empty()) return;
  std::error_code failure;
  fs::create_directories(fs::path(file).parent_path(), failure);
  const std::string part = file + "." + std::to_string(getpid()), bytes = field.bytes();
  const std::uint64_t sum = sumOf(bytes);
  std::ofstream out(part, std::ios::binary);
  out.write(reinterpret_cast<const char*>(&sum), sizeof sum);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (out) fs::rename(part, file, failure);
  if (!out || failure) fs::remove(part, failure);
  prune(fs::path(file).parent_path());
}

}  // namespace

std::optional<DistanceField> cachedField(const TriMesh& mesh, double thickness, const DistanceField::Settings& settings,
                                         DistanceField::Size& size) {
  const std::string file = fileOf(mesh, thickness, settings);
  if (std::optional<DistanceField> known = readField(file, settings.max_bytes)) return known;
  const auto start = std::chrono::steady_clock::now();
  const MeshDistance distance(mesh);
  const double half = thickness / 2;
  const auto solid = [&](const Vec3& p, double bound) { return distance(p, bound); };
  const auto shell = [&](const Vec3& p, double bound) { return std::abs(distance(p, bound + half)) - half; };
  AxisBox bounds = boundsOf(mesh);
  bounds.low.array() -= half;
  bounds.high.array() += half;
  std::optional<DistanceField> field = thickness > 0 ? DistanceField::build(shell, bounds, settings, &size)
                                                     : DistanceField::build(solid, bounds, settings, &size);
  if (field && std::chrono::steady_clock::now() - start > kLong) keepField(file, *field);
  if (field && settings.go_on && !settings.go_on(1)) return std::nullopt;
  return field;
}

}  // namespace presa
