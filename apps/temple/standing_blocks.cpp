#include "apps/temple/standing_blocks.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "apps/temple/spots.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/math/random.h"

namespace presa::temple {
namespace {

constexpr double kOuter = 0.14, kOuterAhead = -0.03;  // the outer places [m]
constexpr double kMiddle = -0.07;                     // the one in the middle, before the site [m]
constexpr double kJitter = 0.012;                     // [m]
const std::vector<Vec3> kPlaces{{-kOuter, kOuterAhead, 0}, {0, kMiddle, 0}, {kOuter, kOuterAhead, 0}};

}  // namespace

Ruins standBlocks(const Building& building, std::uint64_t seed) {
  if (building.blocks.size() > kPlaces.size())
    refuse(977, building.name,
           "the field has room for " + std::to_string(kPlaces.size()) + " upright blocks, the building has " +
               std::to_string(building.blocks.size()),
           "lie=\"fallen\" strews any number");
  RandomStream random(seed, "standing blocks");
  std::vector<Vec3> places = kPlaces;
  random.shuffle(std::span(places));
  Ruins ruins;
  for (std::size_t i = 0; i < building.blocks.size(); ++i) {
    double low = 1e300;
    for (const Vec3& corner : cornersOf(building.blocks[i], Pose{})) low = std::min(low, corner.z());
    const double x = random.uniform(-kJitter, kJitter), y = random.uniform(-kJitter, kJitter);
    const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
    ruins.X_WB.push_back({places[i] + Vec3(x, y, -low), Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))});
  }
  return ruins;
}

}  // namespace presa::temple
