#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/geometry/tri_mesh.h"

namespace presa {

/// Points spread evenly over the surface of a mesh, sharp edges and corners included. They come in levels: the first few
/// cover the whole surface coarsely, and each level halves the spacing of those before it. The points of a level are in
/// Morton order, in blocks with bounding spheres, and the blocks in groups with bounding spheres.
/// Where the mesh is its own mirror image in a plane that halves its box, so are the points.
/// Frame: that of the mesh [m]. Single precision: 0.1 um at 1 m. Immutable.
class PointShell {
 public:
  static constexpr std::size_t kBlock = 64,  ///< max points of a block
      kGroup = 16;                           ///< max blocks of a group

  using Vec3f = Eigen::Vector3f;  ///< a place or direction in single precision
  /// A bounding sphere.
  struct Ball {
    Vec3f center = Vec3f::Zero();  ///< [m]
    float radius = 0;              ///< encloses all points [m]
  };
  /// Consecutive points, or consecutive blocks.
  struct Range {
    Ball ball;                ///< around them
    std::uint32_t first = 0;  ///< index
    std::uint32_t end = 0;    ///< index, one beyond the last
  };
  /// A coverage of the surface together with the levels before it.
  struct Level {
    std::uint32_t first_group = 0;  ///< index into groups()
    std::uint32_t end_group = 0;    ///< index into groups(), one beyond the last
    std::uint32_t points = 0;       ///< of this level and those before it
    double spacing = 0;             ///< min distance of points that face the same way; half of it beside a mirror [m]
  };

  /// Moves a place on the mesh [m] and its unit normal onto the surface that the mesh approximates.
  using Exact = std::function<void(Vec3& p, Vec3& normal)>;

  PointShell() = default;  ///< no points
  /// `spacing` [m] > 0 of the finest level, at most `max_points`; fewer levels cover a small mesh. The mesh has
  /// adjacency. With `exact`, the points lie where it moves them. Deterministic. Thread: before a run.
  PointShell(const TriMesh& mesh, double spacing, std::size_t max_points, const Exact& exact = {});

  std::size_t size() const noexcept { return points_.size(); }             ///< points of all levels
  const std::vector<Vec3f>& points() const noexcept { return points_; }    ///< [m]
  const std::vector<Vec3f>& normals() const noexcept { return normals_; }  ///< unit, outward
  const std::vector<Range>& blocks() const noexcept { return blocks_; }    ///< ranges of points
  const std::vector<Range>& groups() const noexcept { return groups_; }    ///< ranges of blocks
  const std::vector<Level>& levels() const noexcept { return levels_; }    ///< coarse to fine
  double radius() const noexcept { return radius_; }                       ///< of the ball about the origin [m]
  std::size_t roomBytes() const noexcept;                                  ///< memory [bytes]

 private:
  void addLevel(std::size_t first, double spacing);

  std::vector<Vec3f> points_, normals_;
  std::vector<Range> blocks_, groups_;
  std::vector<Level> levels_;
  double radius_ = 0;
};

}  // namespace presa
