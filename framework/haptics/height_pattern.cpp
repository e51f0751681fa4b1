#include "framework/haptics/height_pattern.h"

#include <cmath>
#include <numbers>

namespace presa {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

PatternValue sine(double u, double /*v*/, std::uint64_t /*seed*/) noexcept {
  return {std::sin(kTurn * u), kTurn * std::cos(kTurn * u), 0};
}

PatternValue grid(double u, double v, std::uint64_t /*seed*/) noexcept {
  return {0.5 * (std::sin(kTurn * u) + std::sin(kTurn * v)), 0.5 * kTurn * std::cos(kTurn * u),
          0.5 * kTurn * std::cos(kTurn * v)};
}

/// SplitMix64 [Steele2014].
std::uint64_t mix(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// A lattice point's linear function of the distance (x, y) from it.
struct Linear {
  double gx, gy, value;
};

/// Gradients end on the border of the square [-1, 1]^2, so that none is weak. No function of the mathematical library,
/// whose last bit differs between machines.
Linear linearOf(std::uint64_t column_hash, std::int64_t row, double x, double y) noexcept {
  const std::uint64_t bits = mix(column_hash ^ static_cast<std::uint64_t>(row));
  const double side = (bits & 1U) != 0 ? 1 : -1;
  const double along = static_cast<double>(bits >> 11U) * 0x1p-52 - 1;
  const double gx = (bits & 2U) != 0 ? side : along, gy = (bits & 2U) != 0 ? along : side;
  return {gx, gy, gx * x + gy * y};
}

double lerp(double a, double b, double t) noexcept { return a + t * (b - a); }
/// Weight of the upper neighbour, 6 t^5 - 15 t^4 + 10 t^3 [Perlin2002], and its slope.
double fade(double t) noexcept { return t * t * t * (t * (t * 6 - 15) + 10); }
double fadeSlope(double t) noexcept { return 30 * t * t * (t - 1) * (t - 1); }

// Bounds, for gradients of at most 1 in each coordinate, distances (x, y), and the weights f = fade: |s| <= sum of
// weight (|x| + |y|) <= 1, because (1 - f(x)) x + f(x) (1 - x) <= 1/2 on each axis. The slope along u is linear in the
// gradients; its coefficients add to |1 - f - f' x| + |f - f' (1 - x)| + f' at y = 1/2, where they are largest, and the
// largest of these is 2.75, at x = 1/2.
constexpr double kNoiseSlope = 2.75;

PatternValue noise(double u, double v, std::uint64_t seed) noexcept {
  const double u0 = std::floor(u), v0 = std::floor(v);
  const double x = u - u0, y = v - v0;
  const auto column = static_cast<std::int64_t>(u0), row = static_cast<std::int64_t>(v0);
  const std::uint64_t lower = mix(mix(seed) ^ static_cast<std::uint64_t>(column));
  const std::uint64_t upper = mix(mix(seed) ^ static_cast<std::uint64_t>(column + 1));
  const Linear n00 = linearOf(lower, row, x, y), n01 = linearOf(lower, row + 1, x, y - 1);
  const Linear n10 = linearOf(upper, row, x - 1, y), n11 = linearOf(upper, row + 1, x - 1, y - 1);
  const double fx = fade(x), fy = fade(y);
  const auto mean = [&](double a00, double a01, double a10, double a11) {
    return lerp(lerp(a00, a01, fy), lerp(a10, a11, fy), fx);
  };
  const double du = lerp(n10.value - n00.value, n11.value - n01.value, fy);
  const double dv = lerp(n01.value - n00.value, n11.value - n10.value, fx);
  return {mean(n00.value, n01.value, n10.value, n11.value), mean(n00.gx, n01.gx, n10.gx, n11.gx) + fadeSlope(x) * du,
          mean(n00.gy, n01.gy, n10.gy, n11.gy) + fadeSlope(y) * dv};
}

constexpr Pattern kPatterns[] = {{"sine", sine, kTurn, 0, false},
                                 {"grid", grid, 0.5 * kTurn, 0.5 * kTurn, true},
                                 {"noise", noise, kNoiseSlope, kNoiseSlope, true}};

}  // namespace

const Pattern* findPattern(const std::string& name) {
  for (const Pattern& pattern : kPatterns) {
    if (name == pattern.name) return &pattern;
  }
  return nullptr;
}

}  // namespace presa
