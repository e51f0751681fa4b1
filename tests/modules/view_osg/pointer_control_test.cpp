#include "modules/view_osg/pointer_control.h"

#include <gtest/gtest.h>

namespace presa::view {
namespace {

// Long enough for a haptic thread that reads the newest state, and for one press only.
TEST(PointerControl, PressesAButtonForSomeFrames) {
  DeviceState device(1);
  device.fingers[0].valid = device.fingers[0].oriented = true;
  PointerControl control({0});
  control.press();
  EXPECT_EQ(control.state().buttons, 0U) << "it has no place yet";
  control.begin(device);
  control.press();
  for (int frame = 1; frame < PointerControl::kPressed; ++frame) {
    control.heed(device);
    EXPECT_EQ(control.state().buttons, 1U << kPickUpButton);
  }
  const std::uint64_t before = control.state().sequence;
  control.heed(device);
  EXPECT_EQ(control.state().buttons, 0U);
  EXPECT_GT(control.state().sequence, before) << "who compares sequences sees it";
}

}  // namespace
}  // namespace presa::view
