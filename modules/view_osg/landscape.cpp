#include "modules/view_osg/landscape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <osg/MatrixTransform>

#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr std::array kRings{1.0, 1.06, 1.15, 1.3, 1.55, 1.9, 2.4, 3.0, 3.7, 4.6, 5.6, 6.8, 8.2, 10.0, 12.0};
constexpr Roundness kHorizon{180, 1};

double step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 on the side of the sea: from some 50 degrees to the right of +y to 30 degrees to the left.
double seaward(double turn) {
  constexpr double kDegree = std::numbers::pi / 180;
  return step(-64 * kDegree, -44 * kDegree, turn) * (1 - step(20 * kDegree, 40 * kDegree, turn));
}

}  // namespace

double landHeight(double r, double turn) {
  const double out = step(1.0, 5.0, r), sea = seaward(turn);
  const double ridges = 0.62 + 0.20 * std::sin(3 * turn + 1.1) + 0.13 * std::sin(7 * turn + 0.4) +
                        0.06 * std::sin(17 * turn + 2.3 + r) + 0.03 * std::sin(41 * turn - 2 * r);
  // crest behind crest, each as high over the horizon as the next
  const double crests = 0.75 + 0.25 * std::sin(2.3 * r + 5 * turn);
  const double hills = out * ridges * crests * 0.085 * r;
  const double cliff = -0.9 * step(1.02, 2.2 + 0.4 * std::sin(9 * turn) + 0.15 * std::sin(31 * turn), r);
  return hills * (1 - sea) + cliff * sea;
}

osg::ref_ptr<osg::Node> makeLandscape(const Vec3& middle, double radius, double ground) {
  std::vector<ProfilePoint> profile;
  for (const double r : kRings) profile.push_back({r, 0, 0, 1});
  std::ranges::reverse(profile);  // seen from above
  const osg::ref_ptr<osg::Geometry> land = revolve(profile, Vec3::Ones(), kHorizon);
  auto& points = static_cast<osg::Vec3Array&>(*land->getVertexArray());
  auto& normals = static_cast<osg::Vec3Array&>(*land->getNormalArray());
  const auto heightAt = [](double x, double y) { return landHeight(std::hypot(x, y), std::atan2(-x, y)); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points[i].x(), y = points[i].y(), far = 0.02 * std::hypot(x, y);
    const double slope_x = (heightAt(x + far, y) - heightAt(x - far, y)) / (2 * far);
    const double slope_y = (heightAt(x, y + far) - heightAt(x, y - far)) / (2 * far);
    const bool edge = std::hypot(x, y) < 1.01;  // as level as the floor
    normals[i] = osg::Vec3d(edge ? 0 : -slope_x, edge ? 0 : -slope_y, 1);
    normals[i].normalize();
    points[i].z() = static_cast<float>(heightAt(x, y));
  }
  land->getOrCreateStateSet()->setAttributeAndModes(shaders::land());
  osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(
      osg::Matrixd::scale(radius, radius, radius) * osg::Matrixd::translate(middle.x(), middle.y(), ground));
  place->setName("land");
  place->addChild(land);
  // after the floor, before the sky
  place->getOrCreateStateSet()->setRenderBinDetails(5, "RenderBin");
  return place;
}

}  // namespace presa::view
