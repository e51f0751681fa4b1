#pragma once
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/Uniform>

#include "framework/assembly/assembly_guide.h"
#include "modules/view_osg/scene_nodes.h"

namespace presa::view {

/// Marks in the scene for the user of an assembly: the outline of a block at its goal, or of the missing block below
/// it, and an arrow over the block of a hint.
class Guides {
 public:
  Guides(const Scene& scene, BodyNodes& bodies);
  osg::Group* root() { return root_; }
  /// Whether any mark is shown; marks pulsate.
  bool shown() const;
  void update(const Guidance& guidance, const std::vector<Pose>& X_WB, double time);

 private:
  struct Outline {
    osg::ref_ptr<osg::MatrixTransform> place;
    osg::ref_ptr<osg::Uniform> opacity;
    std::int32_t body = kNoBody;
  };
  Outline makeOutline(const Vec3& color);
  void show(Outline& outline, std::int32_t goal, std::int32_t body, const std::vector<Pose>& X_WB, float opacity);
  void showArrow(std::int32_t body, const std::vector<Pose>& X_WB, double time);

  const Scene& scene_;
  BodyNodes& bodies_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  Outline place_, missing_;
  osg::ref_ptr<osg::MatrixTransform> arrow_ = new osg::MatrixTransform;
};

}  // namespace presa::view
