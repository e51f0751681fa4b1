#pragma once
#include <osg/Geometry>
#include <vector>

#include "framework/scene/world.h"
#include "framework/core/state/contact_patch.h"

namespace presa::view {

/// The triangles nearest to the fingers on the bodies that the collision query lists, as lines.
class PatchLines {
 public:
  explicit PatchLines(const World& world);
  osg::Node* root() { return lines_; }
  /// Poses as Scene::bodies.
  void update(bool shown, const ContactPatches* patches, const std::vector<Pose>& X_WB);

 private:
  const World& world_;
  osg::ref_ptr<osg::Geometry> lines_ = new osg::Geometry;
};

}  // namespace presa::view
