#include "experiments/stability/domino_wave.h"

#include <gtest/gtest.h>

#include <cmath>

namespace presa::stability {
namespace {

constexpr DominoRow kRow{0.048, 0.0075, 0.016, 0};

std::vector<double> anglesOf(int count, double angle) {
  std::vector<double> all{angle};
  while (static_cast<int>(all.size()) < count) {
    const double next = all.back();
    all.push_back(next + std::asin(((kRow.gap + kRow.thickness) * std::cos(next) - kRow.thickness) / kRow.height));
  }
  return all;
}
double potential(int count, double angle) {
  double sum = 0;
  for (const double a : anglesOf(count, angle)) {
    sum += kRow.gravity / 2 * (kRow.height * std::cos(a) + kRow.thickness * std::sin(a));
  }
  return sum;
}
/// Moment of inertia of the row as felt by its front domino, from differences of the angles.
double inertia(int count, double angle) {
  constexpr double kSmall = 1e-6;
  const std::vector<double> low = anglesOf(count, angle - kSmall), high = anglesOf(count, angle + kSmall);
  double sum = 0;
  for (std::size_t i = 0; i < low.size(); ++i) sum += std::pow((high[i] - low[i]) / (2 * kSmall), 2);
  return sum * (kRow.height * kRow.height + kRow.thickness * kRow.thickness) / 3;
}

// Without friction the energy stays the same between two strikes; a strike keeps the momentum of the front domino.
TEST(DominoWave, WithoutFrictionTheTimesAreThoseOfTheEnergy) {
  constexpr int kCount = 8, kParts = 20'000;
  const std::vector<double> times = strikes(kRow, kCount, 6);
  ASSERT_EQ(times.size(), 7u);
  const double strike = std::asin(kRow.gap / kRow.height);
  double time = 0, rate = 6;
  for (int falling = 1; falling < kCount; ++falling) {
    const double energy = inertia(falling, 0) * rate * rate / 2 + potential(falling, 0);
    for (int part = 0; part < kParts; ++part) {
      const double angle = (part + 0.5) * strike / kParts;
      time += strike / kParts / std::sqrt(2 * (energy - potential(falling, angle)) / inertia(falling, angle));
    }
    rate = std::sqrt(2 * (energy - potential(falling, strike)) / inertia(falling, strike));
    rate *= inertia(falling, strike) / (inertia(falling, strike) + inertia(1, 0));
    // both are sums of some thousand steps of second order
    EXPECT_NEAR(times[static_cast<std::size_t>(falling - 1)], time, 1e-6) << falling;
  }
}

TEST(DominoWave, FrictionSlowsTheWave) {
  DominoRow rough = kRow;
  rough.friction = 0.1;
  EXPECT_GT(strikes(rough, 20, 6).back(), 1.05 * strikes(kRow, 20, 6).back());
}

TEST(DominoWave, AStartTooSlowToTipOverStrikesNothing) { EXPECT_TRUE(strikes(kRow, 5, 0.1).empty()); }

}  // namespace
}  // namespace presa::stability
