#include "modules/view_osg/frame_keys.h"

#include <osgGA/GUIEventAdapter>
#include <utility>

namespace presa::view {

bool FrameKeys::take(int key, bool down, bool alt) {
  using Event = osgGA::GUIEventAdapter;
  static constexpr std::array<std::pair<int, Held>, 9> kKeys{{{Event::KEY_Up, kAhead},
                                                              {Event::KEY_Down, kBack},
                                                              {Event::KEY_Left, kLeft},
                                                              {Event::KEY_Right, kRight},
                                                              {Event::KEY_Page_Up, kUp},
                                                              {Event::KEY_Page_Down, kDown},
                                                              {'v', kClutch},
                                                              {'z', kCoarser},
                                                              {'x', kFiner}}};
  for (const auto& [each, held] : kKeys) {
    if (each != key) continue;
    if (down && held < kClutch && !alt) return false;  // the camera's
    if (!down && !held_[held]) return false;
    held_[held] = down;
    return true;
  }
  return false;
}

FrameWish FrameKeys::wish() const {
  return {.walk = {share(kAhead, kBack), 0, share(kUp, kDown)},
          .turn = share(kLeft, kRight),
          .zoom = share(kCoarser, kFiner),
          .clutch = held_[kClutch]};
}

}  // namespace presa::view
