#pragma once
#include <osg/MatrixTransform>
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "modules/view_osg/camera.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

/// Three axes of that length, x red, y green, z blue.
osg::ref_ptr<osg::Group> axisCross(double length);

/// `--show frames`, besides world and bodies (Overlays): the frames of the rig, the contact pose of each finger, and the
/// tangent frame of the face that it touches, each with its name (figure 8 of the PERCRO paper). In any picture: one
/// sentence while a user moves, slides or zooms a frame. Nodes exist once they are shown.
class FrameAxes {
 public:
  /// All must outlive this. `labels`: the group of the head-up display with its origin in the middle.
  FrameAxes(const World& world, osg::Group& space, osg::MatrixTransform& labels, const Ink& ink);
  void show(bool shown, const ViewFrame& frame);
  /// Places the names for the camera of the next frame.
  void seenFrom(const CameraPose& pose);

 private:
  struct Cross {
    osg::ref_ptr<osg::MatrixTransform> axes, place;  ///< in the space, of the name
    Vec3 p_W = Vec3::Zero();
    bool there = false;
  };
  void make();
  void add(const std::string& name, double length);
  void put(std::size_t cross, const Pose& X_WF);
  void hide(std::size_t cross);
  void showFingers(const ViewFrame& frame);
  Quat deviceAxes(const ViewFrame& frame, std::size_t finger) const;
  void say(const FrameState* frames);

  const World& world_;
  osg::Group& space_;
  osg::MatrixTransform& labels_;
  const Ink ink_;
  std::vector<std::size_t> stands_;  // by finger: index of its device's frame in the rig, or their number
  std::vector<Cross> crosses_;       // frames of the rig, contact poses, tangent frames
  osg::ref_ptr<osg::Group> group_ = new osg::Group, names_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> sentence_;  // once there is one
  osg::ref_ptr<osg::Geometry> panel_;
  std::vector<Label> text_;
  bool shown_ = false;
};

}  // namespace presa::view
