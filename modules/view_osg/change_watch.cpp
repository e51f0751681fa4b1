#include "modules/view_osg/change_watch.h"

#include <algorithm>
#include <osg/ComputeBoundsVisitor>
#include <span>

namespace presa::view {
namespace {

constexpr double kShadowBlur = 0.006;  ///< a shadow reaches beyond its caster's outline by this much [m]

bool differ(std::span<const Vec3> a, std::span<const Vec3> b, double tolerance) {
  return !std::ranges::equal(a, b, [=](const Vec3& p, const Vec3& q) { return (p - q).norm() < tolerance; });
}

std::vector<Vec3> placed(const std::vector<Vec3>& corners, const Pose& X_WB) {
  std::vector<Vec3> all;
  for (const Vec3& corner : corners) all.push_back(X_WB.p + X_WB.q * corner);
  return all;
}

}  // namespace

ChangeWatch::ChangeWatch(BodyNodes& bodies, std::vector<Vec3> lights, double lowest)
    : bodies_(bodies), lights_(std::move(lights)), lowest_(lowest) {
  measureShapes();
}

void ChangeWatch::measureShapes() {
  shapes_.assign(bodies_.count(), {});
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    osg::Node* const shape = bodies_.shape(i);
    if (shape == nullptr) continue;
    osg::ComputeBoundsVisitor visitor;
    shape->accept(visitor);
    osg::BoundingBox box = visitor.getBoundingBox();
    if (!box.valid()) continue;
    for (unsigned corner = 0; corner < 8; ++corner)
      shapes_[i].emplace_back(box.corner(corner).x(), box.corner(corner).y(), box.corner(corner).z());
  }
  changes_.all = true;
}

bool ChangeWatch::update(const Frame& frame) {
  if (changes_.all) changes_.points.clear();  // they say no more, and nobody may take them
  bool moved = updateBodies(frame.X_WB, frame.tolerance);
  std::vector<Vec3> casters, others;
  addCorners(frame.casters, casters);
  for (osg::Node* node : frame.others) addCorners(*node, others);
  if (differ(casters, casters_, frame.tolerance)) {
    addWithShadow(casters_);
    addWithShadow(casters);
    casters_ = std::move(casters);
    moved = true;
  }
  const bool recolored = std::exchange(appearance_, frame.appearance) != frame.appearance;
  if (recolored || others.size() != others_.size()) {
    for (const auto* corners : {&others_, &others})
      changes_.points.insert(changes_.points.end(), corners->begin(), corners->end());
    others_ = std::move(others);
    return moved;
  }
  for (std::size_t i = 0; i < others.size(); i += 8) {
    const std::span<Vec3> now(&others[i], 8), before(&others_[i], 8);
    if (!differ(now, before, frame.tolerance)) continue;
    for (const auto& corners : {before, now})
      changes_.points.insert(changes_.points.end(), corners.begin(), corners.end());
    std::ranges::copy(now, before.begin());
  }
  return moved;
}

bool ChangeWatch::updateBodies(const std::vector<Pose>& X_WB, double tolerance) {
  bool moved = drawn_.size() != X_WB.size();
  if (moved) drawn_ = X_WB, changes_.all = true;
  for (std::size_t i = 0; i < drawn_.size() && i < shapes_.size(); ++i) {
    const std::vector<Vec3> before = placed(shapes_[i], drawn_[i]), now = placed(shapes_[i], X_WB[i]);
    if (!differ(before, now, tolerance)) continue;
    addWithShadow(before);
    addWithShadow(now);
    drawn_[i] = X_WB[i];
    moved = true;
  }
  return moved;
}

void ChangeWatch::addWithShadow(const std::vector<Vec3>& corners) {
  for (const Vec3& p : corners) {
    changes_.points.push_back(p);
    for (const Vec3& light : lights_) {
      const Vec3 foot = p - std::max(0.0, (p.z() - lowest_) / light.z()) * light;
      for (const double side : {-kShadowBlur, kShadowBlur}) {
        changes_.points.emplace_back(foot + side * Vec3(1, 1, 0));
        changes_.points.emplace_back(foot + side * Vec3(1, -1, 0));
      }
    }
  }
}

Changes ChangeWatch::take() { return std::exchange(changes_, Changes{.all = false, .points = {}}); }

}  // namespace presa::view
