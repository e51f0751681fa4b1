#include "modules/view_osg/window_input.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace presa::view {
namespace {

using Event = osgGA::GUIEventAdapter;

constexpr double kNotch = 1.12;          // distance factor per wheel notch
constexpr double kZoomDrag = 1.5;        // exponent of the zoom for a drag over half of the picture's height
constexpr double kFlyStep = 0.06;        // per arrow key, in distances to the target
constexpr double kShortJump = 1.0 / 60;  // length of a step back, as a single step ahead [s]
constexpr double kStill = 0.01;          // a shorter drag counts as a click
constexpr double kRepeat = 1;            // a key that is held down repeats sooner [s]
constexpr double kFineShare = 0.2;       // fraction of a key's step with Shift
constexpr double kSlowest = 1.0 / 64, kFastest = 64;

bool has(const Event& event, int mask) { return (event.getModKeyMask() & mask) != 0; }

/// A key that switches something over, or asks for it once: held down, it does so once, while the others repeat.
bool switches(int key) {
  return key == Event::KEY_Return || key == Event::KEY_Escape ||
         (key > 0 && key < 128 && std::strchr("0123456789bcdfghjklmopstuw? ", key) != nullptr);
}

}  // namespace

WindowInput::WindowInput(Picture& picture, CameraControl& camera, const Controls& controls)
    : picture_(picture), camera_(camera), controls_(controls) {}

bool WindowInput::handle(const Event& event, osgGA::GUIActionAdapter&) {
  const osg::Vec2 before = at_;
  if (event.getEventType() == Event::PUSH || event.getEventType() == Event::DOUBLECLICK ||
      event.getEventType() == Event::SCROLL || event.getEventType() == Event::KEYDOWN)
    ++inputs.all;
  switch (event.getEventType()) {
    case Event::RESIZE:
      setAspect(static_cast<double>(event.getWindowWidth()) / std::max(1, event.getWindowHeight()));
      return false;
    case Event::PUSH:
      dragged_ = 0;
      at_ = {static_cast<float>(aspect_) * event.getXnormalized(), event.getYnormalized()};
      drag_ = dragOf(event);
      if (drag_ == Drag::kTime) drag({});
      return true;
    case Event::DRAG:
      at_ = {static_cast<float>(aspect_) * event.getXnormalized(), event.getYnormalized()};
      dragged_ += (at_ - before).length();
      drag(at_ - before);
      return true;
    case Event::RELEASE:
      if (event.getButton() == Event::LEFT_MOUSE_BUTTON && !controls_.participant && drag_ != Drag::kNone &&
          drag_ != Drag::kTime && dragged_ < kStill && !controls_.visitor)
        click(event, false);
      drag_ = Drag::kNone;
      return true;
    case Event::DOUBLECLICK:
      drag_ = Drag::kNone;
      if (event.getButton() == Event::LEFT_MOUSE_BUTTON && !controls_.participant && !controls_.visitor)
        click(event, true);
      return true;
    case Event::SCROLL:
      scroll(event);
      return true;
    case Event::KEYDOWN: {
      const double since = event.getTime() - std::exchange(held_at_, event.getTime());
      // a release is lost with the focus: a later press is a press
      const bool repeated = std::exchange(held_, event.getKey()) == event.getKey() && since < kRepeat;
      if (repeated && switches(event.getKey())) return true;
      return menuKey(event.getKey()) || frameKey(event, true) || key(event);
    }
    case Event::KEYUP:
      if (held_ == event.getKey()) held_ = 0;
      return frameKey(event, false);
    default:
      return false;
  }
}

WindowInput::Drag WindowInput::dragOf(const Event& event) const {
  if (controls_.participant) {
    if (controls_.pointer == nullptr || event.getButton() != Event::LEFT_MOUSE_BUTTON) return Drag::kNone;
    return has(event, Event::MODKEY_SHIFT) ? Drag::kPairUpright : Drag::kPairLevel;
  }
  switch (event.getButton()) {
    case Event::LEFT_MOUSE_BUTTON:
      if (controls_.time != nullptr && picture_.timeBar().momentAt(at_.x(), at_.y())) return Drag::kTime;
      if (controls_.pointer == nullptr || has(event, Event::MODKEY_ALT)) return Drag::kOrbit;
      return has(event, Event::MODKEY_SHIFT) ? Drag::kPairUpright : Drag::kPairLevel;
    case Event::MIDDLE_MOUSE_BUTTON:
      return Drag::kPan;
    case Event::RIGHT_MOUSE_BUTTON:
      return controls_.pointer == nullptr ? Drag::kZoom : Drag::kOrbit;
    default:
      return Drag::kNone;
  }
}

void WindowInput::drag(const osg::Vec2& by) {
  if (drag_ == Drag::kOrbit || drag_ == Drag::kPan || drag_ == Drag::kZoom) following = false;
  switch (drag_) {
    case Drag::kOrbit:
      return camera_.orbit(by.x(), by.y());
    case Drag::kPan:
      return camera_.pan(by.x(), by.y());
    case Drag::kZoom:
      return camera_.zoom(std::exp(-kZoomDrag * by.y()));
    case Drag::kPairLevel:
      return controls_.pointer->dragLevel(by.x(), by.y(), camera_);
    case Drag::kPairUpright:
      return controls_.pointer->dragUpright(by.x(), by.y(), camera_);
    case Drag::kTime:
      return jump(*picture_.timeBar().momentAt(at_.x(), at_.y(), true));
    case Drag::kNone:
      return;
  }
}

void WindowInput::click(const Event& event, bool twice) {
  const auto hit =
      picture_.bodies().along(camera_.pose().eye, camera_.rayThrough(event.getXnormalized(), event.getYnormalized()));
  picture_.choose(hit ? std::optional(hit->body) : std::nullopt);
  if (!twice || !hit) return;
  following = false;
  camera_.center(hit->p_W);
}

void WindowInput::scroll(const Event& event) {
  const bool up = event.getScrollingMotion() == Event::SCROLL_UP;
  if (!up && event.getScrollingMotion() != Event::SCROLL_DOWN) return;
  if (controls_.pointer != nullptr && !has(event, Event::MODKEY_CTRL)) return controls_.pointer->close(up ? 1 : -1);
  if (controls_.participant) return;
  following = false;
  camera_.zoom(up ? 1 / kNotch : kNotch);
}

bool WindowInput::key(const Event& event) {
  const int key = event.getKey();
  if (controls_.participant) return controls_.pointer != nullptr && pairKey(key, has(event, Event::MODKEY_SHIFT));
  switch (key) {
    case 's':
      picture_requested = true;
      return true;
    case 'h':
      frame_requested = following = true;
      return true;
    case 'c':
      tellCamera();
      return true;
    case 'o':
      picture_.parts().toggle(ShownPart::kOffset);
      return true;
    case 'g':
      if (controls_.visitor) return true;
      picture_.parts().toggle(ShownPart::kPlots);
      return true;
    case 't':
      if (controls_.visitor) return true;
      picture_.parts().toggle(ShownPart::kTexture);
      return true;
    case Event::KEY_Space:
    case Event::KEY_Return:
      if (!controls_.visitor) break;
      ++inputs.onwards;
      return true;
    case 'j':
      if (controls_.visitor) return true;
      picture_.parts().toggle(ShownPart::kJoints);
      return true;
    case 'd':
    case 'b':
    case 'w':
      if (controls_.visitor) return true;
      picture_.parts().toggle(key == 'd'   ? ShownPart::kDevices
                              : key == 'b' ? ShownPart::kCompliance
                                           : ShownPart::kHeat);
      return true;
    case 'f':
    case 'k':
    case 'l':
      if (controls_.visitor) return true;
      picture_.parts().toggle(key == 'f' ? ShownPart::kField : key == 'k' ? ShownPart::kPoints : ShownPart::kCoupling);
      return true;
    case 'u':
      inputs.undos += controls_.undo ? 1 : 0;
      return true;
    case '?':
      picture_.hud().toggleHelp();
      return true;
    default:
      break;
  }
  if (key >= '0' && key <= '9') {
    if (controls_.visitor) return true;
    picture_.parts().toggle(static_cast<ShownPart>((key - '0' + 9) % 10));
    return true;
  }
  if (timeKey(key)) return true;
  if (controls_.pointer != nullptr && !has(event, Event::MODKEY_CTRL))
    return pairKey(key, has(event, Event::MODKEY_SHIFT));
  return cameraKey(key);
}

/// While the menu is open it takes every key.
bool WindowInput::menuKey(int key) {
  SceneMenu* const menu = controls_.menu;
  if (menu == nullptr) return false;
  if (menu->open()) {
    menu->key(key);
    return true;
  }
  if (key == Event::KEY_Escape) stop = true;
  if (key == 'm') menu->toggle();
  return stop || key == 'm';
}

bool WindowInput::frameKey(const Event& event, bool down) {
  if (controls_.frames == nullptr || controls_.participant) return false;
  return controls_.frames->take(event.getKey(), down, has(event, Event::MODKEY_ALT));
}

void WindowInput::tellCamera() {
  const CameraPose pose = camera_.pose();
  const std::string option = "--camera " + cameraText({pose.eye, pose.target});
  picture_.hud().tell(option);
  std::fprintf(stdout, "%s%s\n", isatty(STDOUT_FILENO) != 0 ? "\r\033[K" : "", option.c_str());  // to be copied
  std::fflush(stdout);
}

bool WindowInput::cameraKey(int key) {
  const auto fly = [&](double right, double ahead, double up) {
    following = false;
    camera_.fly(kFlyStep * right, kFlyStep * ahead, kFlyStep * up);
    return true;
  };
  switch (key) {
    case Event::KEY_Left:
      return fly(-1, 0, 0);
    case Event::KEY_Right:
      return fly(1, 0, 0);
    case Event::KEY_Up:
      return fly(0, 1, 0);
    case Event::KEY_Down:
      return fly(0, -1, 0);
    case Event::KEY_Page_Up:
      return fly(0, 0, 1);
    case Event::KEY_Page_Down:
      return fly(0, 0, -1);
    default:
      return false;
  }
}

bool WindowInput::pairKey(int key, bool fine) {
  PointerControl& pair = *controls_.pointer;
  const double share = fine ? kFineShare : 1;
  const auto move = [&](double right, double away, double up) {
    const double step = share * PointerControl::kStep;
    pair.move(step * right, step * away, step * up, camera_);
    return true;
  };
  switch (key) {
    case Event::KEY_Left:
      return move(-1, 0, 0);
    case Event::KEY_Right:
      return move(1, 0, 0);
    case Event::KEY_Up:
      return move(0, 1, 0);
    case Event::KEY_Down:
      return move(0, -1, 0);
    case Event::KEY_Page_Up:
      return move(0, 0, 1);
    case Event::KEY_Page_Down:
      return move(0, 0, -1);
    case '+':
    case '=':
    case Event::KEY_KP_Add:
      pair.close(1);
      return true;
    case '-':
    case '_':
    case Event::KEY_KP_Subtract:
      pair.close(-1);
      return true;
    case 'p':
      pair.press();
      return true;
    case 'q':
      pair.turn(share * PointerControl::kTurnStep);
      return true;
    case 'e':
      pair.turn(-share * PointerControl::kTurnStep);
      return true;
    default:
      return false;
  }
}

bool WindowInput::timeKey(int key) {
  if (key == Event::KEY_Space && controls_.time == nullptr) return true;  // reserved
  if (controls_.time == nullptr) return false;
  TimeControl& time = *controls_.time;
  const auto faster = [&](double factor) {
    time.speed = std::clamp(time.speed.load() * factor, kSlowest, kFastest);
    return true;
  };
  switch (key) {
    case Event::KEY_Space:
      time.paused = !time.paused;
      return true;
    case '.':
      time.paused = true;
      ++time.steps;
      return true;
    case '[':
      return faster(0.5);
    case ']':
      return faster(2);
    default:
      return picture_.timeBar().length() > 0 && jumpKey(key);
  }
}

void WindowInput::jump(double moment) {
  controls_.time->jump_to = std::clamp(moment, 0.0, picture_.timeBar().length());
}

bool WindowInput::jumpKey(int key) {
  const double now = picture_.timeBar().time();
  const auto to = [&](double moment) {
    jump(moment);
    return true;
  };
  switch (key) {
    case ',':
      controls_.time->paused = true;
      return to(now - kShortJump);
    case '<':
      return to(now - 1);
    case '>':
      return to(now + 1);
    case Event::KEY_Home:
      return to(0);
    case Event::KEY_End:
      return to(picture_.timeBar().length());
    default:
      return false;
  }
}

}  // namespace presa::view
