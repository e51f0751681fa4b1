#pragma once
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>

#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/lesson.h"

namespace presa::view {

/// An animated hand on a mouse that shows a visitor how to drag, pinch, lift and turn, with the words of the scene.
/// Coordinates: origin at the lower left corner of a picture 720 lines high; the panel is in its upper left one.
class ShowHow {
 public:
  /// `parent`: of the head-up display; `scene`, with an assembly, must outlive this.
  ShowHow(osg::Group& parent, const Scene& scene);
  void update(const ViewFrame& frame, const std::vector<FingerView>& fingers);

 private:
  void addMouse();
  void addKeys();
  void animate(double time);

  const Scene& scene_;
  Lesson lesson_;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> mouse_ = new osg::MatrixTransform, finger_ = new osg::MatrixTransform;
  osg::ref_ptr<osg::Geometry> button_, wheel_;
  osg::ref_ptr<osg::Group> arrows_ = new osg::Group, shift_ = new osg::Group, turn_keys_ = new osg::Group;
  osg::ref_ptr<osg::MatrixTransform> key_ = new osg::MatrixTransform;
  std::optional<Label> does_, keys_;
};

}  // namespace presa::view
