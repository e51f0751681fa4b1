#include "framework/geometry/touch_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/geometry/convex.h"
#include "framework/geometry/decimate.h"

namespace presa {
namespace {

constexpr int kAttempts = 8;
constexpr double kKnownTo = 0.02;          // difference of the two bounds of a distance, relative to what is allowed
constexpr std::size_t kCutTriangles = 600;  // of the mesh that is cut into pieces: the time grows with their square
constexpr double kSampled = 1.0 / 150;      // longest edge between samples of pieces, relative to the mesh's size

/// What is left of `go_on` for a part of the work.
GoOn part(const GoOn& go_on, double begin, double end) {
  if (!go_on) return {};
  return [=](double share) { return go_on(begin + share * (end - begin)); };
}

double sizeOfMesh(const TriMesh& mesh) {
  const AxisBox box = boundsOf(mesh);
  return (box.high - box.low).norm();
}

/// Whether decimation has torn or folded nothing that was whole.
bool isAsWhole(const TriMesh& mesh, const MeshReport& original) {
  const MeshReport report = checkMesh(mesh);
  return report.non_manifold <= original.non_manifold && report.flipped_edges <= original.flipped_edges &&
         report.degenerate <= original.degenerate && report.inverted == original.inverted &&
         (report.open_edges == 0 || original.open_edges > 0);
}

/// The mesh with edges of up to `longest` [m]: long ones are halved, in both triangles alike.
TriMesh refined(TriMesh mesh, double longest) {
  std::vector<TriMesh::Triangle> todo = std::move(mesh.triangles), done;
  while (!todo.empty()) {
    const TriMesh::Triangle t = todo.back();
    todo.pop_back();
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i % 3])]; };
    std::size_t edge = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if ((at(i + 1) - at(i)).squaredNorm() > (at(edge + 1) - at(edge)).squaredNorm()) edge = i;
    if ((at(edge + 1) - at(edge)).norm() <= longest) {
      done.push_back(t);
      continue;
    }
    const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.push_back((at(edge) + at(edge + 1)) / 2);
    todo.push_back({t[edge], middle, t[(edge + 2) % 3]});
    todo.push_back({middle, t[(edge + 1) % 3], t[(edge + 2) % 3]});
  }
  mesh.triangles = std::move(done);
  return mesh;
}

}  // namespace

double TouchMesh::distance() const { return std::max(forth.high, back.high); }

TouchMesh touchMesh(const TriMesh& mesh, double max_error, const GoOn& go_on) {
  const MeshReport original = checkMesh(mesh);
  const double known_to = kKnownTo * max_error;
  double allowed = max_error;  // for the decimation, whose own measure is a mean
  for (int i = 0; i < kAttempts; ++i) {
    const auto share = [&](double of) { return (i + of) / kAttempts; };
    TouchMesh made{decimateMesh(mesh, 1, allowed), {}, {}};
    if (!isAsWhole(made.mesh, original)) {
      allowed /= 2;
      continue;
    }
    made.back = surfaceDistance(made.mesh, mesh, known_to, part(go_on, share(0), share(0.5)));
    made.forth = surfaceDistance(mesh, made.mesh, known_to, part(go_on, share(0.5), share(1)));
    if (std::isinf(made.distance())) return {};
    if (made.distance() <= max_error) {
      buildAdjacency(made.mesh);
      return made;
    }
    allowed *= std::clamp(0.9 * max_error / made.distance(), 0.2, 0.9);
  }
  return {mesh, {}, {}};
}

TouchPieces touchPieces(const TriMesh& mesh, std::size_t max_pieces, double max_error, const GoOn& go_on) {
  const MeshReport original = checkMesh(mesh);
  TriMesh coarse = decimateMesh(mesh, kCutTriangles);
  if (!isAsWhole(coarse, original)) coarse = mesh;
  TouchPieces made{decompose(coarse, max_pieces, max_error), 0, 0};
  if (go_on && !go_on(0.5)) return {};
  const double longest = kSampled * sizeOfMesh(mesh);
  std::vector<TriMesh> sampled;
  for (const TriMesh& piece : made.pieces) sampled.push_back(refined(piece, longest));
  made.low = hausdorffDistance(refined(mesh, longest), sampled);
  // no point is farther than this from a corner of its triangle
  made.high = made.low + longest / std::numbers::sqrt3;
  if (go_on && !go_on(1)) return {};
  return made;
}

}  // namespace presa
