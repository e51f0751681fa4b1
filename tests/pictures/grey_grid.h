#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/png_picture.h"

namespace presa::test {

/// Mean greys of a picture's fields, 64 across and 36 down, from 0 to 255: what is where, without its glyphs and edges.
class GreyGrid {
 public:
  static constexpr int kAcross = 64, kDown = 36;

  explicit GreyGrid(const PngPicture& picture) : greys_(kAcross * kDown) {
    std::vector<int> pixels(greys_.size());
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const Color c = picture.at(x, y);
        const auto field =
            static_cast<std::size_t>(y * kDown / picture.height() * kAcross + x * kAcross / picture.width());
        greys_[field] += 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;  // luma of ITU-R BT.601
        ++pixels[field];
      }
    }
    for (std::size_t i = 0; i < greys_.size(); ++i) greys_[i] /= std::max(pixels[i], 1);
  }

  struct Difference {
    double mean = 0, max = 0;
  };
  Difference from(const GreyGrid& other) const {
    Difference difference;
    for (std::size_t i = 0; i < greys_.size(); ++i) {
      const double here = std::abs(greys_[i] - other.greys_[i]);
      difference.mean += here / static_cast<double>(greys_.size());
      difference.max = std::max(difference.max, here);
    }
    return difference;
  }

 private:
  std::vector<double> greys_;
};

}  // namespace presa::test
