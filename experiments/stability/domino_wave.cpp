#include "experiments/stability/domino_wave.h"

#include <cmath>

namespace presa::stability {
namespace {

/// A domino's angle from the vertical, and its angular velocity over that of the front domino.
struct Domino {
  double angle = 0, rate = 1;
};

/// The dominoes from the front one (at `angle`) back to the first, each leaning on the next.
std::vector<Domino> leaning(const DominoRow& row, int count, double angle) {
  const double pitch = row.gap + row.thickness;
  std::vector<Domino> all{{angle, 1}};
  while (static_cast<int>(all.size()) < count) {
    const Domino next = all.back();
    // the upper edge lies on the next one's face: h sin(angle - next) = pitch cos(next) - thickness
    const double relative = std::asin((pitch * std::cos(next.angle) - row.thickness) / row.height);
    const double ratio = 1 - pitch * std::sin(next.angle) / (row.height * std::cos(relative));
    all.push_back({next.angle + relative, next.rate * ratio});
  }
  return all;
}

/// Weight of each domino's moment in the balance of the row: the force between two neighbours, moment on the one over
/// moment on the other. Without friction it equals the rate.
std::vector<double> weights(const DominoRow& row, const std::vector<Domino>& all) {
  std::vector<double> weight{1};
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double relative = all[i].angle - all[i - 1].angle, next = all[i - 1].angle;
    const double arm = row.height * std::cos(relative) - (row.gap + row.thickness) * std::sin(next);
    // the edge slides down the face: friction pushes the next one down, with its whole thickness as lever
    const double on_next = arm - row.friction * row.thickness;
    const double on_this = row.height * (std::cos(relative) + row.friction * std::sin(relative));
    weight.push_back(weight.back() * on_next / on_this);
  }
  return weight;
}

double acceleration(const DominoRow& row, int count, double angle, double rate) {
  constexpr double kSmall = 1e-6;
  const std::vector<Domino> all = leaning(row, count, angle), ahead = leaning(row, count, angle + kSmall);
  const std::vector<double> weight = weights(row, all);
  const double inertia = (row.height * row.height + row.thickness * row.thickness) / 3;  // per mass
  double torque = 0, carried = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double own = row.gravity / 2 * (row.height * std::sin(all[i].angle) - row.thickness * std::cos(all[i].angle));
    torque += weight[i] * (own - inertia * (ahead[i].rate - all[i].rate) / kSmall * rate * rate);
    carried += weight[i] * inertia * all[i].rate;
  }
  return torque / carried;
}

/// The rate of the new front domino once it is struck: the momenta before and after, weighted likewise.
double afterStrike(const DominoRow& row, int count, double angle, double rate) {
  const std::vector<Domino> before = leaning(row, count, angle), after = leaning(row, count + 1, 0);
  const std::vector<double> weight = weights(row, after);
  double had = 0, carried = 1;
  for (std::size_t i = 1; i < after.size(); ++i) {
    had += weight[i] * before[i - 1].rate;
    carried += weight[i] * after[i].rate;
  }
  return rate * had / carried;
}

}  // namespace

std::vector<double> strikes(const DominoRow& row, int count, double spin) {
  constexpr double kStep = 2e-5, kLongest = 10;  // [s]
  const double strike = std::asin(row.gap / row.height);
  std::vector<double> times;
  double time = 0, angle = 0, rate = spin;
  int falling = 1;
  while (falling < count && time < kLongest && angle >= 0) {
    const double half = rate + kStep / 2 * acceleration(row, falling, angle, rate);
    const double next = angle + kStep * half;
    if (next >= strike) {
      const double part = (strike - angle) / (next - angle);
      time += part * kStep;
      times.push_back(time);
      rate = afterStrike(row, falling++, strike, rate + part * (half - rate) * 2);
      angle = 0;
      continue;
    }
    rate += kStep * acceleration(row, falling, angle + kStep / 2 * rate, half);
    angle = next;
    time += kStep;
  }
  return times;
}

}  // namespace presa::stability
