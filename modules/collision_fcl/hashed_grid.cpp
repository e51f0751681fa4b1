#include "modules/collision_fcl/hashed_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace presa {
namespace {

/// Triangles in a cell of a plane: the fewest that cost a fingertip no more time than larger cells do (README).
constexpr double kPerCell = 1024;
/// Max copies of a triangle, over all cells, in the mean: a mesh of few large triangles gets larger cells.
constexpr std::size_t kCopies = 3;
constexpr double kMaxAlong = 1'000'000;  ///< cells along an axis: a key has 21 bits for each

AxisBox boxOf(const MeshTree& mesh, std::int32_t facet) {
  AxisBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& corner = mesh.corner(mesh.facet(facet), k);
    box.low = box.low.cwiseMin(corner);
    box.high = box.high.cwiseMax(corner);
  }
  return box;
}

double areaOf(const MeshTree& mesh, std::int32_t facet) {
  const MeshTree::Facet& f = mesh.facet(facet);
  const Vec3& a = mesh.corner(f, 0);
  return 0.5 * (mesh.corner(f, 1) - a).cross(mesh.corner(f, 2) - a).norm();
}

}  // namespace

bool HashedGrid::Range::has(const Place& place) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    if (place[i] < low[i] || place[i] > high[i]) return false;
  }
  return true;
}

double HashedGrid::Range::size() const noexcept {
  double product = 1;
  for (std::size_t i = 0; i < 3; ++i) product *= 1.0 + high[i] - low[i];
  return product;
}

HashedGrid::HashedGrid(const MeshTree& mesh) {
  const auto count = static_cast<std::int32_t>(mesh.mesh().triangles.size());
  const AxisBox bounds = boundsOf(mesh.mesh());
  const double longest = (bounds.high - bounds.low).maxCoeff();
  double area = 0;
  for (std::int32_t f = 0; f < count; ++f) area += areaOf(mesh, f);
  low_ = bounds.low;
  edge_ = std::max(std::sqrt(kPerCell * area / count), longest / kMaxAlong);
  if (!(edge_ > 0)) edge_ = 1;
  std::vector<std::pair<std::uint64_t, std::int32_t>> copies;
  for (;; edge_ *= 2) {
    last_ = {INT32_MAX, INT32_MAX, INT32_MAX};
    last_ = placeOf(bounds.high);
    double needed = 0;
    for (std::int32_t f = 0; f < count; ++f) needed += rangeOf(boxOf(mesh, f)).size();
    if (needed <= kCopies * static_cast<double>(count)) break;
  }
  for (std::int32_t f = 0; f < count; ++f) {
    const Range range = rangeOf(boxOf(mesh, f));
    for (Place at = range.low; at[0] <= range.high[0]; ++at[0]) {
      for (at[1] = range.low[1]; at[1] <= range.high[1]; ++at[1]) {
        for (at[2] = range.low[2]; at[2] <= range.high[2]; ++at[2]) copies.emplace_back(keyOf(at), f);
      }
    }
  }
  std::ranges::sort(copies);
  std::vector<std::int32_t> facets;
  for (std::size_t begin = 0, end = 0; begin < copies.size(); begin = end) {
    const std::uint64_t key = copies[begin].first;
    facets.clear();
    for (; end < copies.size() && copies[end].first == key; ++end) facets.push_back(copies[end].second);
    constexpr std::uint64_t kAxis = (1U << 21U) - 1;
    const Place place{static_cast<std::int32_t>(key >> 42U), static_cast<std::int32_t>(key >> 21U & kAxis),
                      static_cast<std::int32_t>(key & kAxis)};
    cell_at_.emplace(key, static_cast<std::int32_t>(cells_.size()));
    cells_.push_back({place, ObbTree(mesh, facets)});
  }
  near_.reserve(cells_.size());
}

HashedGrid::Place HashedGrid::placeOf(const Vec3& p) const noexcept {
  Place place{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    place[i] = static_cast<std::int32_t>(
        std::clamp(std::floor((p[axis] - low_[axis]) / edge_), 0.0, static_cast<double>(last_[i])));
  }
  return place;
}

std::uint64_t HashedGrid::keyOf(const Place& place) noexcept {
  return static_cast<std::uint64_t>(place[0]) << 42U | static_cast<std::uint64_t>(place[1]) << 21U |
         static_cast<std::uint64_t>(place[2]);
}

// A way through more cells than triangles occupy is compared with the occupied ones instead.
void HashedGrid::gather(const Range& range) noexcept {
  range_ = range;
  near_.clear();
  if (range.size() > static_cast<double>(cells_.size())) {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (range.has(cells_[c].place)) near_.push_back(static_cast<std::int32_t>(c));
    }
    return;
  }
  for (Place at = range.low; at[0] <= range.high[0]; ++at[0]) {
    for (at[1] = range.low[1]; at[1] <= range.high[1]; ++at[1]) {
      for (at[2] = range.low[2]; at[2] <= range.high[2]; ++at[2]) {
        const auto found = cell_at_.find(keyOf(at));
        if (found != cell_at_.end()) near_.push_back(found->second);
      }
    }
  }
}

void HashedGrid::find(const ProbeWay& way, FacetSet& found) noexcept {
  constexpr double kRounding = 1e-9;  // relative to the radius and the coordinates
  const Vec3 reach = Vec3::Constant(
      way.radius + kRounding * (way.radius + way.from.lpNorm<Eigen::Infinity>() + way.to.lpNorm<Eigen::Infinity>()));
  AxisBox box;
  box.low = way.from.cwiseMin(way.to) - reach;
  box.high = way.from.cwiseMax(way.to) + reach;
  if (!box.low.allFinite() || !box.high.allFinite()) return;
  const Range range = rangeOf(box);
  if (range != range_) gather(range);
  for (const std::int32_t c : near_) cells_[static_cast<std::size_t>(c)].tree.find(way, found);
}

}  // namespace presa
