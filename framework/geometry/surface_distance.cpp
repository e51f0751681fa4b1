#include "framework/geometry/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/surface_tree.h"

namespace presa {
namespace {

constexpr std::size_t kAskEvery = 4096;  // triangles

using Corners = std::array<Vec3, 3>;

class Search {
 public:
  Search(const TriMesh& to, double tolerance) : to_(to), tree_(to), tolerance_(tolerance) {}

  void lookAtPoint(const Vec3& p) { bounds_.low = std::max(bounds_.low, std::sqrt(tree_.squaredDistance(p, 1e300))); }

  SurfaceDistance bounds() const { return {bounds_.low, std::max(bounds_.low, bounds_.high)}; }

  /// Takes a triangle into the bounds, and halves it as often as that takes.
  void look(const Corners& corners) {
    const double bound = boundOf(corners);
    if (bound <= bounds_.low + tolerance_) {
      bounds_.high = std::max(bounds_.high, bound);
      return;
    }
    // halve the longest edge
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

 private:
  /// No point of a triangle is farther than this.
  double boundOf(const Corners& corners) {
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const std::size_t nearest = tree_.nearest(middle);
    const Corners target = cornersOf(nearest);
    const PreparedTriangle prepared(target[0], target[1], target[2]);
    const double here = (middle - closestOnTriangle(middle, prepared)).norm();
    bounds_.low = std::max(bounds_.low, here);
    double reach = 0, convex = 0;
    for (const Vec3& corner : corners) {
      reach = std::max(reach, (corner - middle).norm());
      convex = std::max(convex, (corner - closestOnTriangle(corner, prepared)).norm());
    }
    return std::min(here + reach, convex);
  }

  Corners cornersOf(std::size_t triangle) const {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = to_.vertices[static_cast<std::size_t>(to_.triangles[triangle][i])];
    return corners;
  }

  const TriMesh& to_;
  SurfaceTree tree_;
  const double tolerance_;
  SurfaceDistance bounds_;
};

}  // namespace

SurfaceDistance surfaceDistance(const TriMesh& from, const TriMesh& to, double tolerance,
                                const std::function<bool(double)>& go_on) {
  Search search(to, tolerance);
  for (const Vec3& vertex : from.vertices) search.lookAtPoint(vertex);  // most of what the bounds compare with
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = from.vertices[static_cast<std::size_t>(from.triangles[t][i])];
    search.look(corners);
    const double share = static_cast<double>(t) / static_cast<double>(from.triangles.size());
    if (go_on && t % kAskEvery == 0 && !go_on(share))
      return {search.bounds().low, std::numeric_limits<double>::infinity()};
  }
  return search.bounds();
}

}  // namespace presa
