#include "modules/texture_image/height_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace presa {
namespace {

/// Weights of four neighbours and their slopes, at t from 0 to 1 between the second and the third [Unser1999 eq. 2].
struct Weights {
  explicit Weights(double t) noexcept {
    const double r = 1 - t;
    w = {r * r * r / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * r * r + 3 * r * r * r) / 6, t * t * t / 6};
    slope = {-r * r / 2, (3 * t * t - 4 * t) / 2, (4 * r - 3 * r * r) / 2, t * t / 2};
  }
  std::array<double, 4> w, slope;
};

/// A place on an axis of `count` pixels: four neighbours, of which the second lies before it, and the rest.
struct Cell {
  Cell(double place, int count) noexcept {
    const double x = (place - std::floor(place)) * count - 0.5, first = std::floor(x);
    rest = x - first;
    for (int i = 0; i < 4; ++i) {
      const int index = static_cast<int>(first) - 1 + i;
      // the image repeats; it may have one pixel
      pixel[static_cast<std::size_t>(i)] = static_cast<std::size_t>(((index % count) + count) % count);
    }
  }
  double rest = 0;
  std::array<std::size_t, 4> pixel{};
};

}  // namespace

HeightMap::HeightMap(const GreyImage& image) : width_(image.width), height_(image.height) {
  const auto w = static_cast<std::size_t>(width_), h = static_cast<std::size_t>(height_);
  s_.resize(w * h);
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) s_[y * w + x] = 2 * image.value[(h - 1 - y) * w + x] - 1;
  }
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      const double here = s_[y * w + x];
      max_du_ = std::max(max_du_, std::abs(s_[y * w + (x + 1) % w] - here) * width_);
      max_dv_ = std::max(max_dv_, std::abs(s_[(y + 1) % h * w + x] - here) * height_);
    }
  }
}

PatternValue HeightMap::at(double u, double v) const noexcept {
  const Cell column(u, width_), row(v, height_);
  const Weights across(column.rest), up(row.rest);
  PatternValue sum;
  for (std::size_t j = 0; j < 4; ++j) {
    const float* const line = s_.data() + row.pixel[j] * static_cast<std::size_t>(width_);
    double value = 0, slope = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double s = line[column.pixel[i]];
      value += across.w[i] * s;
      slope += across.slope[i] * s;
    }
    sum.s += up.w[j] * value;
    sum.ds_du += up.w[j] * slope;
    sum.ds_dv += up.slope[j] * value;
  }
  sum.ds_du *= width_;
  sum.ds_dv *= height_;
  return sum;
}

}  // namespace presa
