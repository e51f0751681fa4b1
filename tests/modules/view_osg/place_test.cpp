// Out of doors: where the camera may go, its walk round what was built, and the land around.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "framework/core/math/random.h"
#include "modules/view_osg/camera_control.h"
#include "modules/view_osg/finish_walk.h"
#include "modules/view_osg/landscape.h"

namespace presa::view {
namespace {

// Whatever a visitor does with the camera, the eye stays 3 cm above the ground.
TEST(CameraOutOfDoors, StaysAboveTheGround) {
  RandomStream random(3, "camera");
  CameraControl camera(16.0 / 9);
  camera.setGround(-0.01);
  camera.set({{0, -1, 0.3}, {0, 0, 0.1}});
  for (int i = 0; i < 2000; ++i) {
    const double a = random.uniform(-1, 1), b = random.uniform(-1, 1);
    switch (random.below(4)) {
      case 0:
        camera.orbit(a, b);
        break;
      case 1:
        camera.pan(a, b);
        break;
      case 2:
        camera.zoom(std::exp(0.3 * a));
        break;
      default:
        camera.fly(0.1 * a, 0.1 * b, 0.1 * a * b);
    }
    // an eye that may not be nearer than a centimetre, nor look up by more than 89 degrees, can be a rounding below
    ASSERT_GT(camera.pose().eye.z(), -0.01 + CameraControl::kAboveGround - 1e-9) << i;
  }
}

// Once round, at the same height and distance, back to where it began; a touch ends it where it is.
TEST(FinishWalk, GoesOnceRoundUntilItIsTouched) {
  const CameraPose start{{0.3, -1.2, 0.4}, {0.1, 0, 0.2}};
  const Vec3 middle(0, 0.1, 0.2);
  FinishWalk walk;
  EXPECT_LT((walk.at(-1, 4, start, middle).eye - start.eye).norm(), 1e-12);
  double turned = 0, fastest = 0;
  Vec3 before = start.eye - middle;
  for (double t = 0; t < FinishWalk::kPause + FinishWalk::kLap + 1; t += 0.02) {
    const CameraPose now = walk.at(t, 4, start, middle);
    const Vec3 out = now.eye - middle;
    EXPECT_NEAR(now.eye.z(), start.eye.z(), 1e-12);
    EXPECT_NEAR(out.head<2>().norm(), (start.eye - middle).head<2>().norm(), 1e-12);
    const double by = std::atan2(before.x() * out.y() - before.y() * out.x(), before.head<2>().dot(out.head<2>()));
    turned += by;
    fastest = std::max(fastest, by);
    EXPECT_EQ(walk.walks(), t > FinishWalk::kPause && t < FinishWalk::kPause + FinishWalk::kLap) << t;
    before = out;
  }
  EXPECT_NEAR(turned, 2 * std::numbers::pi, 1e-6);
  // smooth: the fastest step is three halves of the mean
  EXPECT_NEAR(fastest, 1.5 * 2 * std::numbers::pi / FinishWalk::kLap * 0.02, 1e-4);
  EXPECT_LT((walk.at(1e3, 4, start, middle).eye - start.eye).norm(), 1e-9);

  FinishWalk touched;
  touched.at(0, 4, start, middle);
  const Vec3 there = touched.at(20, 4, start, middle).eye;
  EXPECT_LT((touched.at(21, 5, start, middle).eye - there).norm(), 1e-12);
  EXPECT_LT((touched.at(30, 5, start, middle).eye - there).norm(), 1e-12);
  EXPECT_FALSE(touched.walks());
}

// The land goes on from the floor without an edge; the sea lies where a visitor looks, hills elsewhere.
TEST(Landscape, ContinuesTheFloor) {
  for (double turn = -3.14; turn < 3.14; turn += 0.01) {
    EXPECT_NEAR(landHeight(1, turn), 0, 1e-12);
    EXPECT_NEAR(landHeight(1.01, turn), 0, 0.01);
  }
  EXPECT_LT(landHeight(5, -12 * std::numbers::pi / 180), -0.5);
  EXPECT_GT(landHeight(10, 40 * std::numbers::pi / 180), 0.2);
}

}  // namespace
}  // namespace presa::view
