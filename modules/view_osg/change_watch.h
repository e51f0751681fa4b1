#pragma once
#include <osg/Group>
#include <vector>

#include "modules/view_osg/changed_region.h"
#include "modules/view_osg/scene_nodes.h"

namespace presa::view {

/// Finds what differs from the last drawn frame: bodies that moved and their shadows, and other parts (fingers, arrows,
/// guides, lines) that moved or changed their colour.
class ChangeWatch {
 public:
  /// `bodies` must outlive this. Shadows fall away from `lights` (unit vectors towards them), down to the height
  /// `lowest` [m].
  ChangeWatch(BodyNodes& bodies, std::vector<Vec3> lights, double lowest);

  /// After the bodies' shapes have been replaced.
  void measureShapes();
  /// Everything will be drawn anew.
  void changeAll() { changes_.all = true; }
  struct Frame {
    const std::vector<Pose>& X_WB;
    osg::Node& casters;                     ///< parts with a shadow besides the bodies
    const std::vector<osg::Node*>& others;  ///< parts that move, with those casters
    const std::vector<double>& appearance;  ///< what the colours of these parts depend on
    double tolerance;                       ///< smaller motions cannot be seen [m]
  };
  /// Compares with the last frame. True if a shadow moved.
  bool update(const Frame& frame);
  /// What has changed since the last call.
  Changes take();

 private:
  bool updateBodies(const std::vector<Pose>& X_WB, double tolerance);
  void addWithShadow(const std::vector<Vec3>& corners);

  BodyNodes& bodies_;
  std::vector<Vec3> lights_;
  double lowest_;
  std::vector<std::vector<Vec3>> shapes_;  // corners in the body's frame; empty: not drawn
  std::vector<Pose> drawn_;                // poses at which the bodies were drawn
  std::vector<Vec3> casters_, others_;     // corners as drawn, eight a part
  std::vector<double> appearance_;
  Changes changes_;
};

}  // namespace presa::view
