#pragma once
#include <osg/Geometry>
#include <vector>

#include "framework/core/state/finger_neighbourhood.h"
#include "framework/scene/world.h"

namespace presa::view {

/// Draws, as lines, the triangles near the fingers on the bodies listed in the collision thread's neighbourhoods.
class NeighbourhoodLines {
 public:
  explicit NeighbourhoodLines(const World& world);
  osg::Node* root() { return lines_; }
  /// Poses in the order of Scene::bodies.
  void update(bool shown, const FingerNeighbourhoods* neighbourhoods, const std::vector<Pose>& X_WB);

 private:
  const World& world_;
  osg::ref_ptr<osg::Geometry> lines_ = new osg::Geometry;
};

}  // namespace presa::view
