#include "modules/dynamics_ode/sleep.h"

#include <algorithm>

namespace presa::ode {
namespace {

constexpr double kWindow = 0.5;  // [s]

/// Motion within a window that still counts as rest [m].
struct MotionLimits {
  double mean_moves = 0;  // change of the mean pose from window to window
  double trembles = 0;    // distance from the pose at the start of the window
};
constexpr MotionLimits kFew{1e-5, 2e-4}, kInAHeap{4e-4, 8e-4};
constexpr std::uint32_t kHeap = 16;  // an island with more contacts counts as a heap

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
  ++body.samples;
  body.farthest = std::max(body.farthest, u.norm());
}

// Ends the window of body i and starts the next one.
void Sleep::closeWindow(const BodySet& bodies, std::size_t i, bool in_a_heap) {
  const MotionLimits& allowed = in_a_heap ? kInAHeap : kFew;
  Stillness& body = stillness_[i];
  const Displacement mean = body.sum / std::max(1, body.samples);
  body.still = body.farthest < allowed.trembles && (mean - body.last_mean).norm() < allowed.mean_moves;
  const Pose now = bodies.centrePose(i);
  body.last_mean = mean - displacement(body.reference, now, bodies.extent(i));
  body.reference = now;
  body.sum.setZero();
  body.farthest = 0;
  body.samples = 0;
}

void Sleep::afterStep(BodySet& bodies, Islands& islands, double h) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.awake(i)) watch(bodies, i);
  }
  window_time_ += h;
  if (window_time_ < kWindow) return;
  may_sleep_.assign(bodies.size(), 1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i)) continue;
    const std::size_t island = islands.of(i);
    closeWindow(bodies, i, islands[island].contacts > kHeap);
    if (!stillness_[i].still || islands[island].touched) may_sleep_[island] = 0;
  }
  for (const std::size_t i : driven_) {
    if (bodies.awake(i)) may_sleep_[islands.of(i)] = 0;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i) || may_sleep_[islands.of(i)] == 0) continue;
    group_[i] = islands.of(i);
    bodies.sleep(i);
  }
  window_time_ = 0;
}

void Sleep::wake(BodySet& bodies, std::size_t i) {
  for (std::size_t j = 0; j < bodies.size(); ++j) {
    if (bodies.asleep(j) && group_[j] == group_[i]) bodies.wake(j);
  }
}

std::size_t Sleep::pauseOthers(BodySet& bodies, Islands& islands, const std::vector<char>& wanted) {
  std::size_t paused = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.awake(i) || wanted[islands.of(i)] != 0) continue;
    group_[i] = islands.of(i);
    bodies.pause(i);
    ++paused;
  }
  any_paused_ = any_paused_ || paused > 0;
  return paused;
}

void Sleep::resume(BodySet& bodies) {
  if (!any_paused_) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies.paused(i)) bodies.wake(i);
  }
  any_paused_ = false;
}

}  // namespace presa::ode
