#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "framework/geometry/mesh_tree.h"
#include "framework/haptics/convex_piece.h"

namespace presa {

/// What counts as a touch in a sweep [m].
struct SweepTolerance {
  double touch = 0;  ///< a gap that small
  double graze = 0;  ///< on a triangle only a way that dips deeper
};

/// A mesh as one fingertip sees it: a front through its hierarchy, tracked from tick to tick. Each item is a triangle or a
/// whole node, and carries a tangent bound: a plane above which its distance lies, wherever the fingertip goes. An item is
/// looked at only where that bound comes down to the fingertip; then its bound is taken anew, and if a node is really that
/// near, its children take its place. So the front always holds the whole mesh (or the whole cut that it was seeded from),
/// its size grows with the logarithm of the mesh, and a tick costs a pass over some hundred planes and what is touched.
/// Frame: mesh coordinates G. Fixed memory. Thread: haptic; nonblocking.
class MeshFront {
 public:
  static constexpr int kCapacity = 2048;

  static constexpr std::size_t kMaxSeeds = 16;

  /// Starts again from nodes that hold all that can be reached, at most kMaxSeeds.
  void seed(const MeshTree& tree, std::span<const std::int32_t> nodes, const Vec3& p) noexcept;
  bool seeded() const noexcept { return tree_ != nullptr; }
  void forget() noexcept { tree_ = nullptr; }
  /// Much of it the fingertip has left behind: better seeded again. Asked once a tick.
  bool worn() noexcept {
    if (fresh_ == 0) fresh_ = count_;
    return count_ > 2 * fresh_ + kBlock;
  }
  /// A node found no room for its children since the last seed(): it stands for them, as a solid box.
  bool full() const noexcept { return full_; }
  int count() const noexcept { return count_; }

  /// Starts again from the same nodes where it is full: on a long way most of it lies behind.
  void renew(const Vec3& p) noexcept {
    if (full_) seed(*tree_, {seeds_.data(), static_cast<std::size_t>(seed_count_)}, p);
  }
  /// Picks what may come within `radius` of p: all that the queries below look through, until the next focus(). Where little is
  /// near, it picks for some steps of length `step` ahead, and the next calls have nothing to do.
  void focus(const Vec3& p, double radius, double step) noexcept;

  /// Calls visit(item, nearest) for everything in focus whose distance from p is at most `limit`. `limit` is read again and
  /// again: a visit may lower it.
  template <class Visit>
  void forEachWithin(const Vec3& p, const double& limit, const Visit& visit) noexcept;

  /// First s in [0, reach] at which a sphere of radius r, its centre moving from x along `move`, touches something in focus that
  /// is not marked; `reach` when nothing. Swept as convex_piece does it.
  double firstTouch(const Vec3& x, const Vec3& move, double reach, double r, const SweepTolerance& tolerance) noexcept;

  /// Marks items until the next clearMarks().
  void mark(int item) noexcept { marks_[static_cast<std::size_t>(item)] = mark_; }
  void clearMarks() noexcept { ++mark_; }

  /// Facet of an item; -1: a node, where the front was full.
  std::int32_t facetOf(int item) const noexcept {
    const std::int32_t ref = refs_[static_cast<std::size_t>(item)];
    return ref < 0 ? ~ref : -1;
  }
  /// Lower bound of the distance of p from everything [m].
  double clearance(const Vec3& p) const noexcept;
  /// True when the way from point to point crosses a triangle. `focused`: all of it lies where everything is in focus.
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
  /// Puts the children of a node in its place; the first takes its index, the others follow from the old count() on, in focus.
  /// False: no room.
  bool open(int item) noexcept;
  PreparedTriangle triangle(std::int32_t facet) const noexcept {
    const MeshTree::Facet& f = tree_->facet(facet);
    return {tree_->corner(f, 0), tree_->corner(f, 1), tree_->corner(f, 2)};
  }
  /// Nearest of a node's box, for a front that is full.
  Nearest nearestOfNode(std::int32_t node, const Vec3& p) const noexcept;
  template <class Visit>
  void lookAt(int item, const Vec3& p, const double& limit, const Visit& visit) noexcept;
  /// The way from x to x + reach move keeps farther than r from an item, as two tangents of its distance tell.
  bool staysClear(int item, const Vec3& x, const Vec3& move, double reach, double r) noexcept;
  void sweep(int item, const Vec3& x, const Vec3& move, double& reach, double r,
             const SweepTolerance& tolerance) noexcept;
  /// A triangle that is crossed is at no distance from a point of the way.
  bool comesNear(int item, std::span<const Vec3> way, double rounding) const noexcept {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : way) least = std::min(least, boundAt(item, p));
    return least <= rounding;
  }
  bool crossesItem(int item, std::span<const Vec3> way, double rounding) noexcept;
  bool crossesFacet(const MeshTree::Facet& facet, const Vec3& a, const Vec3& b) const noexcept;

  // one array for each coordinate: a pass over the bounds goes through them in step
  std::array<double, kCapacity> nx_{}, ny_{}, nz_{}, offset_{};
  std::array<std::int32_t, kCapacity> refs_{};    // >= 0: node; < 0: ~facet
  std::array<std::uint32_t, kCapacity> marks_{};  // == mark_: marked
  std::array<std::int32_t, kCapacity> near_{};    // items in focus
  std::array<double, kCapacity> here_{};          // their bounds at here_at_
  Vec3 here_at_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  int near_count_ = 0;
  Vec3 focus_ = Vec3::Zero();
  double focus_radius_ = -1;  // about focus_ everything in it is in near_
  int fresh_ = 0;             // size after the first tick since seed()
  const MeshTree* tree_ = nullptr;
  std::array<std::int32_t, kMaxSeeds> seeds_{};
  int seed_count_ = 0;
  int count_ = 0;
  std::uint32_t mark_ = 1;
  bool full_ = false;
};

template <class Visit>
void MeshFront::forEachWithin(const Vec3& p, const double& limit, const Visit& visit) noexcept {
  const int count = near_count_;  // what is opened on the way is looked at at once
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
    // on a triangle the direction is arbitrary and bounds nothing
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
