#include "framework/geometry/distance_field.h"

#include <bit>
#include <cstring>
#include <limits>

namespace presa {
namespace {

constexpr std::uint64_t kFieldKind = 0x31646C6569467250;  // "PrField1"

}  // namespace

AxisBox DistanceField::box() const noexcept {
  return {origin_, origin_ + kBlock * voxel_ * Vec3(blocks_[0], blocks_[1], blocks_[2])};
}

std::size_t DistanceField::roomBytes() const noexcept {
  return sizeof(float) * (samples_.capacity() + corners_.capacity()) + sizeof(std::int32_t) * stored_.capacity();
}

Vec3 DistanceField::gradient(const Vec3& p) const noexcept {
  Vec3 gradient;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    gradient[axis] = (at(p + voxel_ * Vec3::Unit(axis)) - at(p - voxel_ * Vec3::Unit(axis))) / (2 * voxel_);
  return gradient;
}

Eigen::Vector3f DistanceField::slopeInVoxels(double x, double y, double z) const noexcept {
  const float* s = isInside(x, y, z) ? cellAt(x, y, z) : nullptr;
  if (s == nullptr) return Eigen::Vector3f::Zero();
  const float u = fraction(x), v = fraction(y), w = fraction(z);
  const auto mix = [](float t, float a, float b) { return a + t * (b - a); };
  const int row = kSide, layer = kSide * kSide;
  const auto rise = [&](int at, int step) { return s[at + step] - s[at]; };
  return {mix(w, mix(v, rise(0, 1), rise(row, 1)), mix(v, rise(layer, 1), rise(layer + row, 1))),
          mix(w, mix(u, rise(0, row), rise(1, row)), mix(u, rise(layer, row), rise(layer + 1, row))),
          mix(v, mix(u, rise(0, layer), rise(1, layer)), mix(u, rise(row, layer), rise(row + 1, layer)))};
}

double DistanceField::nearestSample(const Vec3& p, Vec3& place) const noexcept {
  const Vec3 g = (p - origin_) * per_voxel_;
  place = p;
  if ((g.array() < 0).any() || g.x() > last_[0] || g.y() > last_[1] || g.z() > last_[2]) return at(p);
  const Eigen::Array3d block = (g / kBlock).array().floor();
  const auto index = static_cast<std::size_t>(block.x() + blocks_[0] * (block.y() + blocks_[1] * block.z()));
  if (stored_[index] == kCoarse) return at(p);
  const Eigen::Array3d sample = g.array().round();
  const Eigen::Array3i in_block = (sample - kBlock * block).cast<int>();
  place = origin_ + voxel_ * sample.matrix();
  const std::size_t i = static_cast<std::size_t>(stored_[index]) * kSamples +
                        static_cast<std::size_t>(in_block.x() + kSide * (in_block.y() + kSide * in_block.z()));
  return voxel_ * static_cast<double>(samples_[i]);
}

double DistanceField::lowerBound(const Vec3& p) const noexcept {
  // A distance changes by no more than the way; the nearest sample is at most half a diagonal away.
  constexpr double kHalfDiagonal = 0.8660254037844387;
  const Vec3 g = (p - origin_) * per_voxel_;
  if ((g.array() < 0).any() || g.x() > last_[0] || g.y() > last_[1] || g.z() > last_[2])
    return voxel_ * static_cast<double>(beyond(g.x(), g.y(), g.z()));
  const Vec3 block = (g / kBlock).array().floor().min(Eigen::Array3d(blocks_[0], blocks_[1], blocks_[2]) - 1);
  const auto index = static_cast<std::size_t>(block.x() + blocks_[0] * (block.y() + blocks_[1] * block.z()));
  if (stored_[index] != kCoarse) return at(p) - 2 * kHalfDiagonal * voxel_;
  const Vec3 corner = (g / kBlock).array().round();
  const auto c = static_cast<std::size_t>(corner.x() + (blocks_[0] + 1) * (corner.y() + (blocks_[1] + 1) * corner.z()));
  const double there = static_cast<double>(corners_[c]), way = (g - kBlock * corner).norm();
  return voxel_ * (there - way);
}

float DistanceField::coarseAt(double x, double y, double z) const noexcept {
  constexpr double kPerBlock = 1.0 / kBlock;
  const double g[3] = {x * kPerBlock, y * kPerBlock, z * kPerBlock};
  const int i = static_cast<int>(g[0]), j = static_cast<int>(g[1]), k = static_cast<int>(g[2]);
  const int row = blocks_[0] + 1, layer = row * (blocks_[1] + 1);
  return trilinear(corners_.data() + i + row * j + static_cast<std::ptrdiff_t>(layer) * k, row, layer,
                   static_cast<float>(g[0] - i), static_cast<float>(g[1] - j), static_cast<float>(g[2] - k));
}

// The surface is inside of the grid, so the way to the grid is a lower bound.
float DistanceField::beyond(double x, double y, double z) const noexcept {
  const auto out = [](double a, double last) { return std::max({-a, a - last, 0.0}); };
  const double way = std::hypot(out(x, last_[0]), out(y, last_[1]), out(z, last_[2]));
  return static_cast<float>(std::min(way, 1e30));
}

std::string DistanceField::bytes() const {
  std::string out;
  const auto put = [&](const void* from, std::size_t size) { out.append(static_cast<const char*>(from), size); };
  put(&kFieldKind, sizeof kFieldKind);
  put(&voxel_, sizeof voxel_);
  put(origin_.data(), 3 * sizeof(double));
  put(blocks_.data(), sizeof blocks_);
  put(stored_.data(), stored_.size() * sizeof(std::int32_t));
  put(corners_.data(), corners_.size() * sizeof(float));
  put(samples_.data(), samples_.size() * sizeof(float));
  return out;
}

std::optional<DistanceField> DistanceField::fromBytes(const std::string& bytes) {
  DistanceField field;
  std::size_t used = 0;
  const auto get = [&](void* to, std::size_t size) {
    if (size > bytes.size() - used) return false;
    std::memcpy(to, bytes.data() + used, size);
    used += size;
    return true;
  };
  std::uint64_t kind = 0;
  double voxel = 0;
  Vec3 origin;
  if (!get(&kind, sizeof kind) || kind != kFieldKind || !get(&voxel, sizeof voxel) ||
      !get(origin.data(), 3 * sizeof(double)) || !get(field.blocks_.data(), sizeof field.blocks_))
    return std::nullopt;
  const auto [x, y, z] = field.blocks_;
  constexpr int kMost = 4096;
  if (!(voxel > 0) || !origin.allFinite() || std::min({x, y, z}) < 1 || std::max({x, y, z}) > kMost)
    return std::nullopt;
  const std::size_t corners = std::size_t{1} * static_cast<std::size_t>(x + 1) * static_cast<std::size_t>(y + 1) *
                              static_cast<std::size_t>(z + 1);
  if (corners > bytes.size()) return std::nullopt;
  field.stored_.resize(field.blockCount());
  field.corners_.resize(corners);
  if (!get(field.stored_.data(), field.stored_.size() * sizeof(std::int32_t)) ||
      !get(field.corners_.data(), corners * sizeof(float)))
    return std::nullopt;
  const std::size_t left = bytes.size() - used;
  if (left % (kSamples * sizeof(float)) != 0) return std::nullopt;
  field.samples_.resize(left / sizeof(float));
  if (!get(field.samples_.data(), left)) return std::nullopt;
  const auto stored = static_cast<std::int32_t>(field.storedBlocks());
  const auto is_sound = [&](std::int32_t index) { return index >= kCoarse && index < stored; };
  const auto is_finite = [](float value) { return std::isfinite(value); };
  if (!std::all_of(field.stored_.begin(), field.stored_.end(), is_sound) ||
      !std::all_of(field.corners_.begin(), field.corners_.end(), is_finite) ||
      !std::all_of(field.samples_.begin(), field.samples_.end(), is_finite))
    return std::nullopt;
  field.voxel_ = voxel;
  field.per_voxel_ = 1 / voxel;
  field.origin_ = origin;
  for (std::size_t a = 0; a < 3; ++a) field.last_[a] = std::nextafter(kBlock * field.blocks_[a], 0.0);
  return field;
}

}  // namespace presa
