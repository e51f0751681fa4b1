// Pictures of walls as they are drawn, off-screen. Expected places come from lines of sight and from the disparity of
// parallel eyes, in pixels of the wall.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modules/view_osg/picture.h"
#include "modules/view_osg/renderer.h"
#include "tests/modules/view_osg/pinch_world.h"

namespace presa::view_test {
namespace {

using walls::Stereo;

constexpr int kWallWidth = 320, kWallHeight = 240;

/// Two walls of 3 m x 2.25 m that meet at x = 1.5, y = 1.5; in the world's frame, life-size.
walls::Walls corner() {
  walls::Walls room;
  walls::Wall front, right;
  front.lower_left = {-1.5, 1.5, 0}, front.lower_right = {1.5, 1.5, 0}, front.upper_left = {-1.5, 1.5, 2.25};
  right.lower_left = {1.5, 1.5, 0}, right.lower_right = {1.5, -1.5, 0}, right.upper_left = {1.5, 1.5, 2.25};
  front.width = right.width = kWallWidth, front.height = right.height = kWallHeight;
  room.walls = {front, right};
  return room;
}

/// A red body alone, drawn for a wall.
class Stage {
 public:
  Stage(const Geometry& shape, Stereo stereo, int width = kWallWidth, int height = kWallHeight) {
    PinchRun run = makePinchRun(RunOptions::View::kOffscreen, "");
    run.world->scene.bodies = {run.world->scene.bodies[1]};
    run.world->scene.bodies[0].haptic = run.world->scene.bodies[0].physics = shape;
    run.world->meshes.resize(1);
    run.world->inertias.resize(1);
    run.world->scene.devices.clear();
    canvas_.width = width, canvas_.height = height, canvas_.stereo = stereo;
    canvas_.eyes = {eye({0, 0, 1}), eye({0, 0, 1})};
    picture_ = std::make_unique<view::Picture>(run.world, run.options);
    renderer_ = view::makeWallRenderer(*picture_, canvas_, false, "");
  }
  walls::Frustum eye(const Vec3& p, std::size_t wall = 0) const {
    return walls::frustumOf(room_, room_.walls[wall], p).value();
  }
  osg::ref_ptr<osg::Image> draw(const walls::Frustum& left, const walls::Frustum& right, const Pose& X_WB) {
    canvas_.eyes = {left, right};
    view::ViewFrame frame;
    frame.X_WB = {X_WB};
    frame.asleep = {false};
    picture_->show(frame, {});
    renderer_->render();
    return renderer_->capture();
  }
  bool quadRefused() const { return canvas_.quad_refused; }
  const walls::Walls& room() const { return room_; }

 private:
  walls::Walls room_ = corner();
  walls::Canvas canvas_;
  std::unique_ptr<view::Picture> picture_;
  std::unique_ptr<view::Renderer> renderer_;
};

bool isRed(const osg::Image& image, int x, int y) {
  const unsigned char* c = image.data(x, y);
  return c[0] > 50 && 10 * c[0] > 13 * c[1] && 10 * c[0] > 13 * c[2];
}

/// How red a pixel is.
int redness(const osg::Image& image, int x, int y) {
  const unsigned char* c = image.data(x, y);
  return 2 * c[0] - c[1] - c[2];
}

/// Where the red of a column ends beyond row `y`, which is red, in the direction `step`: by the share of the last
/// pixels that it covers, to a quarter of a row (these pixels are means in linear light, not in codes).
double redEnd(const osg::Image& image, int x, int y, int step) {
  const double inside = redness(image, x, y - 3 * step), outside = redness(image, x, y + 3 * step);
  double covered = 0;
  for (int i = -2; i <= 2; ++i)
    covered += std::clamp((redness(image, x, y + i * step) - outside) / (inside - outside), 0.0, 1.0);
  return y + step * (covered - 2.5);
}

/// Lower and upper end of the red in a column.
std::pair<double, double> redRows(const osg::Image& image, int column) {
  int low = -1, high = -1;
  for (int y = 0; y < image.t(); ++y) {
    if (!isRed(image, column, y)) continue;
    if (low < 0) low = y;
    high = y;
  }
  if (high - low < 15 || low < 3 || high + 3 >= image.t()) return {-1, -1};
  return {redEnd(image, column, low, -1), redEnd(image, column, high, 1)};
}

/// The same, carried on from columns `at` and `from` to the edge half a pixel beyond `at`.
std::pair<double, double> redAtEdge(const osg::Image& image, int at, int from) {
  const auto [low, high] = redRows(image, at);
  const auto [low_before, high_before] = redRows(image, from);
  const double on = 0.5 / std::abs(at - from);
  return {low + on * (low - low_before), high + on * (high - high_before)};
}

// 100 poses of the head: a ball behind the edge of both walls continues from one picture in the other.
TEST(WallPicture, NeighboursAgreeToAPixelAlongTheirEdge) {
  Stage stage(Geometry{Sphere{0.5}, Pose{}, {}}, Stereo::kMono);
  std::mt19937_64 random(25);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3 head(in(-1.2, 1), in(-1.2, 1), in(0.6, 1.9)), edge(1.5, 1.5, in(0.9, 1.5));
    const Pose ball{head + in(1.3, 2) * (edge - head), Quat::Identity()};
    const auto front = stage.draw(stage.eye(head, 0), stage.eye(head, 0), ball);
    const auto right = stage.draw(stage.eye(head, 1), stage.eye(head, 1), ball);
    const auto one = redAtEdge(*front, kWallWidth - 1, kWallWidth - 5), other = redAtEdge(*right, 0, 4);
    ASSERT_GT(one.second - one.first, 10) << "no ball at the edge, pose " << i;
    worst = std::max({worst, std::abs(one.first - other.first), std::abs(one.second - other.second)});
  }
  EXPECT_LE(worst, 1.0);
}

/// Middle of what is red, weighted by how much of each pixel it covers: to a few hundredths of a pixel for edges that
/// are askew. Columns from `begin` to `end`.
Eigen::Vector2d middle(const osg::Image& image, int begin, int end) {
  double sum = 0;
  Eigen::Vector2d at(0, 0);
  for (int y = 0; y < image.t(); ++y)
    for (int x = begin; x < end; ++x) {
      const unsigned char* c = image.data(x, y);
      const double weight = std::max(0, 2 * c[0] - c[1] - c[2]);
      if (!isRed(image, x, y)) continue;
      at += weight * Eigen::Vector2d(x - begin, y);
      sum += weight;
    }
  return at / sum;
}

// A sheet in the wall's plane is at one place for both eyes; one that is 1 m behind it, seen from 2 m before it, is
// apart by a third of the distance between the eyes.
TEST(WallPicture, DisparityIsZeroAtTheWallAndTheAnalyticOneBehindIt) {
  Stage stage(Geometry{Box{{0.6, 1e-3, 0.5}}, Pose{}, {}}, Stereo::kSideBySide, 2 * kWallWidth, kWallHeight);
  const Quat askew(Eigen::AngleAxisd(0.4, Vec3::UnitY()));
  constexpr double kEyes = 0.064, kPixel = 3.0 / kWallWidth;
  std::mt19937_64 random(25);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 10; ++i) {
    const Vec3 head(in(-0.8, 0.8), -0.5, in(1, 1.6)), apart(kEyes / 2, 0, 0);
    const auto left = stage.eye(head - apart), right = stage.eye(head + apart);
    const Vec3 place(in(-0.7, 0.7), 1.5, in(0.8, 1.4));
    const auto at_wall = stage.draw(left, right, {place, askew});
    const Eigen::Vector2d none = middle(*at_wall, kWallWidth, 2 * kWallWidth) - middle(*at_wall, 0, kWallWidth);
    EXPECT_LT(none.norm(), 0.1) << none.transpose();
    // on the line from the head, so that it stays in the picture
    const auto behind = stage.draw(left, right, {head + 1.5 * (place - head), askew});
    const Eigen::Vector2d some = middle(*behind, kWallWidth, 2 * kWallWidth) - middle(*behind, 0, kWallWidth);
    EXPECT_NEAR(some.x(), kEyes / 3 / kPixel, 0.1);
    EXPECT_NEAR(some.y(), 0, 0.1);
  }
}

const Geometry kBall{Sphere{0.4}, Pose{}, {}};
const Pose kThere{{0.2, 2, 1.2}, Quat::Identity()};
const Vec3 kLeft(-0.2, -0.5, 1.5), kRight(0.2, -0.5, 1.5);  // far apart, so that the pictures differ

/// The picture of one eye alone.
osg::ref_ptr<osg::Image> alone(const Vec3& eye, int width, int height) {
  Stage stage(kBall, Stereo::kMono, width, height);
  return stage.draw(stage.eye(eye), stage.eye(eye), kThere);
}

/// Largest difference of a channel between a part of `whole` that begins at x, y, and `part`.
int difference(const osg::Image& whole, int x, int y, const osg::Image& part, std::initializer_list<int> channels) {
  int most = 0;
  for (int row = 0; row < part.t(); ++row)
    for (int column = 0; column < part.s(); ++column)
      for (const int c : channels)
        most = std::max(most, std::abs(whole.data(x + column, y + row)[c] - part.data(column, row)[c]));
  return most;
}

osg::ref_ptr<osg::Image> inStereo(Stereo stereo) {
  Stage stage(kBall, stereo);
  return stage.draw(stage.eye(kLeft), stage.eye(kRight), kThere);
}

constexpr int kRounding = 1;  // of a code: colours are interpolated from other places in the window

TEST(WallPicture, EachEyeHasItsHalf) {
  const auto beside = inStereo(Stereo::kSideBySide);
  EXPECT_LE(difference(*beside, 0, 0, *alone(kLeft, kWallWidth / 2, kWallHeight), {0, 1, 2}), kRounding);
  EXPECT_LE(difference(*beside, kWallWidth / 2, 0, *alone(kRight, kWallWidth / 2, kWallHeight), {0, 1, 2}), kRounding);
  EXPECT_GT(difference(*beside, 0, 0, *alone(kRight, kWallWidth / 2, kWallHeight), {0, 1, 2}), 50);
  const auto above = inStereo(Stereo::kTopBottom);
  EXPECT_LE(difference(*above, 0, kWallHeight / 2, *alone(kLeft, kWallWidth, kWallHeight / 2), {0, 1, 2}), kRounding);
  EXPECT_LE(difference(*above, 0, 0, *alone(kRight, kWallWidth, kWallHeight / 2), {0, 1, 2}), kRounding);
}

TEST(WallPicture, AnaglyphHasTheLeftEyeInRedAndTheRightOneInCyan) {
  const auto both = inStereo(Stereo::kAnaglyph);
  EXPECT_LE(difference(*both, 0, 0, *alone(kLeft, kWallWidth, kWallHeight), {0}), kRounding);
  EXPECT_LE(difference(*both, 0, 0, *alone(kRight, kWallWidth, kWallHeight), {1, 2}), kRounding);
  EXPECT_GT(difference(*both, 0, 0, *alone(kRight, kWallWidth, kWallHeight), {0}), 50);
}

TEST(WallPicture, WithoutBuffersForBothEyesThereIsOnePicture) {
  Stage stage(kBall, Stereo::kQuad);
  const auto image = stage.draw(stage.eye(kLeft), stage.eye(kRight), kThere);
  EXPECT_TRUE(stage.quadRefused());
  EXPECT_EQ(difference(*image, 0, 0, *alone(kLeft, kWallWidth, kWallHeight), {0, 1, 2}), 0);
}

}  // namespace
}  // namespace presa::view_test
