#include "apps/temple/spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/geometry/rotation_between.h"

namespace presa::temple {
namespace {

constexpr double kReachX = 0.3, kFront = -0.15, kBack = 0.15;  // [m]
constexpr double kSpotRoom = 3.5;     // field area over the blocks' area; blocks without room fall onto others
constexpr double kSiteBorder = 0.01;  // [m]
constexpr double kBorder = 0.02;      // min distance of a block's origin from the field's edge [m]
constexpr double kGap = 0.004;        // between a falling block and blocks at rest [m]
constexpr int kDirections = 16, kDraws = 80, kSides = 24;
// max ratio of a block's height to its shortest edge for it to stand upright
constexpr double kSlender = 2.2;
constexpr double kTilt = 0.3, kTiltOfSlab = 0.08;  // [rad]

Vec3 extentOf(const Block& block) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& corner : cornersOf(block, Pose{})) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return high - low;
}

double areaFromAbove(const Block& block) {
  Vec3 extent = extentOf(block);
  std::sort(extent.data(), extent.data() + 3);
  return extent[1] * extent[2];
}

/// Random orientation: a face down on which the block is not too slender, then a tilt and a turn about z.
Quat drawTurn(const Vec3& extent, RandomStream& random) {
  std::vector<int> axes;
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] <= kSlender * extent.minCoeff()) axes.push_back(axis);
  }
  const int down = axes[random.below(axes.size())];
  const double side = random.uniform() < 0.5 ? 1 : -1;
  const Quat face = rotationBetween(side * Vec3::Unit(down), Vec3::UnitZ());
  const double max = axes.size() == 3 ? kTilt : kTiltOfSlab;
  const double towards = random.uniform(0, 2 * std::numbers::pi), tilt = random.uniform(0, max),
               turn = random.uniform(0, 2 * std::numbers::pi);
  return Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) *
         Quat(Eigen::AngleAxisd(tilt, Vec3(std::cos(towards), std::sin(towards), 0))) * face;
}

}  // namespace

std::vector<Vec3> cornersOf(const Block& block, const Pose& X_WB) {
  std::vector<Vec3> corners;
  if (const Box* box = std::get_if<Box>(&block.physics)) {
    for (int i = 0; i < 8; ++i)
      corners.push_back(
          0.5 * box->size.cwiseProduct(Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
  } else if (const Cylinder* rod = std::get_if<Cylinder>(&block.physics)) {
    const double around = rod->radius / std::cos(std::numbers::pi / kSides);
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      for (const double z : {-0.5, 0.5})
        corners.push_back({around * std::cos(angle), around * std::sin(angle), z * rod->length});
    }
  } else {
    corners = block.physics_mesh.vertices;
  }
  for (const Block::Part& part : block.parts)
    corners.insert(corners.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
  for (Vec3& corner : corners) corner = X_WB * corner;
  return corners;
}

Field fieldFor(const Building& building) {
  double area = 0;
  for (const Block& block : building.blocks) area += areaFromAbove(block);
  const double share = std::min(1.0, std::sqrt(kSpotRoom * area / (2 * kReachX * (kBack - kFront))));
  Field field{-share * kReachX, share * kReachX, share * kFront, kBack, {0, 0, 0, 0}};
  const Footing& widest = building.footings.front();
  field.site = {
      widest.X_WB.p.x() - widest.size.x() / 2 - kSiteBorder, widest.X_WB.p.x() + widest.size.x() / 2 + kSiteBorder,
      widest.X_WB.p.y() - widest.size.y() / 2 - kSiteBorder, widest.X_WB.p.y() + widest.size.y() / 2 + kSiteBorder};
  return field;
}

Spots::Shadow Spots::shadowOf(const std::vector<Vec3>& corners) {
  Shadow shadow{std::vector<double>(kDirections, 1e300), std::vector<double>(kDirections, -1e300), -1e300};
  for (const Vec3& corner : corners) {
    shadow.top = std::max(shadow.top, corner.z());
    for (int i = 0; i < kDirections; ++i) {
      const double along = std::cos(std::numbers::pi * i / kDirections) * corner.x() +
                           std::sin(std::numbers::pi * i / kDirections) * corner.y();
      const auto at = static_cast<std::size_t>(i);
      shadow.low[at] = std::min(shadow.low[at], along);
      shadow.high[at] = std::max(shadow.high[at], along);
    }
  }
  return shadow;
}

bool Spots::apart(const Shadow& a, const Shadow& b) {
  for (std::size_t i = 0; i < a.low.size(); ++i) {
    if (a.low[i] > b.high[i] + kGap || b.low[i] > a.high[i] + kGap) return true;
  }
  return false;
}

bool Spots::onSite(const std::vector<Vec3>& corners) const {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return low.x() < field_.site.right && high.x() > field_.site.left && low.y() < field_.site.back &&
         high.y() > field_.site.front;
}

void Spots::take(const std::vector<Vec3>& corners) { taken_.push_back(shadowOf(corners)); }

bool Spots::find(const Block& block, std::size_t from, RandomStream& random, Pose& X_WB) const {
  const Vec3 extent = extentOf(block);
  double lowest = 1e300;
  for (int draw = 0; draw < kDraws; ++draw) {
    Pose X{{random.uniform(field_.left + kBorder, field_.right - kBorder),
            random.uniform(field_.front + kBorder, field_.back - kBorder), 0},
           drawTurn(extent, random)};
    const std::vector<Vec3> corners = cornersOf(block, X);
    if (onSite(corners)) continue;
    const Shadow shadow = shadowOf(corners);
    double ground = 0;
    bool free = true;
    for (std::size_t i = 0; i < taken_.size() && free; ++i) {
      if (apart(shadow, taken_[i])) continue;
      free = i < from;
      ground = std::max(ground, taken_[i].top);
    }
    double bottom = 1e300;
    for (const Vec3& corner : corners) bottom = std::min(bottom, corner.z());
    X.p.z() = ground + kGap - bottom;
    if (!free || ground >= lowest) continue;
    lowest = ground;
    X_WB = X;
  }
  return lowest < 1e300;
}

}  // namespace presa::temple
