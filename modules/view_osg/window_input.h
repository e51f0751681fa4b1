#pragma once
#include <osg/Vec2>
#include <osgGA/GUIEventHandler>

#include "framework/session/view.h"
#include "modules/view_osg/camera_control.h"
#include "modules/view_osg/picture.h"
#include "modules/view_osg/pointer_control.h"

namespace presa::view {

/// What the user of a window moves besides the camera; null: not here.
struct Controls {
  PointerControl* pointer = nullptr;
  TimeWish* time = nullptr;
  bool undo = false;  ///< there is something to take out again
};

/// How often the user asked to take out what was put last, and did anything at all, since the start.
struct Inputs {
  std::uint32_t undos = 0, all = 0;
};

/// Mouse and keys of the window, each given to what it moves. The table of all of them is `helpLines`.
class WindowInput : public osgGA::GUIEventHandler {
 public:
  WindowInput(Picture& picture, CameraControl& camera, const Controls& controls);
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override;

  Inputs inputs;
  bool picture_requested = false;
  bool frame_requested = true;  ///< the first frame frames
  bool following = true;        ///< until the user takes the camera in hand

 private:
  enum class Drag { kNone, kOrbit, kPan, kZoom, kPairLevel, kPairUpright, kTime };
  Drag dragOf(const osgGA::GUIEventAdapter& event) const;
  void drag(const osg::Vec2& by);
  void click(const osgGA::GUIEventAdapter& event, bool twice);
  void scroll(const osgGA::GUIEventAdapter& event);
  bool key(const osgGA::GUIEventAdapter& event);
  bool cameraKey(int key);
  bool pairKey(int key, bool fine);
  bool timeKey(int key);
  bool jumpKey(int key);
  void jump(double moment);

  Picture& picture_;
  CameraControl& camera_;
  Controls controls_;
  Drag drag_ = Drag::kNone;
  double dragged_ = 0;  // since the button went down, as at_
  osg::Vec2 at_;        // of the mouse, in halves of the picture's height
  double aspect_ = 16.0 / 9;
};

}  // namespace presa::view
