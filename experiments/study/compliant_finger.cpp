#include "experiments/study/compliant_finger.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

constexpr double kStep = 1e-5;  // integration step [s]

}  // namespace

CompliantFinger::CompliantFinger(const HandImpedance& hand, PrescribedFinger::Path target, const double& clock,
                                 Transport& transport)
    : hand_(hand), target_(std::move(target)), clock_(clock), transport_(transport), x_(target_(0).p_WH) {}

void CompliantFinger::advance() noexcept {
  const auto steps = std::llround((clock_ - time_) / kStep);
  if (steps <= 0) return;
  const Vec3 from = x_;
  const PrescribedFinger::State target = target_(time_);
  for (long long i = 0; i < steps; ++i) {
    const Vec3 lag = target.p_WH + static_cast<double>(i) * kStep * target.v_WH - x_;
    const Vec3 push = hand_.stiffness * lag + hand_.damping * (target.v_WH - v_) + transport_.force;
    v_ += kStep / hand_.mass * push;
    x_ += kStep * v_;
  }
  transport_.energy += transport_.force.dot(x_ - from);
  time_ = clock_;
}

FingerInput CompliantFinger::read(const Tick&) noexcept {
  advance();
  return {x_, v_, -1, true};
}

void CompliantFinger::write(const Wrench& F_H_W, const Tick&) noexcept {
  advance();
  if (clock_ > written_at_) {
    force_before_ = transport_.force;
    written_at_ = clock_;
  }
  transport_.force = F_H_W.f;
  transport_.largest_step = std::max(transport_.largest_step, (F_H_W.f - force_before_).norm());
}

}  // namespace presa
