#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/geometry/mesh_tree.h"
#include "modules/ray/segment.h"

namespace presa {

/// The mesh around one segment: a front (cut) through the mesh's hierarchy, tracked from tick to tick, as MeshFront is
/// around a point. Each item, a triangle or a whole node, has a plane function below its distance at every point. Its least
/// value on the part of the segment that is near the item bounds the distance of the segment. Only items whose bound allows a touch are
/// examined; then the bound is renewed, and a node that is really that near is replaced by its children.
/// Frame: mesh coordinates G [m]. Memory is fixed after construction. Thread: haptic; nonblocking.
class SegmentFront {
 public:
  static constexpr int kCapacity = 2048;  ///< items: triangles and nodes
  static constexpr double kSlack = 2e-8;  ///< by which a triangle may be nearer than the one that is found [m]

  SegmentFront();  ///< allocates

  void seed(const MeshTree& tree) noexcept;  ///< restarts from the root of a mesh

  /// Selects the items that may come within `radius` of the segment, and of one that moves `ahead` farther; nearestOf()
  /// examines only these until the next call. Restarts from the root when most items are left behind.
  void focus(const Segment& segment, double radius, double ahead) noexcept;

  /// The item nearest to the segment, but for kSlack, if its distance is at most `limit`.
  struct Found {
    std::int32_t ref = kNothing;  ///< item: triangleOf(); kNothing: none
    SegmentNearest at;            ///< its nearest points
  };
  Found nearestOf(const Segment& segment, double limit) noexcept;
  static constexpr std::int32_t kNothing = 1 << 30;  ///< no item

  /// Whether `ref` is a triangle; else a node of a full front, which stands for all of its triangles.
  static bool isTriangle(std::int32_t ref) noexcept { return ref < 0; }
  /// The triangle `ref` names.
  PreparedTriangle triangleOf(std::int32_t ref) const noexcept {
    const MeshTree::Facet& facet = tree_->facet(~ref);
    return {tree_->corner(facet, 0), tree_->corner(facet, 1), tree_->corner(facet, 2)};
  }
  /// True when a node found no room for its children at the last nearestOf(), which then took it as a solid box.
  bool full() const noexcept { return full_; }

 private:
  /// A triangle or a node: one line of the cache.
  struct Item {
    Vec3 nhat;  // of its plane; zero: `offset` alone
    double offset;
    Vec3 centre;  // of a ball around it
    double radius;
  };
  /// A segment and what all items need of it.
  struct Query {
    explicit Query(const Segment& segment) noexcept;
    const Segment& segment;
    Vec3 d;
    double per_length;  // 1 / |d|; 0 for a point
  };
  void put(int item, const TangentBound& bound, std::int32_t ref) noexcept;
  void bind(int item, const TangentBound& bound) noexcept;
  /// More than `limit` only if the item is farther than that from the segment.
  double boundOf(int item, const Query& query, double limit) const noexcept;
  double movedFrom(const Segment& segment) const noexcept;  ///< way of its farthest point since the last focus
  void beside(int item, double bound) noexcept;             ///< adds an item to those in focus
  bool open(int item) noexcept;
  /// Renews the bound of a node and returns it.
  double renew(int item, const Query& query, double limit) noexcept;
  void lookAt(int item, const Query& query, Found& best, double& limit) noexcept;
  void expand(int item, const Query& query, Found& best, double& limit) noexcept;
  void search(const Query& query, Found& best, double& limit) noexcept;
  int lowest(const Query& query, double limit) const noexcept;

  std::vector<Item> items_;
  std::vector<std::int32_t> refs_;  // >= 0: node; < 0: ~facet
  std::vector<std::int32_t> near_;  // items in focus
  std::vector<double> here_;        // their bounds there
  Segment focused_;
  double focus_radius_ = -1;  // near_ holds all items within this distance of focused_; below zero: nothing
  const MeshTree* tree_ = nullptr;
  int count_ = 0, near_count_ = 0, fresh_ = 0;
  int last_ = -1;  // nearest item of the last query
  bool full_ = false;
};

}  // namespace presa
