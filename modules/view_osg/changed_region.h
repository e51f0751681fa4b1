#pragma once
#include <osg/Matrixd>
#include <osg/Node>
#include <vector>

#include "framework/core/math/spatial.h"

namespace presa::view {

/// What differs from the last drawn frame: points [m, world] whose convex hulls contain it, or everything.
struct Changes {
  bool all = true;
  std::vector<Vec3> points;

  void add(const Changes& more);
};

/// Rectangle of pixels; the origin is the picture's lower left corner.
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
};

/// The pixels of a picture of `width` times `height` in which `changes` can be seen, with a margin of 2 pixels for
/// filters and lines. The whole picture if a point is not in front of the eye.
PixelRect changedPixels(const Changes& changes, const osg::Matrixd& view_projection, int width, int height);

/// Maps clip space so that the pixels of `rect` fill a viewport of their size; apply after a projection.
osg::Matrixd cropTo(const PixelRect& rect, int width, int height);

/// Adds the corners of all visible drawables below `node`.
void addCorners(osg::Node& node, std::vector<Vec3>& corners);

}  // namespace presa::view
