#include "framework/geometry/field_sweep.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace presa {
namespace {

// Four points at once: GCC's and Clang's vectors compile to what the machine has, and compute each lane as a scalar.
using F4 = float __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));
using D2 = double __attribute__((vector_size(16)));

constexpr std::size_t kLanes = 4;

F4 load(const float* from) noexcept {
  F4 lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
void store(const F4& lanes, float* to) noexcept { std::memcpy(to, &lanes, sizeof lanes); }
F4 fourOf(float value) noexcept { return F4{value, value, value, value}; }

/// Coordinates of four points by axis.
struct Four {
  F4 x, y, z;
};

/// Row of a transform: a coordinate of four places from four points.
struct RowOfFour {
  RowOfFour(const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift, Eigen::Index axis) noexcept
      : by{fourOf(turn(axis, 0)), fourOf(turn(axis, 1)), fourOf(turn(axis, 2))}, at_origin(fourOf(shift[axis])) {}
  F4 of(const Four& p) const noexcept { return by.x * p.x + by.y * p.y + by.z * p.z + at_origin; }

  Four by;
  F4 at_origin;
};

Four byAxis(const float* points) noexcept {
  const F4 a = load(points), b = load(points + 4), c = load(points + 8);  // x y z x | y z x y | z x y z
  const F4 ab = __builtin_shufflevector(a, b, 1, 4, 2, 5), bc = __builtin_shufflevector(b, c, 2, 5, 3, 6);
  return {__builtin_shufflevector(a, bc, 0, 3, 4, 5), __builtin_shufflevector(ab, bc, 0, 1, 6, 7),
          __builtin_shufflevector(ab, c, 2, 3, 4, 7)};
}

/// The samples at both ends of an edge along x, of four cells.
struct EdgeOfFour {
  F4 low, high;
};

EdgeOfFour edgeOf(const float* const* cells, int at) noexcept {
  const auto two = [at](const float* a, const float* b) {  // both ends of both in one register
    double of_a, of_b;
    std::memcpy(&of_a, a + at, sizeof of_a);
    std::memcpy(&of_b, b + at, sizeof of_b);
    return reinterpret_cast<F4>(D2{of_a, of_b});
  };
  const F4 ab = two(cells[0], cells[1]), cd = two(cells[2], cells[3]);
  return {__builtin_shufflevector(ab, cd, 0, 2, 4, 6), __builtin_shufflevector(ab, cd, 1, 3, 5, 7)};
}

constexpr int kRow = 9, kLayer = kRow * kRow;  // steps from sample to sample along y and z

// The samples around a cell lie in two rows of two layers.
void fetch(const float* cell) noexcept {
  __builtin_prefetch(cell);
  __builtin_prefetch(cell + kRow + 1);
  __builtin_prefetch(cell + kLayer);
  __builtin_prefetch(cell + kLayer + kRow + 1);
}

constexpr std::array<float, 128> kNoSamples{};  // of points that have none: their result is replaced

}  // namespace

FieldSweep::FieldSweep(const DistanceField& field) noexcept : field_(field) {
  static_assert(kRow == DistanceField::kSide && kNoSamples.size() > kLayer + kRow + 1);
}

void FieldSweep::addOther(std::size_t point, double x, double y, double z) noexcept {
  samples_[point] = kNoSamples.data();
  other_[others_++] = {point, field_.inVoxels(x, y, z), field_.slopeInVoxels(x, y, z)};
}

void FieldSweep::add(double x, double y, double z) noexcept {
  const std::size_t point = count_++;
  const float* cell = field_.isInside(x, y, z) ? field_.cellAt(x, y, z) : nullptr;
  if (cell == nullptr) {
    in_cell_[0][point] = in_cell_[1][point] = in_cell_[2][point] = 0;
    return addOther(point, x, y, z);
  }
  samples_[point] = cell;
  in_cell_[0][point] = DistanceField::fraction(x);
  in_cell_[1][point] = DistanceField::fraction(y);
  in_cell_[2][point] = DistanceField::fraction(z);
}

void FieldSweep::place(const Eigen::Matrix3f& turn, const Eigen::Vector3f& shift,
                       std::span<const Eigen::Vector3f> points) noexcept {
  constexpr int kBlock = DistanceField::kBlock, kMask = kBlock - 1;
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kBlock));
  clear();
  count_ = points.size();
  const Four end{fourOf(static_cast<float>(kBlock * field_.blocks_[0])),
                 fourOf(static_cast<float>(kBlock * field_.blocks_[1])),
                 fourOf(static_cast<float>(kBlock * field_.blocks_[2]))};
  const RowOfFour to_x(turn, shift, 0), to_y(turn, shift, 1), to_z(turn, shift, 2);
  std::array<Eigen::Vector3f, kLanes> last;  // the last points, filled up
  for (std::size_t first = 0; first < count_; first += kLanes) {
    const float* from = points[first].data();
    if (first + kLanes > count_) {
      for (std::size_t l = 0; l < kLanes; ++l) last[l] = points[std::min(first + l, count_ - 1)];
      from = last[0].data();
    }
    const Four p = byAxis(from);
    const F4 x = to_x.of(p), y = to_y.of(p), z = to_z.of(p);
    const I4 inside = (x >= 0.0F) & (y >= 0.0F) & (z >= 0.0F) & (x < end.x) & (y < end.y) & (z < end.z);
    const I4 i = __builtin_convertvector(x, I4), j = __builtin_convertvector(y, I4), k = __builtin_convertvector(z, I4);
    store(x, &placed[0][first]), store(y, &placed[1][first]), store(z, &placed[2][first]);
    store(x - __builtin_convertvector(i, F4), &in_cell_[0][first]);
    store(y - __builtin_convertvector(j, F4), &in_cell_[1][first]);
    store(z - __builtin_convertvector(k, F4), &in_cell_[2][first]);
    const I4 bi = i >> kShift, bj = j >> kShift, bk = k >> kShift;
    const I4 in_block = ((i & kMask) + kRow * ((j & kMask) + kRow * (k & kMask))) | ~inside;  // negative: none
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float* cell = in_block[l] >= 0 ? field_.cellIn(bi[l], bj[l], bk[l], in_block[l]) : nullptr;
      if (cell != nullptr) {
        samples_[first + l] = cell;
        fetch(cell);
      } else if (first + l < count_) {
        addOther(first + l, static_cast<double>(x[l]), static_cast<double>(y[l]), static_cast<double>(z[l]));
      }
    }
  }
}

// The last four are filled up.
void FieldSweep::pad() noexcept {
  for (std::size_t point = count_; point % kLanes != 0; ++point) {
    samples_[point] = kNoSamples.data();
    in_cell_[0][point] = in_cell_[1][point] = in_cell_[2][point] = 0;
  }
}

// The order of the arithmetic is that of DistanceField's own queries.
template <bool kSlopes>
void FieldSweep::look() noexcept {
  pad();
  for (std::size_t first = 0; first < count_; first += kLanes) {
    const float* const* cells = &samples_[first];
    const F4 u = load(&in_cell_[0][first]), v = load(&in_cell_[1][first]), w = load(&in_cell_[2][first]);
    const EdgeOfFour a = edgeOf(cells, 0), b = edgeOf(cells, kRow), c = edgeOf(cells, kLayer),
                     d = edgeOf(cells, kLayer + kRow);
    const auto mix = [](const F4& t, const F4& low, const F4& high) { return low + t * (high - low); };
    const F4 at_a = mix(u, a.low, a.high), at_b = mix(u, b.low, b.high);
    const F4 at_c = mix(u, c.low, c.high), at_d = mix(u, d.low, d.high);
    store(mix(w, mix(v, at_a, at_b), mix(v, at_c, at_d)), &distance[first]);
    if constexpr (kSlopes) {
      store(mix(w, mix(v, a.high - a.low, b.high - b.low), mix(v, c.high - c.low, d.high - d.low)), &slope[0][first]);
      store(mix(w, mix(u, b.low - a.low, b.high - a.high), mix(u, d.low - c.low, d.high - c.high)), &slope[1][first]);
      store(mix(v, mix(u, c.low - a.low, c.high - a.high), mix(u, d.low - b.low, d.high - b.high)), &slope[2][first]);
    }
  }
  for (std::size_t i = 0; i < others_; ++i) {
    const Other& other = other_[i];
    distance[other.point] = other.distance;
    for (std::size_t axis = 0; kSlopes && axis < 3; ++axis)
      slope[axis][other.point] = other.slope[static_cast<Eigen::Index>(axis)];
  }
}

template void FieldSweep::look<false>() noexcept;
template void FieldSweep::look<true>() noexcept;

}  // namespace presa
