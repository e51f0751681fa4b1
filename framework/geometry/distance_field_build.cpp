#include <atomic>
#include <thread>

#include "framework/geometry/distance_field.h"

namespace presa {
namespace {

constexpr double kRounded = 1.0001;  // a known bound of a distance, above its rounding

/// Calls work(i) for i < count on two threads, in no order. False: told to stop. `from` to `to`: the share of the whole.
template <class Work>
bool onTwoThreads(std::size_t count, double from, double to, const GoOn& go_on, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  constexpr std::size_t kAtOnce = 16;
  const auto take = [&](bool tells) {
    for (std::size_t first = next.fetch_add(kAtOnce); first < count && !stop; first = next.fetch_add(kAtOnce)) {
      for (std::size_t i = first; i < std::min(first + kAtOnce, count); ++i) work(i);
      const double done = static_cast<double>(first) / static_cast<double>(count);
      if (tells && go_on && !go_on(from + (to - from) * done)) stop = true;
    }
  };
  std::thread other([&] { take(false); });
  take(true);
  other.join();
  return !stop;
}

}  // namespace

std::optional<DistanceField> DistanceField::build(const Exact& exact, const AxisBox& bounds, const Settings& settings,
                                                  Size* size) {
  DistanceField field;
  Size needed;
  const Vec3 extent = (bounds.high - bounds.low) / (kBlock * settings.voxel);
  // a grid whose corners alone exceed the memory is not even laid
  if (const double corners = (extent.array() + 3).prod() * (sizeof(float) + sizeof(std::int32_t));
      !(corners <= static_cast<double>(settings.max_bytes))) {
    needed.bytes = corners < 1e18 ? static_cast<std::size_t>(corners) : std::numeric_limits<std::size_t>::max();
    if (size != nullptr) *size = needed;
    return std::nullopt;
  }
  field.lay(bounds, settings.voxel);
  if (!field.sampleCorners(exact, settings)) return std::nullopt;
  field.chooseBlocks(exact, settings.band);
  needed.blocks = field.blocks_;
  needed.stored = static_cast<std::size_t>(
      std::count_if(field.stored_.begin(), field.stored_.end(), [](std::int32_t i) { return i != kCoarse; }));
  needed.bytes = field.roomBytes() + needed.stored * kSamples * sizeof(float);
  if (size != nullptr) *size = needed;
  if (needed.bytes > settings.max_bytes || !field.sampleBlocks(exact, settings)) return std::nullopt;
  return field;
}

void DistanceField::lay(const AxisBox& bounds, double voxel) {
  voxel_ = voxel;
  per_voxel_ = 1 / voxel;
  const Vec3 middle = (bounds.low + bounds.high) / 2, extent = bounds.high - bounds.low;
  for (Eigen::Index a = 0; a < 3; ++a) {
    // half a block of air around the solid
    const int blocks = static_cast<int>(std::ceil(extent[a] / (kBlock * voxel) + 1));
    blocks_[static_cast<std::size_t>(a)] = blocks;
    last_[static_cast<std::size_t>(a)] = std::nextafter(kBlock * blocks, 0.0);
    origin_[a] = middle[a] - kBlock * voxel * blocks / 2;
  }
}

bool DistanceField::sampleCorners(const Exact& exact, const Settings& settings) {
  const int nx = blocks_[0] + 1, ny = blocks_[1] + 1, nz = blocks_[2] + 1;
  corners_.resize(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz));
  const std::size_t rows = static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz);
  return onTwoThreads(rows, 0, 0.1, settings.go_on, [&](std::size_t row) {
    double bound = 1e150;
    for (int i = 0; i < nx; ++i) {
      const auto j = static_cast<int>(row % static_cast<std::size_t>(ny)),
                 k = static_cast<int>(row / static_cast<std::size_t>(ny));
      const double distance = exact(origin_ + kBlock * voxel_ * Vec3(i, j, k), bound);
      corners_[row * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i)] =
          static_cast<float>(distance * per_voxel_);
      bound = kRounded * (std::abs(distance) + kBlock * voxel_);
    }
  });
}

Vec3 DistanceField::cornerOf(std::size_t block) const noexcept {
  const auto nx = static_cast<std::size_t>(blocks_[0]), ny = static_cast<std::size_t>(blocks_[1]);
  return origin_ + kBlock * voxel_ *
                       Vec3(static_cast<double>(block % nx), static_cast<double>(block / nx % ny),
                            static_cast<double>(block / nx / ny));
}

void DistanceField::chooseBlocks(const Exact& exact, double band) {
  stored_.assign(blockCount(), kCoarse);
  std::int32_t count = 0;
  const double half_diagonal = std::sqrt(3.0) / 2 * kBlock * voxel_, reach = half_diagonal + band * voxel_;
  const auto nx = static_cast<std::size_t>(blocks_[0]), ny = static_cast<std::size_t>(blocks_[1]);
  for (std::size_t b = 0; b < stored_.size(); ++b) {
    const std::size_t corner = b % nx + (nx + 1) * (b / nx % ny + (ny + 1) * (b / nx / ny));
    const double there = voxel_ * std::abs(static_cast<double>(corners_[corner]));
    if (there > reach + half_diagonal) continue;
    const Vec3 centre = cornerOf(b) + Vec3::Constant(kBlock * voxel_ / 2);
    if (std::abs(exact(centre, kRounded * (there + half_diagonal))) <= reach) stored_[b] = count++;
  }
}

bool DistanceField::sampleBlocks(const Exact& exact, const Settings& settings) {
  std::vector<std::size_t> wanted;
  for (std::size_t b = 0; b < stored_.size(); ++b) {
    if (stored_[b] != kCoarse) wanted.push_back(b);
  }
  samples_.resize(wanted.size() * kSamples);
  return onTwoThreads(wanted.size(), 0.1, 1, settings.go_on,
                      [&](std::size_t i) { sampleBlock(exact, wanted[i], samples_.data() + i * kSamples); });
}

// There and back again, so that each sample bounds the next.
void DistanceField::sampleBlock(const Exact& exact, std::size_t block, float* out) const {
  const Vec3 corner = cornerOf(block);
  double bound = 1e150;
  bool back = false;
  for (int k = 0; k < kSide; ++k) {
    for (int m = 0; m < kSide; ++m) {
      const int j = k % 2 == 0 ? m : kSide - 1 - m;
      for (int n = 0; n < kSide; ++n) {
        const int i = back ? kSide - 1 - n : n;
        const double distance = exact(corner + voxel_ * Vec3(i, j, k), bound);
        out[i + kSide * (j + kSide * k)] = static_cast<float>(distance * per_voxel_);
        bound = kRounded * (std::abs(distance) + voxel_);
      }
      back = !back;
    }
  }
}

}  // namespace presa
