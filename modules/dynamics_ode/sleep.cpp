#include "modules/dynamics_ode/sleep.h"

#include <algorithm>

namespace presa::ode {
namespace {

constexpr double kWindow = 0.5;      // [s]
constexpr double kMeanMoves = 1e-5;  // [m] between windows, at most
constexpr double kTrembles = 2e-4;   // [m] from where a window began, at most

Eigen::Matrix<double, 6, 1> displacement(const Pose& from, const Pose& to, double extent) {
  Quat turn = to.q * from.q.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  Eigen::Matrix<double, 6, 1> u;
  u << to.p - from.p, 2 * extent * turn.vec();
  return u;
}

}  // namespace

void Sleep::watch(const BodySet& bodies, std::size_t i) {
  Stillness& body = stillness_[i];
  const Displacement u = displacement(body.reference, bodies.centrePose(i), bodies.extent(i));
  body.sum += u;
  body.farthest = std::max(body.farthest, u.norm());
}

// The next window counts from here.
void Sleep::closeWindow(const BodySet& bodies, std::size_t i) {
  Stillness& body = stillness_[i];
  const Displacement mean = body.sum / std::max(1, window_steps_);
  body.still = body.farthest < kTrembles && (mean - body.last_mean).norm() < kMeanMoves;
  const Pose now = bodies.centrePose(i);
  body.last_mean = mean - displacement(body.reference, now, bodies.extent(i));
  body.reference = now;
  body.sum.setZero();
  body.farthest = 0;
}

void Sleep::afterStep(BodySet& bodies, Islands& islands, double h) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.awake(i)) watch(bodies, i);
  }
  ++window_steps_;
  window_time_ += h;
  if (window_time_ < kWindow) return;
  may_sleep_.assign(bodies.size(), 1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i)) continue;
    closeWindow(bodies, i);
    const std::size_t island = islands.of(i);
    if (!stillness_[i].still || islands[island].touched) may_sleep_[island] = 0;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i) || may_sleep_[islands.of(i)] == 0) continue;
    group_[i] = islands.of(i);
    bodies.sleep(i);
  }
  window_time_ = 0;
  window_steps_ = 0;
}

void Sleep::wake(BodySet& bodies, std::size_t i) {
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (bodies.asleep(j) && group_[j] == group_[i]) bodies.wake(j);
  }
}

}  // namespace presa::ode
