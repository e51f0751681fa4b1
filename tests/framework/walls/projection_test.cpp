// Expected values: the line from the eye to a point, cut with the plane of the wall.
#include "framework/walls/projection.h"

#include <gtest/gtest.h>

#include <random>

namespace presa::walls {
namespace {

Walls room() {
  Diagnostics diagnostics;
  Walls walls = loadWalls(std::string(PRESA_SOURCE_DIR) + "/config/cave/cave.xml", diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return walls;
}

/// A CAVE that stands askew in a scene.
Walls askew() {
  Walls walls = room();
  walls.X_WK = {{0.3, -0.2, 0.1}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  walls.magnification = 7;
  return walls;
}

Vec3 toWorld(const Walls& walls, const Vec3& p_K) { return walls.X_WK * Vec3(p_K / walls.magnification); }

/// Poses of a head within the room, nowhere nearer than 0.2 m to a wall.
class Heads {
 public:
  Pose next() {
    const Vec3 p(1.3 * side(), 1.3 * side(), 1.2 + 0.7 * side());
    return {p, Quat(Eigen::Quaterniond::UnitRandom())};
  }
  double side() { return std::uniform_real_distribution(-1.0, 1.0)(random_); }

 private:
  std::mt19937_64 random_{25};
};

/// Where the line from the eye through a point meets the wall, as shares of its width and height.
Eigen::Vector2d onWall(const Wall& wall, const Vec3& eye_K, const Vec3& p_K) {
  const Vec3 lower = wall.lower_right - wall.lower_left, side = wall.upper_left - wall.lower_left;
  const Vec3 normal = lower.cross(side);
  const double share = normal.dot(wall.lower_left - eye_K) / normal.dot(p_K - eye_K);
  const Vec3 hit = eye_K + share * (p_K - eye_K) - wall.lower_left;
  return {hit.dot(lower) / lower.squaredNorm(), hit.dot(side) / side.squaredNorm()};
}

constexpr double kRounding = 1e-9;  // of some hundred operations on numbers of order 1

TEST(WallProjection, CornersOfTheWallAreTheCornersOfClipSpace) {
  const Walls walls = askew();
  Heads heads;
  for (int i = 0; i < 100; ++i) {
    const Vec3 eye_K = heads.next().p;
    for (const Wall& wall : walls.walls) {
      const Frustum frustum = frustumOf(walls, wall, eye_K).value();
      const Eigen::Matrix4d projection = projectionOf(frustum, 0.01, 10);
      const Vec3 upper_right = wall.lower_right + wall.upper_left - wall.lower_left;
      const std::array<std::pair<Vec3, Eigen::Vector2d>, 4> corners{{{wall.lower_left, {-1, -1}},
                                                                     {wall.lower_right, {1, -1}},
                                                                     {wall.upper_left, {-1, 1}},
                                                                     {upper_right, {1, 1}}}};
      for (const auto& [corner_K, expected] : corners) {
        const Vec3 corner_E = frustum.X_WE.inverseTimes(toWorld(walls, corner_K));
        const Eigen::Vector4d clip = projection * corner_E.homogeneous();
        EXPECT_NEAR((clip.head<2>() / clip.w() - expected).norm(), 0, kRounding) << wall.name;
        EXPECT_NEAR(clip.w(), -corner_E.z(), kRounding);  // depth is the distance from the eye's plane
      }
    }
  }
}

TEST(WallProjection, NearAndFarAreTheEndsOfClipSpace) {
  const Frustum frustum = frustumOf(room(), room().wall("left"), {0.4, -0.3, 1.5}).value();
  const Eigen::Matrix4d projection = projectionOf(frustum, 0.5, 20);
  for (const auto& [depth, expected] : {std::pair{0.5, -1.0}, {20.0, 1.0}}) {
    const Eigen::Vector4d clip = projection * Eigen::Vector4d(0.1, -0.2, -depth, 1);
    EXPECT_NEAR(clip.z() / clip.w(), expected, kRounding);
  }
}

TEST(WallProjection, PointsAreWhereTheirLinesMeetTheWall) {
  const Walls walls = askew();
  Heads heads;
  for (int i = 0; i < 100; ++i) {
    const Vec3 eye_K = heads.next().p;
    for (const Wall& wall : walls.walls) {
      const Frustum frustum = frustumOf(walls, wall, eye_K).value();
      const Vec3 inside = wall.lower_left + 0.3 * (wall.lower_right - wall.lower_left) +
                          (0.5 + 0.4 * heads.side()) * (wall.upper_left - wall.lower_left);
      const Vec3 p_K = eye_K + (1.5 + heads.side()) * (inside - eye_K);  // before, on or behind the wall
      EXPECT_NEAR((inPicture(frustum, toWorld(walls, p_K)) - onWall(wall, eye_K, p_K)).norm(), 0, kRounding);
    }
  }
}

// Pictures of walls that share an edge continue each other: what one shows at a place of the edge, the other shows at
// the same place, however far behind the walls it is. 100 poses of the head, both eyes, all pairs of walls.
TEST(WallProjection, NeighboursAgreeAlongTheirEdge) {
  struct Shared {
    const char *one, *other;
    Vec3 begin, end;
  };
  const std::array<Shared, 4> edges{{{"front", "left", {-1.5, 1.5, 0}, {-1.5, 1.5, 2.25}},
                                     {"front", "right", {1.5, 1.5, 0}, {1.5, 1.5, 2.25}},
                                     {"front", "floor", {-1.5, 1.5, 0}, {1.5, 1.5, 0}},
                                     {"floor", "left", {-1.5, -0.75, 0}, {-1.5, 1.5, 0}}}};
  const Walls walls = askew();
  Heads heads;
  double worst = 0;  // [pixel]
  for (int i = 0; i < 100; ++i) {
    for (const Vec3& eye_K : eyesOf(walls, heads.next())) {
      for (const Shared& edge : edges) {
        const Wall &one = walls.wall(edge.one), &other = walls.wall(edge.other);
        const Vec3 place = edge.begin + (0.5 + 0.5 * heads.side()) * (edge.end - edge.begin);
        const Vec3 p_W = toWorld(walls, eye_K + (2.5 + heads.side()) * (place - eye_K));
        for (const Wall* wall : {&one, &other}) {
          const Eigen::Vector2d shown = inPicture(frustumOf(walls, *wall, eye_K).value(), p_W);
          const Vec3 shown_K = wall->lower_left + shown.x() * (wall->lower_right - wall->lower_left) +
                               shown.y() * (wall->upper_left - wall->lower_left);
          worst = std::max(worst, (shown_K - place).norm() * wall->width / 3.0);
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-6);  // asked for: one pixel
}

// A point of the wall's plane has no disparity; one at distance d behind it, seen from D before it with eyes e apart
// in parallel to the wall, has e d / (D + d).
TEST(WallProjection, DisparityIsZeroAtTheWallAndGrowsBehindIt) {
  const Walls walls = askew();
  const Wall& front = walls.wall("front");
  Heads heads;
  for (int i = 0; i < 100; ++i) {
    Pose head = heads.next();
    const auto both = [&](const Pose& X_KHead, const Vec3& p_K) {
      const auto [left, right] = eyesOf(walls, X_KHead);
      const Vec3 p_W = toWorld(walls, p_K);
      const Eigen::Vector2d apart = inPicture(frustumOf(walls, front, right).value(), p_W) -
                                    inPicture(frustumOf(walls, front, left).value(), p_W);
      return Eigen::Vector2d(apart.x() * front.width, apart.y() * front.height);
    };
    const Vec3 on_wall(1.4 * heads.side(), 1.5, 1.1 + heads.side());
    EXPECT_LT(both(head, on_wall).norm(), 1e-6);  // asked for: 0.1 pixel
    head.q = Quat::Identity();
    const double behind = 2 + heads.side(), before = 1.5 - head.p.y();
    const Eigen::Vector2d apart = both(head, on_wall + Vec3(0, behind, 0));
    const double pixel = 3.0 / front.width;
    EXPECT_NEAR(apart.x() * pixel, walls.eye_distance * behind / (before + behind), kRounding);
    EXPECT_NEAR(apart.y(), 0, 1e-6);
  }
}

TEST(WallProjection, AnEyeBehindTheWallHasNone) {
  const Walls walls = room();
  EXPECT_FALSE(frustumOf(walls, walls.wall("front"), {0, 1.6, 1}));
  EXPECT_FALSE(frustumOf(walls, walls.wall("front"), {0, 1.5 - kNearestEye / 2, 1}));
  EXPECT_TRUE(frustumOf(walls, walls.wall("front"), {0, 1.5 - 2 * kNearestEye, 1}));
  EXPECT_FALSE(frustumOf(walls, walls.wall("front"), Vec3(0, std::nan(""), 1)));
}

}  // namespace
}  // namespace presa::walls
