#pragma once
#include <osg/Vec2>
#include <osgGA/GUIEventHandler>

#include "framework/session/view.h"
#include "modules/view_osg/camera_control.h"
#include "modules/view_osg/frame_keys.h"
#include "modules/view_osg/picture.h"
#include "modules/view_osg/pointer_control.h"
#include "modules/view_osg/scene_menu.h"

namespace presa::view {

/// Objects controlled from a window besides the camera; null: not available.
struct Controls {
  PointerControl* pointer = nullptr;
  FrameKeys* frames = nullptr;
  TimeControl* time = nullptr;
  bool undo = false;          ///< undo is available
  SceneMenu* menu = nullptr;  ///< its window stays open for the next run
  /// The window is a participant's: only the pointer's mouse and keys act in it, and it stays open for the next run.
  bool participant = false;
  /// The window is a visitor's: no key or click shows figures.
  bool visitor = false;
};

/// Counters since the start: undo requests, requests to go on, and inputs of any kind.
struct Inputs {
  std::uint32_t undos = 0, onwards = 0, all = 0;
};

/// Dispatches mouse and keys of the window. `helpLines` lists them.
class WindowInput : public osgGA::GUIEventHandler {
 public:
  WindowInput(Picture& picture, CameraControl& camera, const Controls& controls);
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override;

  /// Width over height of the window; resizing it does the same.
  void setAspect(double aspect) {
    aspect_ = aspect;
    camera_.setAspect(aspect);
  }

  Inputs inputs;
  bool picture_requested = false;
  bool stop = false;            ///< Esc, in a window with a menu, which Esc closes first
  bool frame_requested = true;  ///< frame the subject at once; set for the first frame
  bool following = true;        ///< false once the user has moved the camera

 private:
  enum class Drag { kNone, kOrbit, kPan, kZoom, kPairLevel, kPairUpright, kTime };
  Drag dragOf(const osgGA::GUIEventAdapter& event) const;
  void drag(const osg::Vec2& by);
  void click(const osgGA::GUIEventAdapter& event, bool twice);
  void scroll(const osgGA::GUIEventAdapter& event);
  bool key(const osgGA::GUIEventAdapter& event);
  bool menuKey(int key);
  bool frameKey(const osgGA::GUIEventAdapter& event, bool down);
  void tellCamera();
  bool cameraKey(int key);
  bool pairKey(int key, bool fine);
  bool timeKey(int key);
  bool jumpKey(int key);
  void jump(double moment);

  Picture& picture_;
  CameraControl& camera_;
  Controls controls_;
  Drag drag_ = Drag::kNone;
  int held_ = 0;        // key that was pressed last and is still down; 0: none
  double held_at_ = 0;  // time of its last press, or repeat [s]
  double dragged_ = 0;  // length of the current drag, in the units of at_
  osg::Vec2 at_;        // mouse position, in halves of the picture's height
  double aspect_ = 16.0 / 9;
};

}  // namespace presa::view
