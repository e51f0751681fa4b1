#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "experiments/faults/hold.h"
#include "experiments/faults/scene_faults.h"
#include "experiments/faults/temporary_file.h"
#include "framework/geometry/tri_mesh.h"

namespace presa::faults {
namespace {

constexpr double kLimit = 8;  // of the scene [N]

template <class T>
std::string bytes(T value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

/// `claimed`: number of faces stated in the header, which may differ from the actual number.
std::string asPly(const TriMesh& mesh, std::size_t claimed) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << claimed
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& v : mesh.vertices) out << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

std::string asObj(const TriMesh& mesh) {
  std::ostringstream out;
  for (const Vec3& v : mesh.vertices) out << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

/// STL has no indices: a corner with an invalid index gets NaN coordinates.
std::string asStl(const TriMesh& mesh, std::size_t claimed) {
  std::string out(80, 'x');
  out += bytes(static_cast<std::uint32_t>(claimed));
  for (const auto& t : mesh.triangles) {
    out += std::string(12, '\0');
    for (const std::int32_t i : t) {
      const bool there = i >= 0 && static_cast<std::size_t>(i) < mesh.vertices.size();
      for (int axis = 0; axis < 3; ++axis) {
        const double value =
            there ? mesh.vertices[static_cast<std::size_t>(i)][axis] : std::numeric_limits<double>::quiet_NaN();
        out += bytes(static_cast<float>(value));
      }
    }
    out += bytes(std::uint16_t{0});
  }
  return out;
}

/// Kinds of damage to a valid mesh.
enum class Damage : std::uint8_t {
  kNotFinite,
  kBadIndex,
  kZeroArea,
  kOpen,
  kDoubled,
  kFlipped,
  kClaimed,  // header claims ten million faces
  kBytes,    // from here on the result may still be a valid mesh
  kTruncated,
  kNoise,
  kCount,
};

void damage(TriMesh& mesh, Damage kind, RandomStream& random) {
  const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random.below(count)); };
  const auto corner = [&]() -> std::int32_t& { return mesh.triangles[any(mesh.triangles.size())][any(3)]; };
  for (std::uint64_t n = 1 + random.below(12); n > 0; --n) {
    if (kind == Damage::kNotFinite) {
      static constexpr std::array kValues{std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity(), -1e300};
      mesh.vertices[static_cast<std::size_t>(corner())][static_cast<int>(any(3))] = kValues[any(3)];
    } else if (kind == Damage::kBadIndex) {
      static constexpr std::array<std::int32_t, 4> kIndices{-2, 1'000'000, 2'147'483'000, -2'147'483'000};
      corner() = kIndices[any(4)];
    } else if (kind == Damage::kZeroArea) {
      auto triangle = mesh.triangles[any(mesh.triangles.size())];
      triangle[2] = triangle[1];
      mesh.triangles.push_back(triangle);
    } else if (kind == Damage::kOpen) {
      mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(any(mesh.triangles.size())));
    } else if (kind == Damage::kDoubled) {
      mesh.triangles.push_back(mesh.triangles[any(mesh.triangles.size())]);
    } else if (kind == Damage::kFlipped) {
      auto& triangle = mesh.triangles[any(mesh.triangles.size())];
      std::swap(triangle[0], triangle[1]);
      return;  // a second swap could undo the first
    }
  }
}

void damage(std::string& file, Damage kind, RandomStream& random) {
  if (kind == Damage::kTruncated) file.resize(random.below(file.size()));
  if (kind == Damage::kBytes) {
    for (std::uint64_t n = 1 + random.below(20); n > 0; --n)
      file[random.below(file.size())] = static_cast<char>(random.below(256));
  }
  if (kind == Damage::kNoise) {
    for (char& c : file) c = static_cast<char>(random.below(256));
  }
}

/// A damaged mesh must be reported.
void requireFinding(const TemporaryFile& file, Damage kind, Outcome& outcome) {
  Diagnostics findings;
  const TriMesh mesh = importMesh(file.path(), {}, {"scene.xml", 1, 1}, findings);
  if (mesh.triangles.empty() != findings.hasErrors()) outcome.broken.emplace_back("partly loaded");
  if (kind < Damage::kBytes && findings.all().empty()) outcome.broken.emplace_back("the damage was not reported");
  for (const Diagnostic& finding : findings.all()) {
    if (finding.message.empty()) outcome.broken.emplace_back("a finding without a message");
  }
}

}  // namespace

Outcome corruptMesh(RandomStream& random) {
  const auto kind = static_cast<Damage>(random.below(static_cast<std::uint64_t>(Damage::kCount)));
  TriMesh mesh = makeSphere(0.04, 2);
  damage(mesh, kind, random);
  const std::size_t claimed = kind == Damage::kClaimed ? 10'000'000 : mesh.triangles.size();
  const std::uint64_t format = kind == Damage::kClaimed ? random.below(2) : random.below(3);
  std::string contents = format == 0 ? asPly(mesh, claimed) : format == 1 ? asStl(mesh, claimed) : asObj(mesh);
  damage(contents, kind, random);
  static constexpr std::array kEndings{".ply", ".stl", ".obj"};
  const TemporaryFile file(contents, kEndings[format]);

  Outcome outcome;
  requireFinding(file, kind, outcome);
  Hold hold;
  hold.sets = {"body/cube/haptic/mesh/file=" + file.path()};
  hold.end = 1.1;
  try {
    runHold(hold, [&](double, const Traffic& traffic) {
      requireBounded(traffic, kLimit, outcome);
      outcome.step = traffic.step;
    });
  } catch (const InputError& refused) {
    if (refused.diagnostics().errorCount() == 0) outcome.broken.emplace_back("refused without a message");
  }
  return outcome;
}

}  // namespace presa::faults
