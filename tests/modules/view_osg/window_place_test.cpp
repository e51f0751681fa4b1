#include <gtest/gtest.h>

#include "modules/view_osg/window_context.h"

namespace presa::view {
namespace {

// A window of 1280 x 720 is as wanted where there is room for it and its title bar, and else the largest of its shape.
TEST(WindowPlace, FitsTheScreen) {
  const WindowPlace roomy = fitted(1280, 720, 1920, 1080);
  EXPECT_EQ(roomy.width, 1280);
  EXPECT_EQ(roomy.height, 720);
  EXPECT_EQ(roomy.x, 40);
  for (const auto& [width, height] : {std::pair{1366, 768}, {1280, 720}, {1024, 600}, {800, 1280}, {640, 480}}) {
    const WindowPlace place = fitted(1280, 720, width, height);
    EXPECT_GE(place.x, 0);
    EXPECT_GE(place.y, 0);
    EXPECT_LE(place.x + place.width, width);
    EXPECT_LE(place.y + place.height, height);
    EXPECT_LE(place.height, height - 40);
    EXPECT_NEAR(place.width * 720.0, place.height * 1280.0, 1280);  // whole pixels
    EXPECT_TRUE(place.width >= width - 2 || place.height >= height - 42 || place.width == 1280);
  }
  EXPECT_EQ(fitted(1280, 720, 0, 0).width, 1280);  // no screen is known
}

}  // namespace
}  // namespace presa::view
