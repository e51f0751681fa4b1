#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "framework/geometry/mesh_tree.h"
#include "framework/haptics/convex_piece.h"

namespace presa {

/// Tolerances of a sweep [m].
struct SweepTolerance {
  double touch = 0;  ///< gap that counts as touch
  double graze = 0;  ///< a triangle counts as touched only if the path dips deeper than this
};

/// The mesh around one fingertip: a front (cut) through the mesh's hierarchy, tracked from tick to tick. Each item is a
/// triangle or a whole node with a tangent bound: a plane function below its distance at every point. An item is
/// examined only where its bound allows a touch; then the bound is renewed, and a node that is really that near is
/// replaced by its children. The front always covers the whole mesh (or the cut it was seeded from), its size grows
/// with the logarithm of the mesh, and a tick costs one pass over some hundred planes plus the touched items.
/// Frame: mesh coordinates G [m]. Fixed memory. Thread: haptic; nonblocking.
class MeshFront {
 public:
  static constexpr int kCapacity = 2048;  ///< items: triangles and nodes

  static constexpr std::size_t kMaxSeeds = 16;  ///< nodes that seed() takes

  /// Restarts from at most kMaxSeeds nodes that cover everything within reach.
  void seed(const MeshTree& tree, std::span<const std::int32_t> nodes, const Vec3& p) noexcept;
  bool seeded() const noexcept { return tree_ != nullptr; }  ///< seed() was called, and forget() was not since
  void forget() noexcept { tree_ = nullptr; }                ///< drops the mesh: seed() before the next query
  /// True when the front has grown much since its seed, mostly by items left behind: reseed it. Call once per tick.
  bool worn() noexcept {
    if (fresh_ == 0) fresh_ = count_;
    return count_ > 2 * fresh_ + kBlock;
  }
  /// True when a node found no room for its children since the last seed(). That node then acts as a solid box.
  bool full() const noexcept { return full_; }
  int count() const noexcept { return count_; }  ///< items of the front

  /// Reseeds a full front from the same nodes: after a long path most items lie behind.
  void renew(const Vec3& p) noexcept {
    if (full_) seed(*tree_, {seeds_.data(), static_cast<std::size_t>(seed_count_)}, p);
  }
  /// Selects the items that may come within `radius` of p; the queries below examine only these until the next focus().
  /// When few items are near, the selection covers some further steps of length `step` in advance, which makes the next
  /// calls free.
  void focus(const Vec3& p, double radius, double step) noexcept;

  /// Calls visit(item, nearest) for every item in focus whose distance from p is at most `limit`. `limit` is re-read
  /// each time, so a visit may lower it.
  template <class Visit>
  void forEachWithin(const Vec3& p, const double& limit, const Visit& visit) noexcept;

  /// First s in [0, reach] at which a sphere of radius r, whose centre moves from x to x + s move, touches an unmarked
  /// item in focus; `reach` when none. Same sweep as in convex_piece.h.
  double firstTouch(const Vec3& x, const Vec3& move, double reach, double r, const SweepTolerance& tolerance) noexcept;

  /// Marks items until the next clearMarks().
  void mark(int item) noexcept { marks_[static_cast<std::size_t>(item)] = mark_; }
  void clearMarks() noexcept { ++mark_; }  ///< no item is marked any more

  /// Facet of an item; -1: a node of a full front.
  std::int32_t facetOf(int item) const noexcept {
    const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
    return ref < 0 ? ~ref : -1;
  }
  /// Lower bound of the distance of p from the whole mesh [m].
  double clearance(const Vec3& p) const noexcept;
  /// True when the polyline `way` crosses a triangle. `focused`: the whole polyline lies within the focus.
  bool crosses(std::span<const Vec3> way, bool focused) noexcept;

 private:
  static constexpr int kBlock = 8;

  void put(int item, const TangentBound& bound, std::int32_t ref) noexcept {
    const auto i = static_cast<std::size_t>(item);
    nx_[i] = bound.nhat.x();
    ny_[i] = bound.nhat.y();
    nz_[i] = bound.nhat.z();
    offset_[i] = bound.offset;
    refs_[i] = ref;
    marks_[i] = 0;
  }
  void add(const TangentBound& bound, std::int32_t ref) noexcept {
    near_[static_cast<std::size_t>(near_count_++)] = count_;
    put(count_++, bound, ref);
  }
  double boundAt(int item, const Vec3& p) const noexcept {
    const auto i = static_cast<std::size_t>(item);
    return nx_[i] * p.x() + ny_[i] * p.y() + nz_[i] * p.z() + offset_[i];
  }
  void bind(int item, const TangentBound& bound) noexcept {
    const auto i = static_cast<std::size_t>(item);
    nx_[i] = bound.nhat.x();
    ny_[i] = bound.nhat.y();
    nz_[i] = bound.nhat.z();
    offset_[i] = bound.offset;
  }
  /// Replaces a node by its children: the first takes its index, the others are appended at the old count() and are in
  /// focus. False: no room.
  bool open(int item) noexcept;
  PreparedTriangle triangle(std::int32_t facet) const noexcept {
    const MeshTree::Facet& f = tree_->facet(facet);
    return {tree_->corner(f, 0), tree_->corner(f, 1), tree_->corner(f, 2)};
  }
  /// Nearest point of a node's box, used when the front is full.
  Nearest nearestOfNode(std::int32_t node, const Vec3& p) const noexcept;
  template <class Visit>
  void lookAt(int item, const Vec3& p, const double& limit, const Visit& visit) noexcept;
  /// Whether the path from x to x + reach move stays farther than r from an item, according to two tangents of its
  /// distance.
  bool staysClear(int item, const Vec3& x, const Vec3& move, double reach, double r) noexcept;
  void sweep(int item, const Vec3& x, const Vec3& move, double& reach, double r,
             const SweepTolerance& tolerance) noexcept;
  /// Necessary condition for a crossing: the item's bound is zero or less at some point of the path.
  bool comesNear(int item, std::span<const Vec3> way, double rounding) const noexcept {
    double min = std::numeric_limits<double>::infinity();
    for (const Vec3& p : way) min = std::min(min, boundAt(item, p));
    return min <= rounding;
  }
  bool crossesItem(int item, std::span<const Vec3> way, double rounding) noexcept;
  bool crossesFacet(const MeshTree::Facet& facet, const Vec3& a, const Vec3& b) const noexcept;

  // structure of arrays, so that a pass over the bounds vectorises
  std::array<double, kCapacity> nx_{}, ny_{}, nz_{}, offset_{};
  std::array<std::int32_t, kCapacity> refs_{};    // >= 0: node; < 0: ~facet
  std::array<std::uint32_t, kCapacity> marks_{};  // == mark_: marked
  std::array<std::int32_t, kCapacity> near_{};    // items in focus
  std::array<double, kCapacity> here_{};          // bounds of the items in near_, at here_at_
  Vec3 here_at_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  int near_count_ = 0;
  Vec3 focus_ = Vec3::Zero();
  double focus_radius_ = -1;  // near_ holds all items within this distance of focus_
  int fresh_ = 0;             // number of items after the first tick since seed()
  const MeshTree* tree_ = nullptr;
  std::array<std::int32_t, kMaxSeeds> seeds_{};
  int seed_count_ = 0;
  int count_ = 0;
  std::uint32_t mark_ = 1;
  bool full_ = false;
};

template <class Visit>
void MeshFront::forEachWithin(const Vec3& p, const double& limit, const Visit& visit) noexcept {
  const int count = near_count_;  // children opened during the loop are examined at once
  for (int n = 0; n < count; ++n) {
    const auto i = static_cast<std::size_t>(n);
    const int item = near_[i];
    here_[i] = boundAt(item, p);
    if (here_[i] > limit) continue;
    lookAt(item, p, limit, visit);
    here_[i] = boundAt(item, p);
  }
  for (int n = count; n < near_count_; ++n)
    here_[static_cast<std::size_t>(n)] = boundAt(near_[static_cast<std::size_t>(n)], p);
  here_at_ = p;
}

template <class Visit>
void MeshFront::lookAt(int item, const Vec3& p, const double& limit, const Visit& visit) noexcept {
  const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
  if (ref < 0) {
    const Nearest at = nearest(triangle(~ref), p);
    // for a point on the triangle the direction is arbitrary and gives no bound
    bind(item, at.distance != 0 ? TangentBound{at.nhat, at.distance - at.nhat.dot(p)} : TangentBound{});
    if (at.distance <= limit) visit(item, at);
    return;
  }
  double distance = 0;
  bind(item, tree_->bound(ref, p, distance));
  if (distance > limit) return;
  const int old_count = count_;
  if (!open(item)) {
    visit(item, nearestOfNode(ref, p));
    return;
  }
  const int new_count = count_;
  lookAt(item, p, limit, visit);
  for (int child = old_count; child < new_count; ++child) lookAt(child, p, limit, visit);
}

}  // namespace presa
