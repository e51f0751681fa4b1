#pragma once
#include <memory>
#include <osg/MatrixTransform>
#include <vector>

#include "framework/scene/joints/joint_motion.h"
#include "modules/view_osg/camera.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"
#include "modules/view_osg/joint_glyphs.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

/// `--show joints`: glyphs in the space, name and positions beside each. Nodes exist once they are shown; nothing before.
class ShownJoints {
 public:
  /// All must outlive this. `labels`: the group of the head-up display with its origin in the middle.
  ShownJoints(const Scene& scene, const BodyNodes& bodies, osg::Group& space, osg::MatrixTransform& labels,
              const Ink& ink);
  /// Call in every step while the joints are shown: angles then go on beyond half a turn. After a jump in time, and
  /// when the joints are shown again, they begin within half a turn of ViewFrame::joint_positions, without these of 0.
  void follow(const ViewFrame& frame);
  void show(bool shown, const ViewFrame& frame);
  /// Places the labels for the camera of the next frame.
  void seenFrom(const CameraPose& pose);

 private:
  struct JointLabel {
    osg::ref_ptr<osg::MatrixTransform> place;
    osg::ref_ptr<osg::Geometry> panel;
    Label text;
    std::size_t letters = 0;
    Vec3 p_W = Vec3::Zero();  ///< of the joint
  };
  void make();
  void write(JointLabel& label, const std::string& text);
  Rect placeOf(const JointLabel& label, double right, double up, const std::vector<Rect>& taken) const;
  std::string textOf(std::size_t j) const;

  const Scene& scene_;
  const BodyNodes& bodies_;
  osg::Group& space_;
  osg::MatrixTransform& labels_;
  const Ink ink_;
  std::unique_ptr<JointMotion> motion_;  // once they are shown
  std::unique_ptr<JointGlyphs> glyphs_;
  osg::ref_ptr<osg::Group> texts_ = new osg::Group;
  std::vector<JointLabel> beside_;
  bool shown_ = false;
  double time_ = 0;  // of the last frame followed [s]
};

}  // namespace presa::view
