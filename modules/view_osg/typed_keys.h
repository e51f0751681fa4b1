#pragma once
#include <osgGA/GUIEventHandler>
#include <queue>

namespace presa::view {

/// Collects keys as a terminal would send them, and the size of the window.
class TypedKeys final : public osgGA::GUIEventHandler {
 public:
  TypedKeys(int w, int h) : width(w), height(h) {}

  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
    if (event.getEventType() == osgGA::GUIEventAdapter::RESIZE) {
      width = event.getWindowWidth();
      height = event.getWindowHeight();
      return false;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return false;
    const int key = event.getKey();
    if (key == osgGA::GUIEventAdapter::KEY_Return || key == osgGA::GUIEventAdapter::KEY_KP_Enter)
      keys_.push('\n');
    else if (key == osgGA::GUIEventAdapter::KEY_BackSpace)
      keys_.push('\b');
    else if (key == osgGA::GUIEventAdapter::KEY_Escape)
      keys_.push(27);
    else if (key >= 32 && key < 127)
      keys_.push(static_cast<char>(key));
    return true;
  }

  /// The oldest key that was not taken yet; 0: none.
  char next() {
    if (keys_.empty()) return 0;
    const char key = keys_.front();
    keys_.pop();
    return key;
  }

  void drop() { keys_ = {}; }

  int width, height;

 private:
  std::queue<char> keys_;
};

}  // namespace presa::view
