#include "experiments/stability/random_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/stability/fingers.h"

namespace presa::stability {
namespace {

constexpr double kSettle = 1.5;  // [s] for a released body to fall and come to rest
constexpr double kQuiet = 0.3;   // [s]

}  // namespace

RandomHand::RandomHand(const Place& place, std::uint64_t seed) : place_(place), random_(seed), last_(place.home) {}

double RandomHand::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
}

Vec3 RandomHand::anywhere(const Vec3& around, double reach) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = std::clamp(around[i] + uniform(-reach, reach), place_.low[i], place_.high[i]);
  return p;
}

/// Positions of both fingertips on a line through the body, `gap` from its faces (negative: penetration).
std::array<Vec3, 2> RandomHand::around(const Pose& X_WB, const Vec3& axis, double gap, const Vec3& shift) const {
  const Vec3 reach = (place_.half + place_.radius + gap) * axis;
  return {X_WB.p + shift - reach, X_WB.p + shift + reach};
}

void RandomHand::go(double seconds, const std::array<Vec3, 2>& to) {
  pieces_.push_back({end_, end_ + seconds, last_, to});
  end_ += seconds;
  last_ = to;
}

/// Pinches the body by two faces, lifts it, then shakes it, puts it down or throws it.
void RandomHand::grab(const Pose& X_WB) {
  Vec3 axis = X_WB.q * Vec3::Unit(static_cast<int>(uniform(0, 3)));
  if (std::abs(axis.z()) > 0.5) axis = X_WB.q * Vec3::Unit(static_cast<int>(uniform(0, 3)));
  if (axis.dot(last_[1] - last_[0]) < 0) axis = -axis;
  const Vec3 off(uniform(-0.005, 0.005), uniform(-0.005, 0.005), uniform(-0.005, 0.01));
  const double depth = uniform(2, 8) / place_.stiffness;
  Vec3 shift = off + Vec3(0, 0, 0.1);
  go(0.5, around(X_WB, axis, 0.02, shift));
  go(0.4, around(X_WB, axis, 0.02, off));
  go(uniform(0.15, 0.4), around(X_WB, axis, -depth, off));
  shift = off + Vec3(uniform(-0.05, 0.05), uniform(-0.05, 0.05), uniform(0.05, 0.15));
  go(uniform(0.3, 0.8), around(X_WB, axis, -depth, shift));
  const double how = uniform(0, 1);
  if (how < 0.4) {  // shake
    const Vec3 sway = uniform(0.01, 0.03) * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    const double half_period = uniform(0.12, 0.4);
    for (int i = 0; i < 8; ++i) go(half_period, around(X_WB, axis, -depth, shift + (i % 2 == 0 ? sway : -sway)));
  } else if (how < 0.8) {  // throw
    const Vec3 fling(uniform(-0.1, 0.1), uniform(-0.1, 0.1), uniform(0, 0.1));
    go(uniform(0.1, 0.2), around(X_WB, axis, -depth, shift + fling));
    go(0.05, around(X_WB, axis, 0.03, shift + 1.3 * fling));
  } else {  // put down
    go(uniform(0.3, 0.8), around(X_WB, axis, -depth, off));
  }
}

/// One finger presses from above, near the middle; the other stays away.
void RandomHand::press(const Pose& X_WB) {
  const Vec3 off(uniform(-0.015, 0.015), uniform(-0.015, 0.015), 0);
  const double depth = uniform(2, 10) / place_.stiffness, above = place_.half + place_.radius;
  const auto at = [&](double gap) {
    return std::array<Vec3, 2>{place_.home[0], X_WB.p + off + Vec3(0, 0, above + gap)};
  };
  go(0.5, at(0.05));
  for (int i = 0; i < 3; ++i) {
    go(uniform(0.1, 0.4), at(-depth));
    go(uniform(0.1, 0.4), at(uniform(-depth, 0.02)));
  }
}

/// Fast random motions of each finger near the body and into it.
void RandomHand::grope(const Pose& X_WB) {
  for (int i = 0; i < 8; ++i) go(uniform(0.15, 0.5), {anywhere(X_WB.p, 0.1), anywhere(X_WB.p, 0.1)});
}

void RandomHand::retreat() {
  std::array<Vec3, 2> up = last_;
  for (Vec3& p : up) p.z() = std::max(p.z(), place_.home[0].z());
  go(0.4, up);
  go(0.4, place_.home);
  go(kSettle + kQuiet, place_.home);
  quiet_from_ = end_ - kQuiet;
  game_end_ = end_;
}

void RandomHand::look(double time, const Pose& X_WB) {
  if (time < end_) return;
  pieces_.clear();
  end_ = time;
  const double game = uniform(0, 1);
  if (game < 0.5) {
    grab(X_WB);
  } else if (game < 0.7) {
    press(X_WB);
  } else {
    grope(X_WB);
  }
  retreat();
  ++games_;
}

PrescribedFinger::State RandomHand::state(std::size_t finger, double time) const {
  for (const Piece& piece : pieces_) {
    if (time >= piece.end) continue;
    const Ramp way = ramp(time, piece.begin, piece.end);
    const Vec3 travel = piece.to[finger] - piece.from[finger];
    return {piece.from[finger] + way.value * travel, way.rate * travel};
  }
  return {last_[finger], Vec3::Zero()};
}

}  // namespace presa::stability
