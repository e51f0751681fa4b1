#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace presa::test {

/// What a person sees of a difference between two pictures of one size: the colours of CIELAB (1976, white D65) after
/// the blur of an eye that a line of one pixel does not reach, a binomial filter of 3 x 3 pixels in linear light.
/// A picture has width(), height() and at(x, y) with r, g, b of sRGB from 0 to 255.
class SeenDifference {
 public:
  /// Just noticeable for most people where two fields touch [Mahy, Van Eycken, Oosterlinck 1994].
  static constexpr double kJustNoticeable = 2.3;

  template <class A, class B>
  SeenDifference(const A& a, const B& b) : width_(a.width()), height_(a.height()) {
    const std::vector<Triple> here = linear(a), there = linear(b);
    deltas_.reserve(here.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Triple p = lab(blurred(here, x, y)), q = lab(blurred(there, x, y));
        deltas_.push_back(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    }
  }

  double mean() const {
    double sum = 0;
    for (const double delta : deltas_) sum += delta;
    return sum / static_cast<double>(deltas_.size());
  }
  double max() const { return *std::max_element(deltas_.begin(), deltas_.end()); }
  /// Number of pixels that differ by more than `delta`.
  int above(double delta) const {
    return static_cast<int>(std::count_if(deltas_.begin(), deltas_.end(), [=](double d) { return d > delta; }));
  }

 private:
  using Triple = std::array<double, 3>;

  template <class Picture>
  std::vector<Triple> linear(const Picture& picture) const {
    std::vector<Triple> all;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const auto c = picture.at(x, y);
        all.push_back({linear(c.r), linear(c.g), linear(c.b)});
      }
    }
    return all;
  }
  static double linear(int code) {  // IEC 61966-2-1
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  Triple blurred(const std::vector<Triple>& all, int x, int y) const {
    Triple sum{};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int column = std::clamp(x + dx, 0, width_ - 1), row = std::clamp(y + dy, 0, height_ - 1);
        const double weight = (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1) / 16.0;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * all[static_cast<std::size_t>(row * width_ + column)][i];
      }
    }
    return sum;
  }
  static Triple lab(const Triple& c) {
    const double x = share((0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505);
    const double y = share(0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]);
    const double z = share((0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
  }
  static double share(double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; }

  int width_, height_;
  std::vector<double> deltas_;
};

}  // namespace presa::test
