#include "framework/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/surface_tree.h"

namespace presa {
namespace {

constexpr std::size_t kAskEvery = 4096;  // looks

using Corners = std::array<Vec3, 3>;

Corners cornersOf(const TriMesh& mesh, std::size_t triangle) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][i])];
  return corners;
}

double reachOf(const Corners& corners, const Vec3& middle) {
  double reach = 0;
  for (const Vec3& corner : corners) reach = std::max(reach, (corner - middle).norm());
  return reach;
}

/// The two bounds, and how triangles change them. `boundOf(corners, low)`: no point of the triangle is farther; raises
/// `low` to the distance of a point of it.
template <class BoundOf>
class DistanceSearch {
 public:
  DistanceSearch(const BoundOf& bound_of, const DistanceWanted& wanted, const GoOn& go_on)
      : bound_of_(bound_of), wanted_(wanted), go_on_(go_on) {}

  void raise(double low) { low_ = std::max(low_, low); }

  SurfaceDistance over(const TriMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size() && !ends(); ++t) {
      share_ = static_cast<double>(t) / static_cast<double>(mesh.triangles.size());
      look(cornersOf(mesh, t));
    }
    return {low_, ends() ? std::numeric_limits<double>::infinity() : std::max(low_, high_)};
  }

 private:
  bool ends() const { return stopped_ || low_ > wanted_.give_up; }

  /// Takes a triangle into the bounds, and halves it as often as that takes.
  void look(const Corners& corners) {
    if (go_on_ && looks_++ % kAskEvery == 0) stopped_ = stopped_ || !go_on_(share_);
    if (ends()) return;
    const double bound = bound_of_(corners, low_);
    if (bound <= std::max(low_ + wanted_.tolerance, wanted_.floor)) {
      high_ = std::max(high_, bound);
      return;
    }
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double here = (corners[(i + 1) % 3] - corners[i]).squaredNorm();
      if (here > length) length = here, longest = i;
    }
    const Vec3 &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
    const Vec3 middle = (a + b) / 2;
    look({a, middle, c});
    look({middle, b, c});
  }

  const BoundOf& bound_of_;
  const DistanceWanted& wanted_;
  const GoOn& go_on_;
  double low_ = 0, high_ = 0, share_ = 0;
  std::size_t looks_ = 0;
  bool stopped_ = false;
};

}  // namespace

SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, const DistanceWanted& wanted,
                                const GoOn& go_on) {
  const SurfaceTree tree(to);
  const auto bound_of = [&](const Corners& corners, double& low) {
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const Corners target = cornersOf(to, tree.nearest(middle));
    const PreparedTriangle prepared(target[0], target[1], target[2]);
    const double here = (middle - closestOnTriangle(middle, prepared)).norm();
    low = std::max(low, here);
    double convex = 0;
    for (const Vec3& corner : corners) convex = std::max(convex, (corner - closestOnTriangle(corner, prepared)).norm());
    return std::min(here + reachOf(corners, middle), convex);
  };
  DistanceSearch search(bound_of, wanted, go_on);
  for (const Vec3& vertex : from.vertices)  // most of what the bounds are compared with
    search.raise(std::sqrt(tree.squaredDistance(vertex, 1e300)));
  return search.over(from);
}

SurfaceDistance largestDistance(const TriMesh& from, const std::function<double(const Vec3&)>& distance,
                                double tolerance, const GoOn& go_on) {
  const auto bound_of = [&](const Corners& corners, double& low) {
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const double here = distance(middle);
    low = std::max(low, here);
    return here + reachOf(corners, middle);
  };
  const DistanceWanted wanted{.tolerance = tolerance};
  DistanceSearch search(bound_of, wanted, go_on);
  for (const Vec3& vertex : from.vertices) search.raise(distance(vertex));
  return search.over(from);
}

}  // namespace presa
