#include "tests/modules/haptics_proxy/surface/support/wanderer.h"

#include <cmath>

namespace presa::test {

constexpr double kPeriod = 1e-3, kMass = 0.05, kHand = 3000, kDamping = 20;  // [s], [kg], [N/m], [N s/m]

Wanderer::Wanderer(const TriMesh& mesh, std::uint64_t seed, bool stiff)
    : mesh_(mesh), random_(seed), stiff_(stiff), room_(boundsOf(mesh)) {
  // start beyond the bounding sphere: certainly outside
  const Vec3 middle = (room_.low + room_.high) / 2;
  std::normal_distribution<double> normal;
  const double x = normal(random_), y = normal(random_), z = normal(random_);
  goal_ = middle + ((room_.high - room_.low).norm() / 2 + 0.02) * Vec3(x, y, z).normalized();
  x_ = goal_;
  choose();
  speed_ = 0.5;  // fast approach
}

double Wanderer::uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

void Wanderer::choose() {
  speed_ = std::exp(uniform(std::log(0.02), std::log(1.0)));
  rest_ = uniform(0, 1) < 0.2 ? static_cast<int>(uniform(0, 100)) : 0;
  if (uniform(0, 1) < 0.15) {
    for (int i = 0; i < 3; ++i) target_[i] = uniform(room_.low[i] - 0.01, room_.high[i] + 0.01);
    return;
  }
  // the nearest of a few random triangles, so that it mostly slides on from its position
  double min = 1e300;
  for (int i = 0; i < 8; ++i) {
    const auto t = static_cast<std::size_t>(uniform(0, 1) * static_cast<double>(mesh_.triangles.size() - 1));
    const auto at = [&](std::size_t k) -> const Vec3& {
      return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[t][k])];
    };
    const Vec3 middle = (at(0) + at(1) + at(2)) / 3, normal = (at(1) - at(0)).cross(at(2) - at(0));
    const double depth = uniform(-0.003, 0.01);
    if ((middle - goal_).norm() >= min || !(normal.norm() > 0)) continue;
    min = (middle - goal_).norm();
    target_ = middle - depth * normal.normalized();
  }
  if (min == 1e300) target_ = goal_;
}

const Vec3& Wanderer::next(const Vec3& f_H_W) {
  Vec3 velocity = Vec3::Zero();
  if (rest_ > 0) {
    --rest_;
  } else {
    const Vec3 left = target_ - goal_;
    const double step = speed_ * kPeriod;
    if (left.norm() <= step) {
      choose();
    } else {
      velocity = speed_ * left.normalized();
      goal_ += kPeriod * velocity;
    }
  }
  if (stiff_) return x_ = goal_;
  v_ += kPeriod / kMass * (kHand * (goal_ - x_) + kDamping * (velocity - v_) + f_H_W);
  x_ += kPeriod * v_;
  return x_;
}

}  // namespace presa::test
