#include "experiments/stability/masonry_arch.h"

#include <gtest/gtest.h>

namespace presa::stability {
namespace {

// M. Milankovitch 1907: 0.1075 for an arch that may hinge anywhere, four digits published. Many stones come near it from
// below, by the order of the square of a stone's angle.
TEST(MasonryArch, ManyStonesHaveThePublishedMinThickness) { EXPECT_NEAR(minThickness(1001), 0.1075, 0.00005); }

// Fewer places to hinge: each division of the stones adds joints and takes none away.
TEST(MasonryArch, FewStonesNeedLess) {
  double before = 0;
  for (const int stones : {7, 21, 63, 189}) {
    EXPECT_GT(minThickness(stones), before) << stones;
    before = minThickness(stones);
  }
}

TEST(MasonryArch, AStoneIsATrapezoidTimesItsWidth) {
  const Solid stone = archStone({15, 0.2, 0.04}, 0.06);
  double volume = 0;
  for (const auto& [a, b, c] : stone.triangles) {
    const auto corner = [&](int i) { return stone.vertices[static_cast<std::size_t>(i)]; };
    volume += corner(a).dot(corner(b).cross(corner(c))) / 6;
  }
  // between two radii 12 degrees apart: (r_o^2 - r_i^2) / 2 sin(12 degrees)
  EXPECT_NEAR(volume, (0.22 * 0.22 - 0.18 * 0.18) / 2 * 0.20791169081775934 * 0.06, 1e-12);
}

}  // namespace
}  // namespace presa::stability
