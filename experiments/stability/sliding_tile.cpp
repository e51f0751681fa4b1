#include "experiments/stability/sliding_tile.h"

#include <cmath>

namespace presa::stability {
namespace {

using Vec2 = Eigen::Vector2d;
constexpr double kStep = 1e-4;  // [s]

SlidingTile::State moved(const SlidingTile::State& from, double h, const SlidingTile::State& rate) {
  return {from.v + h * rate.v, from.angle + h * rate.angle, from.spin + h * rate.spin};
}

/// Friction force and torque per unit mass.
struct Push {
  Vec2 force = Vec2::Zero();
  double torque = 0;
};

}  // namespace

SlidingTile::State SlidingTile::rate(const State& state) const {
  const Vec2 pull = model_.gravity.head<2>();
  const double load = -model_.gravity.z(), edge = model_.edge;
  const Vec2 x_axis(std::cos(state.angle), std::sin(state.angle)), y_axis(-x_axis.y(), x_axis.x());
  const auto frictionWith = [&](const Vec2& slope) {  // slope: gradient of the corner loads
    Push push;
    for (const double a : {-0.5, 0.5}) {
      for (const double b : {-0.5, 0.5}) {
        const Vec2 r = edge * (a * x_axis + b * y_axis);
        const Vec2 slip = state.v + state.spin * Vec2(-r.y(), r.x());
        const Vec2 way = slip.norm() > 1e-9 ? slip : pull;  // at rest it starts to slide downhill
        const Vec2 f = -model_.friction * load / 4 * (1 + slope.dot(r)) * way.normalized();
        push.force += f;
        push.torque += r.x() * f.y() - r.y() * f.x();
      }
    }
    return push;
  };
  Push push = frictionWith(Vec2::Zero());
  for (int i = 0; i < 3; ++i) push = frictionWith(-2 * model_.thickness / (load * edge * edge) * push.force);
  return {pull + push.force, state.spin, push.torque * 6 / (edge * edge)};
}

const SlidingTile::State& SlidingTile::at(double time) {
  const int steps = static_cast<int>(std::lround((time - time_) / kStep));
  for (int i = 0; i < steps; ++i) {
    const State k1 = rate(state_), k2 = rate(moved(state_, kStep / 2, k1)), k3 = rate(moved(state_, kStep / 2, k2));
    const State k4 = rate(moved(state_, kStep, k3));
    state_ = moved(moved(moved(moved(state_, kStep / 6, k1), kStep / 3, k2), kStep / 3, k3), kStep / 6, k4);
  }
  time_ += steps * kStep;
  return state_;
}

}  // namespace presa::stability
