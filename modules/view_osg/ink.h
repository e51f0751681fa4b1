#pragma once
#include <osg/Vec4>

#include <algorithm>
#include <cmath>

#include "framework/core/math/spatial.h"
#include "framework/scene/picture_options.h"

namespace presa::view {

/// Colours of the head-up display, sRGB: light on dark panels over the scene, dark on light panels on paper.
struct Ink {
  osg::Vec4 text, soft, panel, track;
};

inline Ink inkOn(PictureOptions::Background background) {
  if (background == PictureOptions::Background::kScene)
    return {{0.95F, 0.97F, 1.0F, 1}, {0.95F, 0.97F, 1.0F, 0.66F}, {0.04F, 0.06F, 0.09F, 0.62F}, {1, 1, 1, 0.16F}};
  return {{0.07F, 0.09F, 0.12F, 1}, {0.07F, 0.09F, 0.12F, 0.72F}, {0.94F, 0.95F, 0.96F, 0.92F}, {0, 0, 0, 0.14F}};
}

/// A linear colour of the scene as the display shows it.
inline osg::Vec4 displayed(const Vec3& linear, float alpha = 1) {
  const auto code = [](double c) { return static_cast<float>(std::pow(std::clamp(c, 0.0, 1.0), 1 / 2.2)); };
  return {code(linear.x()), code(linear.y()), code(linear.z()), alpha};
}

}  // namespace presa::view
