#include "framework/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/surface_tree.h"

namespace presa {
namespace {

constexpr std::size_t kAskEvery = 4096;  // triangles

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
class Search {
 public:
  Search(const BoundOf& bound_of, double tolerance) : bound_of_(bound_of), tolerance_(tolerance) {}

  /// Takes a triangle into the bounds, and halves it as often as that takes.
  void look(const Corners& corners) {
    const double bound = bound_of_(corners, low_);
    if (bound <= low_ + tolerance_) {
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

  double low() const { return low_; }
  void raise(double low) { low_ = std::max(low_, low); }
  SurfaceDistance bounds() const { return {low_, std::max(low_, high_)}; }

 private:
  const BoundOf& bound_of_;
  const double tolerance_;
  double low_ = 0, high_ = 0;
};

}  // namespace

SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, double tolerance, const GoOn& go_on,
                                double give_up) {
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
  Search search(bound_of, tolerance);
  for (const Vec3& vertex : from.vertices)  // most of what the bounds are compared with
    search.raise(std::sqrt(tree.squaredDistance(vertex, 1e300)));
  for (std::size_t t = 0; t < from.triangles.size() && search.low() <= give_up; ++t) {
    search.look(cornersOf(from, t));
    const double share = static_cast<double>(t) / static_cast<double>(from.triangles.size());
    if (go_on && t % kAskEvery == 0 && !go_on(share)) give_up = -1;
  }
  if (search.low() <= give_up) return search.bounds();
  return {search.low(), std::numeric_limits<double>::infinity()};
}

SurfaceDistance largestDistance(const TriMesh& from, const std::function<double(const Vec3&)>& distance,
                                double tolerance) {
  const auto bound_of = [&](const Corners& corners, double& low) {
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const double here = distance(middle);
    low = std::max(low, here);
    return here + reachOf(corners, middle);
  };
  Search search(bound_of, tolerance);
  for (const Vec3& vertex : from.vertices) search.raise(distance(vertex));
  for (std::size_t t = 0; t < from.triangles.size(); ++t) search.look(cornersOf(from, t));
  return search.bounds();
}

}  // namespace presa
