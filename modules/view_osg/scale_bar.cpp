#include "modules/view_osg/scale_bar.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace presa::view {
namespace {

constexpr float kScaleLeft = 20, kScaleBottom = 24, kScaleThick = 3, kScaleTick = 11;
constexpr double kLongest = 230;  ///< [lines]
constexpr double kScaleHalfHeight = 360;

osg::ref_ptr<osg::Geometry> box(float width, float height, const osg::Vec4& color) {
  return polygon({{0, 0}, {width, 0}, {width, height}, {0, height}}, color);
}

}  // namespace

double roundLength(double longest) {
  const double power = std::pow(10, std::floor(std::log10(longest)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= longest) return factor * power;
  return power;
}

ScaleBar::ScaleBar(osg::Group& left, const Ink& ink) {
  osg::ref_ptr<osg::MatrixTransform> place =
      new osg::MatrixTransform(osg::Matrixd::translate(kScaleLeft, kScaleBottom, 0));
  left.addChild(place);
  middle_->addChild(box(1, kScaleThick, ink.text));
  end_->addChild(box(kScaleThick, kScaleTick, ink.text));
  place->addChild(middle_);
  place->addChild(box(kScaleThick, kScaleTick, ink.text));
  place->addChild(end_);
  length_.emplace(*place, 0, kScaleTick + 8, 20, ink.text);
}

void ScaleBar::update(const CameraPose& pose) {
  const double slope = std::tan(kFieldOfView / 2 * std::numbers::pi / 180);
  const double lines_per_metre = kScaleHalfHeight / (slope * (pose.target - pose.eye).norm());
  const double length = roundLength(kLongest / lines_per_metre), lines = length * lines_per_metre;
  middle_->setMatrix(osg::Matrixd::scale(lines, 1, 1));
  end_->setMatrix(osg::Matrixd::translate(lines - kScaleThick, 0, 0));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), length < 0.9999 ? "%.4g mm" : "%.4g m",
                length < 0.9999 ? 1e3 * length : length);
  length_->set(text.data());
}

}  // namespace presa::view
