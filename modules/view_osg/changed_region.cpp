#include "modules/view_osg/changed_region.h"

#include <algorithm>
#include <cmath>
#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/Transform>

namespace presa::view {
namespace {

constexpr int kPixelMargin = 2;  // [pixel]

class CornerCollector final : public osg::NodeVisitor {
 public:
  explicit CornerCollector(std::vector<Vec3>& corners)
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), corners_(corners) {}
  void apply(osg::Drawable& drawable) override {
    const osg::BoundingBox& box = drawable.getBoundingBox();
    if (!box.valid()) return;
    const osg::Matrixd to_world = osg::computeLocalToWorld(getNodePath());
    for (unsigned i = 0; i < 8; ++i) {
      const osg::Vec3d corner = osg::Vec3d(box.corner(i)) * to_world;
      corners_.emplace_back(corner.x(), corner.y(), corner.z());
    }
  }

 private:
  std::vector<Vec3>& corners_;
};

}  // namespace

void Changes::add(const Changes& more) {
  all = all || more.all;
  points.insert(points.end(), more.points.begin(), more.points.end());
}

PixelRect changedPixels(const Changes& changes, const osg::Matrixd& view_projection, int width, int height) {
  const PixelRect whole{0, 0, width, height};
  if (changes.all) return whole;
  if (changes.points.empty()) return {};
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  for (const Vec3& p : changes.points) {
    const osg::Vec4d clip = osg::Vec4d(p.x(), p.y(), p.z(), 1) * view_projection;
    if (!(clip.w() > 1e-6)) return whole;
    const double x = (0.5 + 0.5 * clip.x() / clip.w()) * width, y = (0.5 + 0.5 * clip.y() / clip.w()) * height;
    left = std::min(left, x), right = std::max(right, x);
    low = std::min(low, y), high = std::max(high, y);
  }
  const auto begin = [](double at, int size) {
    return static_cast<int>(std::clamp(std::floor(at) - kPixelMargin, 0.0, 1.0 * size));
  };
  const auto end = [](double at, int size) {
    return static_cast<int>(std::clamp(std::ceil(at) + kPixelMargin, 0.0, 1.0 * size));
  };
  const int x = begin(left, width), y = begin(low, height);
  return {x, y, end(right, width) - x, end(high, height) - y};
}

osg::Matrixd cropTo(const PixelRect& rect, int width, int height) {
  const double sx = 1.0 * width / rect.width, sy = 1.0 * height / rect.height;
  const double cx = 2 * (rect.x + 0.5 * rect.width) / width - 1, cy = 2 * (rect.y + 0.5 * rect.height) / height - 1;
  return osg::Matrixd::translate(-cx, -cy, 0) * osg::Matrixd::scale(sx, sy, 1);
}

void addCorners(osg::Node& node, std::vector<Vec3>& corners) {
  CornerCollector collector(corners);
  node.accept(collector);
}

}  // namespace presa::view
