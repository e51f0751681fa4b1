#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/geometry/surface_distance.h"
#include "framework/geometry/tri_mesh.h"

namespace presa {

/// Signed distance from the surface of a solid, negative inside, sampled on a grid of voxels. Only blocks of 8 x 8 x 8
/// voxels near the surface are stored (the narrow band); elsewhere one sample per block corner remains. All samples are
/// exact; between them the field is trilinear, hence continuous except across the border of the band.
/// Frame: that of the solid [m]. Thread: any; immutable, queries neither allocate nor lock.
class DistanceField {
 public:
  static constexpr int kBlock = 8;  ///< voxels along the edge of a block

  /// The solid's exact signed distance at a point; the second argument is an upper bound of its absolute value that the
  /// caller knows. May be called on several threads.
  using Exact = std::function<double(const Vec3& p, double bound)>;
  /// How finely a field is sampled.
  struct Settings {
    double voxel = 0.0005;  ///< edge of a voxel [m]
    double band = 3;        ///< samples are stored up to this distance from the surface [voxels]
    std::size_t max_bytes = std::size_t{1} << 28U;  ///< a larger field is refused before it is built
    GoOn go_on = {};                                ///< called by one thread only
  };
  /// Memory that a field needs, known before it is built.
  struct Size {
    std::array<int, 3> blocks{};  ///< along each axis
    std::size_t stored = 0;       ///< blocks in the narrow band
    std::size_t bytes = 0;        ///< of the field [bytes]; more than Settings::max_bytes: at least that
  };

  /// Field of a solid within `bounds`, which enclose its surface. Two threads at the most. None: told to stop, or larger
  /// than Settings::max_bytes; `size` (may be null) says which: its bytes exceed them.
  static std::optional<DistanceField> build(const Exact& exact, const AxisBox& bounds, const Settings& settings,
                                            Size* size = nullptr);

  double voxel() const noexcept { return voxel_; }         ///< edge of a voxel [m]
  const Vec3& origin() const noexcept { return origin_; }  ///< corner of the grid with the smallest coordinates [m]
  AxisBox box() const noexcept;                            ///< of the grid [m]
  std::size_t storedBlocks() const noexcept { return samples_.size() / kSamples; }  ///< in the narrow band
  std::size_t roomBytes() const noexcept;                                           ///< memory [bytes]

  /// Distance at p [m]. Outside of the grid: a lower bound.
  double at(const Vec3& p) const noexcept {
    const Vec3 g = (p - origin_) * per_voxel_;
    return voxel_ * static_cast<double>(inVoxels(g.x(), g.y(), g.z()));
  }
  /// at() with place and result in voxels, the place from origin(): for many points in a row.
  float inVoxels(double x, double y, double z) const noexcept;
  /// Gradient of inVoxels(): of the trilinear field itself, hence constant across no border of voxels. Zero outside of the
  /// narrow band.
  Eigen::Vector3f slopeInVoxels(double x, double y, double z) const noexcept;
  /// Central difference of at() over two voxels: continuous; of about unit length near a smooth surface.
  Vec3 gradient(const Vec3& p) const noexcept;
  /// The sample nearest to p, as it is stored, and its place [m]. Outside of the narrow band and of the grid: at(p), p.
  double nearestSample(const Vec3& p, Vec3& place) const noexcept;
  /// A lower bound of the distance of p from the surface that holds for the solid itself [m].
  double lowerBound(const Vec3& p) const noexcept;

  /// Everything as bytes.
  std::string bytes() const;
  /// The field that gave these bytes; none: damaged, or of another version.
  static std::optional<DistanceField> fromBytes(const std::string& bytes);

 private:
  friend class FieldSweep;
  static constexpr int kSide = kBlock + 1;  // samples along the edge of a block: its last are its neighbour's first
  static constexpr std::size_t kSamples = std::size_t{kSide} * kSide * kSide;
  static constexpr std::int32_t kCoarse = -1;

  DistanceField() = default;
  void lay(const AxisBox& bounds, double voxel);
  bool sampleCorners(const Exact& exact, const Settings& settings);
  void chooseBlocks(const Exact& exact, double band);
  bool sampleBlocks(const Exact& exact, const Settings& settings);
  void sampleBlock(const Exact& exact, std::size_t block, float* out) const;
  Vec3 cornerOf(std::size_t block) const noexcept;
  std::size_t blockCount() const noexcept {
    return static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
           static_cast<std::size_t>(blocks_[2]);
  }
  // all in voxels, from the grid's origin
  bool isInside(double x, double y, double z) const noexcept {
    return x >= 0 && y >= 0 && z >= 0 && x <= last_[0] && y <= last_[1] && z <= last_[2];
  }
  // The first sample of a cell: its place within a block, whose place in the grid is i, j, k. Null: not stored.
  const float* cellIn(int i, int j, int k, int in_block) const noexcept {
    const std::int32_t stored = stored_[static_cast<std::size_t>(i + blocks_[0] * (j + blocks_[1] * k))];
    if (stored == kCoarse) return nullptr;
    return samples_.data() + static_cast<std::size_t>(stored) * kSamples + in_block;
  }
  // Of the cell around a place inside of the grid.
  const float* cellAt(double x, double y, double z) const noexcept {
    const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
    return cellIn(i / kBlock, j / kBlock, k / kBlock, (i % kBlock) + kSide * ((j % kBlock) + kSide * (k % kBlock)));
  }
  static float fraction(double x) noexcept { return static_cast<float>(x - static_cast<int>(x)); }
  float coarseAt(double x, double y, double z) const noexcept;
  float beyond(double x, double y, double z) const noexcept;
  static float trilinear(const float* s, int row, int layer, float u, float v, float w) noexcept {
    const auto along = [u](const float* a) { return a[0] + u * (a[1] - a[0]); };
    const float near_low = along(s), near_high = along(s + row);
    const float far_low = along(s + layer), far_high = along(s + layer + row);
    const float low = near_low + v * (near_high - near_low), high = far_low + v * (far_high - far_low);
    return low + w * (high - low);
  }

  double voxel_ = 0, per_voxel_ = 0;
  Vec3 origin_ = Vec3::Zero();
  std::array<int, 3> blocks_{};
  std::array<double, 3> last_{};      // largest coordinates inside of the grid
  std::vector<std::int32_t> stored_;  // by block: index of its samples, or kCoarse
  std::vector<float> corners_;        // at the corners of all blocks [voxels]
  std::vector<float> samples_;        // kSamples for each stored block [voxels]
};

inline float DistanceField::inVoxels(double x, double y, double z) const noexcept {
  if (!isInside(x, y, z)) return beyond(x, y, z);
  const float* cell = cellAt(x, y, z);
  if (cell == nullptr) return coarseAt(x, y, z);
  return trilinear(cell, kSide, kSide * kSide, fraction(x), fraction(y), fraction(z));
}

}  // namespace presa
