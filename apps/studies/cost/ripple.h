#pragma once
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "framework/core/math/spatial.h"

namespace presa::cost {

/// Estimates the disturbance of one finger's force by the dynamics rate: step() is the RMS second difference of the
/// force [N] at ticks with a new object state (boundaries); hum() is the amplitude [N] at the dynamics rate, from a
/// Hann-weighted Fourier sum. Only ticks in contact within [from, to) [s] count.
class Ripple {
 public:
  Ripple(double from, double to, double hum_hz) : from_(from), to_(to), omega_(2 * std::numbers::pi * hum_hz) {}

  void add(double time, const Vec3& force, bool touching, bool boundary) noexcept {
    const bool inside = touching && time >= from_ && time < to_;
    if (!inside) {
      run_ = 0;
      return;
    }
    if (run_ >= 2 && boundary) {
      squares_ += (force - 2 * last_ + before_).squaredNorm();
      ++boundaries_;
    }
    before_ = last_;
    last_ = force;
    ++run_;
    // Hann window: keeps the slow part of the force out of the hum
    const double sine = std::sin(std::numbers::pi * (time - from_) / (to_ - from_));
    weight_ += sine * sine;
    sum_ += sine * sine * std::polar(1.0, -omega_ * time) * force;
  }

  std::optional<double> step() const {
    return boundaries_ > 0 ? std::optional(std::sqrt(squares_ / static_cast<double>(boundaries_))) : std::nullopt;
  }
  std::optional<double> hum() const { return weight_ > 0 ? std::optional(2 * sum_.norm() / weight_) : std::nullopt; }

 private:
  double from_, to_, omega_;
  Vec3 last_ = Vec3::Zero(), before_ = Vec3::Zero();
  double squares_ = 0, weight_ = 0;
  Eigen::Vector3cd sum_ = Eigen::Vector3cd::Zero();
  std::size_t run_ = 0, boundaries_ = 0;
};

}  // namespace presa::cost
