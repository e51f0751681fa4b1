#pragma once
#include "framework/haptics/height_pattern.h"
#include "modules/texture_image/grey_image.h"

namespace presa {

/// An image as a smooth pattern over the plane (u, v), in tiles: u to the right, v up, pixel centres at
/// (i + 1/2) / width. s is the uniform bicubic B-spline whose control points are the pixels, black -1, white 1, repeated
/// without end. It is twice continuously differentiable and, as a mean of control points, stays between them; a sine of
/// n pixels comes out (2 + cos(2 pi / n)) / 3 as high.
class HeightMap {
 public:
  explicit HeightMap(const GreyImage& image);
  /// Thread: any; nonblocking.
  PatternValue at(double u, double v) const noexcept;
  /// Upper bounds of the slopes: the largest steps between neighbours.
  double maxSlopeU() const noexcept { return max_du_; }
  double maxSlopeV() const noexcept { return max_dv_; }
  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }

 private:
  int width_, height_;
  std::vector<float> s_;  // rows from bottom to top
  double max_du_ = 0, max_dv_ = 0;
};

}  // namespace presa
