#pragma once
#include <osg/Geometry>
#include <vector>

#include "framework/state/contact_patch.h"

namespace presa::view {

/// The triangles that the collision query found near the fingers, as lines on the bodies.
class PatchLines {
 public:
  PatchLines();
  osg::Node* root() { return lines_; }
  /// Poses as Scene::bodies.
  void update(bool shown, const ContactPatches* patches, const std::vector<Pose>& X_WB);

 private:
  osg::ref_ptr<osg::Geometry> lines_ = new osg::Geometry;
};

}  // namespace presa::view
