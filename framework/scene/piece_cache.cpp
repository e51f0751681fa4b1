#include "framework/scene/piece_cache.h"

#include <unistd.h>

#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "framework/core/math/fnv.h"
#include "framework/geometry/convex.h"
#include "framework/geometry/long_work.h"
#include "framework/input/cache.h"
#include "framework/input/input.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kKind = 0x3165636569507250;  // "PrPiece1": also the version of decompose()
constexpr std::chrono::milliseconds kLong{500};      // a cut that takes longer is kept for the next load
constexpr double kCutting = 0.9;                     // share of the time; the rest is for its error
constexpr std::uint64_t kMostPieces = 256, kMostCorners = 100000, kMostBytes = 1U << 28U;

void add(Fnv1a& hash, double value) { hash.addWord(std::bit_cast<std::uint64_t>(value)); }

template <class Value>
void put(std::ofstream& out, const Value& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

/// What is left to read.
class Bytes {
 public:
  explicit Bytes(std::string_view left) : left_(left) {}
  template <class Value>
  bool get(Value& value) {
    if (left_.size() < sizeof value) return false;
    std::memcpy(&value, left_.data(), sizeof value);
    left_.remove_prefix(sizeof value);
    return true;
  }
  std::size_t size() const { return left_.size(); }

 private:
  std::string_view left_;
};

bool getPiece(Bytes& in, TriMesh& piece) {
  std::uint64_t vertices = 0, triangles = 0;
  if (!in.get(vertices) || !in.get(triangles) || vertices > kMostCorners || triangles > kMostCorners) return false;
  if (24 * vertices + 12 * triangles > in.size()) return false;
  piece.vertices.resize(vertices);
  piece.triangles.resize(triangles);
  for (Vec3& v : piece.vertices) {
    for (double& x : v) {
      if (!in.get(x)) return false;
    }
  }
  for (TriMesh::Triangle& triangle : piece.triangles) {
    for (std::int32_t& corner : triangle) {
      if (!in.get(corner) || corner < 0 || static_cast<std::uint64_t>(corner) >= vertices) return false;
    }
  }
  buildAdjacency(piece);
  const MeshReport report = checkMesh(piece);
  return report.non_finite == 0 && report.closed() && !report.inverted && isConvex(piece);
}

}  // namespace

std::string pieceCacheFile(const TriMesh& mesh, const Decomposition& wanted) {
  const std::string folder = input::cacheFolder("convex");
  if (folder.empty()) return {};
  Fnv1a hash;
  hash.addWord(kKind);
  hash.addWord(std::uint64_t{wanted.max_pieces});
  add(hash, wanted.max_error);
  for (const Vec3& v : mesh.vertices) {
    for (const double x : v) add(hash, x);
  }
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) hash.addWord(static_cast<std::uint32_t>(corner));
  }
  char name[40];
  std::snprintf(name, sizeof name, "%016llx.pieces", static_cast<unsigned long long>(hash.value()));
  return (fs::path(folder) / name).string();
}

std::optional<ConvexPieces> readPieces(const std::string& file) {
  input::Refusal refusal;
  const std::optional<std::string> bytes = input::read(file, kMostBytes, refusal);
  if (!bytes) return std::nullopt;
  Bytes in(*bytes);
  std::uint64_t kind = 0, count = 0;
  ConvexPieces pieces;
  if (!in.get(kind) || kind != kKind || !in.get(pieces.error) || !in.get(count)) return std::nullopt;
  if (count == 0 || count > kMostPieces || !(pieces.error >= 0)) return std::nullopt;
  for (std::uint64_t i = 0; i < count; ++i) {
    auto piece = std::make_shared<TriMesh>();
    if (!getPiece(in, *piece)) return std::nullopt;
    pieces.pieces.push_back(std::move(piece));
  }
  return in.size() == 0 ? std::optional(std::move(pieces)) : std::nullopt;
}

void keepPieces(const std::string& file, const ConvexPieces& pieces) {
  if (file.empty()) return;
  std::error_code failure;
  fs::create_directories(fs::path(file).parent_path(), failure);
  const std::string part = file + "." + std::to_string(getpid());
  {
    std::ofstream out(part, std::ios::binary);
    put(out, kKind);
    put(out, pieces.error);
    put(out, std::uint64_t{pieces.pieces.size()});
    for (const auto& piece : pieces.pieces) {
      put(out, std::uint64_t{piece->vertices.size()});
      put(out, std::uint64_t{piece->triangles.size()});
      for (const Vec3& v : piece->vertices) {
        for (const double x : v) put(out, x);
      }
      for (const TriMesh::Triangle& triangle : piece->triangles) {
        for (const std::int32_t corner : triangle) put(out, corner);
      }
    }
    out.close();
    if (out) {
      fs::rename(part, file, failure);
      if (!failure) return;
    }
  }
  fs::remove(part, failure);
}

ConvexPieces cutIntoPieces(const TriMesh& mesh, const Decomposition& wanted) {
  const std::string file = pieceCacheFile(mesh, wanted);
  if (std::optional<ConvexPieces> known = readPieces(file)) return std::move(*known);
  const auto start = std::chrono::steady_clock::now();
  ConvexPieces cut;
  const GoOn told =
      toldToListener("convex pieces of a mesh of " + std::to_string(mesh.triangles.size()) + " triangles");
  bool stopped = false;
  const GoOn go_on = [&](double share) { return !(stopped = stopped || (told && !told(share))); };
  const std::vector<TriMesh> pieces =
      decompose(mesh, wanted.max_pieces, wanted.max_error, [&](double share) { return go_on(kCutting * share); });
  if (stopped) throw WorkStopped();
  cut.error = hausdorffDistance(mesh, pieces);
  for (const TriMesh& piece : pieces) cut.pieces.push_back(std::make_shared<const TriMesh>(piece));
  if (!go_on(1)) throw WorkStopped();
  if (std::chrono::steady_clock::now() - start > kLong) keepPieces(file, cut);
  return cut;
}

}  // namespace presa
