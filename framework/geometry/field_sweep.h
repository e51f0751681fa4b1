#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framework/geometry/distance_field.h"

namespace presa {

/// Looks up many points of a DistanceField, four at once: all places first, so that the processor fetches the samples of
/// the next points while it works on those of the last ones. The same bits on every machine. All in voxels of the field,
/// from its origin. It holds no memory beyond itself. Thread: any, nonblocking; one thread per object.
class FieldSweep {
 public:
  static constexpr std::size_t kMax = 64;  ///< points at once
  using Row = std::array<float, kMax>;     ///< a number for each point

  /// The field must outlive it.
  explicit FieldSweep(const DistanceField& field) noexcept;

  /// Begins anew with these points, at most kMax, at turn * p + shift. In single precision: a place is off by up to three
  /// parts in 10^7 of the grid's side.
  void place(const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift,
             std::span<const Eigen::Vector3f> points) noexcept;
  /// Begins anew without a point.
  void clear() noexcept { count_ = others_ = 0; }
  /// Adds a point, the kMax-th at the most, after points that were added likewise. As exact as DistanceField::inVoxels().
  void add(double x, double y, double z) noexcept;
  std::size_t count() const noexcept { return count_; }  ///< points

  /// Fills distance: DistanceField::inVoxels() of each point, to the last bit.
  void lookUp() noexcept { look<false>(); }
  /// Fills slope, too: DistanceField::slopeInVoxels().
  void lookUpSlopes() noexcept { look<true>(); }

  // beyond the last point, up to a multiple of four: zero
  alignas(16) Row distance;               ///< in voxels, negative inside
  alignas(16) std::array<Row, 3> slope;   ///< by axis
  alignas(16) std::array<Row, 3> placed;  ///< by axis; only of points from place()

 private:
  /// A point that has no samples of its own: outside of the narrow band.
  struct Other {
    std::size_t point;
    float distance;
    Eigen::Vector3f slope;
  };
  template <bool kSlopes>
  void look() noexcept;
  void addOther(std::size_t point, double x, double y, double z) noexcept;
  void pad() noexcept;

  const DistanceField& field_;
  std::size_t count_ = 0, others_ = 0;
  std::array<const float*, kMax> samples_;  // of the cell of each point
  alignas(16) std::array<Row, 3> in_cell_;  // place within it, by axis
  std::array<Other, kMax> other_;
};

}  // namespace presa
