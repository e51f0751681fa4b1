#pragma once
#include <osg/Vec4>

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

}  // namespace presa::view
