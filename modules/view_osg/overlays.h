#pragma once
#include <array>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/scene/world.h"
#include "modules/view_osg/shown_parts.h"

namespace presa::view {

/// Lines and axes over the bodies: haptic and physics geometry, sleeping bodies, frames. Each is created when first
/// shown.
class Overlays {
 public:
  explicit Overlays(const World& world) : world_(world) {}
  osg::Group* root() { return root_; }
  /// `X_WB` and `asleep` in the order of Scene::bodies.
  void update(const ShownParts& parts, const std::vector<Pose>& X_WB, const std::vector<bool>& asleep);

 private:
  struct Layer {
    osg::ref_ptr<osg::Group> group;  ///< null until first shown
    std::vector<osg::ref_ptr<osg::MatrixTransform>> bodies;
  };
  Layer make(ShownPart part) const;

  const World& world_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::array<Layer, kShownPartNames.size()> layers_;
};

}  // namespace presa::view
