#pragma once
#include <array>
#include <unordered_map>
#include <vector>

#include "modules/collision_fcl/mesh_index.h"
#include "modules/collision_fcl/obb_tree.h"

namespace presa {

/// H-COLLIDE [Gregory1999]: a uniform grid over the mesh; a hash table holds the cells that triangles touch, each with
/// its own tree of oriented boxes over them. A triangle is in every cell that its bounding box touches. The cells of
/// the last way are kept: a probe that stays among them needs no look-up.
class HashedGrid final : public MeshIndex {
 public:
  explicit HashedGrid(const MeshTree& mesh);

  void find(const ProbeWay& way, FacetSet& found) noexcept override;

 private:
  using Place = std::array<std::int32_t, 3>;  ///< of a cell along x, y, z; the first is 0
  struct Range {
    Place low{}, high{};  ///< both inclusive
    bool operator==(const Range&) const = default;
    bool has(const Place& place) const noexcept;
    double size() const noexcept;
  };
  struct Cell {
    Place place;
    ObbTree tree;
  };

  Place placeOf(const Vec3& p) const noexcept;
  Range rangeOf(const AxisBox& box) const noexcept { return {placeOf(box.low), placeOf(box.high)}; }
  static std::uint64_t keyOf(const Place& place) noexcept;
  void gather(const Range& range) noexcept;

  Vec3 low_;
  double edge_;  ///< of a cell [m]
  Place last_;   ///< place of the last cell
  std::vector<Cell> cells_;
  std::unordered_map<std::uint64_t, std::int32_t> cell_at_;  // by key
  Range range_{{1, 1, 1}, {0, 0, 0}};                        // of the last way
  std::vector<std::int32_t> near_;                           // the cells in it
};

}  // namespace presa
