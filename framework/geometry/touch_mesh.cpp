#include "framework/geometry/touch_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/geometry/convex.h"
#include "framework/geometry/decimate.h"
#include "framework/geometry/surface_tree.h"

namespace presa {
namespace {

// Bounds of a distance, relative to what is allowed: while the search asks only whether it is allowed, and at the end.
constexpr double kKnownTo = 0.02, kSearchFloor = 0.5, kFloor = 0.1;
constexpr double kNearEnough = 1.1;  // of the numbers of triangles between which the search ends
constexpr std::size_t kFewest = 8, kSteps = 10;
constexpr std::size_t kCutTriangles = 4000;  // of the mesh that is cut into pieces
constexpr double kSolidKnownTo = 1.0 / 500;  // difference of the bounds for pieces, relative to the mesh's size

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

/// volatile: of two such roundings side by side GCC 12 makes none from -O2 on, where it vectorises them.
double inSinglePrecision(double x) {
  const volatile float single = static_cast<float>(x);
  return static_cast<double>(single);
}

/// The piece as a file keeps it, in single precision. Narrow triangles may lean by that rounding, and the piece is convex no
/// more: then with fewer vertices, of which those that matter least for the shape are left out first.
TriMesh asInFile(const TriMesh& piece) {
  constexpr double kMargin = 2e-6;  // a fifth of what isConvex allows when the file is read
  constexpr double kApart = 1e-3;   // of vertices, relative to the piece's size: nearer ones only make narrow triangles
  const double apart = kApart * sizeOfMesh(piece);
  std::vector<Vec3> points;
  for (const Vec3& v : piece.vertices) {
    const Vec3 rounded{inSinglePrecision(v.x()), inSinglePrecision(v.y()), inSinglePrecision(v.z())};
    const auto is_near = [&](const Vec3& other) { return (other - rounded).norm() < apart; };
    if (std::ranges::none_of(points, is_near)) points.push_back(rounded);
  }
  for (std::size_t count = points.size(); count > 4; count -= std::max<std::size_t>(1, count / 8)) {
    const std::optional<TriMesh> hull = convexHull(points, count);
    if (hull && degenerateTriangles(*hull) == 0 && isConvex(*hull, kMargin)) return *hull;
  }
  return piece;
}

/// Distance from a solid.
double distanceFrom(const SurfaceTree& tree, const Vec3& p) {
  return tree.isInside(p) ? 0 : std::sqrt(tree.squaredDistance(p, 1e300));
}

/// Distances of the surface from the pieces, and of the pieces from the solid in the surface; false: told to stop.
bool measure(const TriMesh& mesh, TouchPieces& made, const GoOn& go_on) {
  const double known_to = kSolidKnownTo * sizeOfMesh(mesh);
  bool stopped = false;
  const GoOn told = [&](double) { return !(stopped = stopped || (go_on && !go_on(0.5))); };
  std::vector<SurfaceTree> trees(made.pieces.begin(), made.pieces.end());
  made.forth = largestDistance(
      mesh,
      [&](const Vec3& p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const SurfaceTree& tree : trees) nearest = std::min(nearest, distanceFrom(tree, p));
        return nearest;
      },
      known_to, told);
  const SurfaceTree whole(mesh);
  for (const TriMesh& piece : made.pieces) {
    const auto found = largestDistance(
        piece, [&](const Vec3& p) { return distanceFrom(whole, p); }, known_to, told);
    made.back = {std::max(made.back.low, found.low), std::max(made.back.high, found.high)};
  }
  return !stopped;
}

}  // namespace

double TouchMesh::distance() const { return std::max(forth.high, back.high); }

void measureTouchMesh(TouchMesh& made, const TriMesh& mesh, double max_error, const GoOn& go_on) {
  const DistanceWanted known{.tolerance = kKnownTo * max_error, .floor = kFloor * max_error};
  made.back = surfaceDistance(made.mesh, mesh, known, go_on);
  made.forth = surfaceDistance(mesh, made.mesh, known, go_on);
}

TouchMesh touchMesh(const TriMesh& mesh, double max_error, const GoOn& go_on) {
  const MeshReport original = checkMesh(mesh);
  const DistanceWanted searched{kKnownTo * max_error, kSearchFloor * max_error, max_error};
  TouchMesh best{mesh, {}, {}};
  // the distance falls as the triangles grow in number: the search halves the interval of their logarithm
  double few = static_cast<double>(kFewest), enough = static_cast<double>(mesh.triangles.size());
  bool stopped = false;
  for (std::size_t step = 0; step < kSteps && enough > kNearEnough * few && !stopped; ++step) {
    const auto told = [&](double begin) {
      return GoOn([&, begin](double share) {
        const double done = (static_cast<double>(step) + begin + share / 2) / static_cast<double>(kSteps);
        stopped = stopped || (go_on && !go_on(done));
        return !stopped;
      });
    };
    const double wanted = std::sqrt(few * enough);
    TouchMesh made{decimateMesh(mesh, static_cast<std::size_t>(wanted)), {}, {}};
    bool good = isAsWhole(made.mesh, original);
    if (good) made.back = surfaceDistance(made.mesh, mesh, searched, told(0));
    good = good && made.back.high <= max_error;
    if (good) made.forth = surfaceDistance(mesh, made.mesh, searched, told(0.5));
    good = good && made.forth.high <= max_error && made.mesh.triangles.size() < best.mesh.triangles.size();
    if (good) best = std::move(made);
    (good ? enough : few) = wanted;
  }
  const GoOn last = [&](double) { return !(stopped = stopped || (go_on && !go_on(1))); };
  if (best.mesh.triangles.size() < mesh.triangles.size())  // else both distances are zero
    measureTouchMesh(best, mesh, max_error, last);
  if (stopped) return {};
  buildAdjacency(best.mesh);
  return best;
}

TouchPieces touchPieces(const TriMesh& mesh, std::size_t max_pieces, double max_error, const GoOn& go_on) {
  TriMesh coarse = decimateMesh(mesh, kCutTriangles);
  if (!isAsWhole(coarse, checkMesh(mesh))) coarse = mesh;
  TouchPieces made{
      decompose(coarse, max_pieces, max_error, [&](double share) { return !go_on || go_on(0.5 * share); }), {}, {}};
  for (TriMesh& piece : made.pieces) piece = asInFile(piece);
  if (go_on && !go_on(0.5)) return {};
  if (!measure(mesh, made, go_on) || (go_on && !go_on(1))) return {};
  return made;
}

}  // namespace presa
