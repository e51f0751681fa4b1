#include "apps/common/report/contours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace presa::svg {
namespace {

std::vector<double> axis() {
  std::vector<double> values;
  for (int i = -20; i <= 20; ++i) values.push_back(0.1 * i);
  return values;
}

template <class Height>
std::vector<double> over(const Height& height) {
  std::vector<double> z;
  for (const double y : axis()) {
    for (const double x : axis()) z.push_back(height(x, y));
  }
  return z;
}

// A cone's contour is one closed circle; linear interpolation in cells of 0.1 changes its radius by up to 0.1^2 / (8
// r).
TEST(Contours, ACircleIsOneClosedLine) {
  const auto lines = contours(axis(), axis(), over([](double x, double y) { return std::hypot(x, y); }), 1.03);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_EQ(lines[0].front().y, lines[0].back().y);
  EXPECT_GT(lines[0].size(), 60u);
  for (const Point& p : lines[0]) EXPECT_NEAR(std::hypot(p.x, p.y), 1.03, 2e-3);
}

TEST(Contours, AnOpenLineRunsFromEdgeToEdge) {
  const auto lines = contours(axis(), axis(), over([](double x, double) { return x; }), 0.55);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].size(), axis().size());
  for (const Point& p : lines[0]) EXPECT_NEAR(p.x, 0.55, 1e-12);
}

TEST(Contours, NothingIsDrawnWhereThereIsNothing) {
  const auto half = over([](double x, double y) { return y > 0 ? std::numeric_limits<double>::quiet_NaN() : x; });
  for (const auto& line : contours(axis(), axis(), half, 0.55)) {
    for (const Point& p : line) EXPECT_LE(p.y, 1e-12);
  }
  EXPECT_TRUE(contours(axis(), axis(), half, 7).empty());
}

// Two hills: two lines.
TEST(Contours, SeparateHillsHaveSeparateLines) {
  const auto hills = over([](double x, double y) { return std::min(std::hypot(x - 1, y), std::hypot(x + 1, y)); });
  EXPECT_EQ(contours(axis(), axis(), hills, 0.53).size(), 2u);
}

}  // namespace
}  // namespace presa::svg
