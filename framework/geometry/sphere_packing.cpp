// Greedy packing: of all places the one whose largest sphere, between the surface and the spheres that are there already, is
// largest. The room of a place only shrinks, so an old bound is looked at again only when it comes to the top of the heap.
#include "framework/geometry/sphere_packing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <queue>

namespace presa {
namespace {

constexpr double kClimbUntil = 0.02;     // step at which a climb ends, in relation to the grid
constexpr double kSmallestSphere = 0.3;  // radius, in relation to the grid

constexpr std::uint64_t kScatter = 0x9e3779b97f4a7c15;  // odd: multiples of it modulo 2^64 lie everywhere

struct Candidate {
  double room;          // at least its true room [m]
  std::uint64_t order;  // of equal ones, scattered: a plate fills evenly
  double depth;
  Vec3 at;
  bool operator<(const Candidate& other) const {
    return room < other.room || (room == other.room && order > other.order);
  }
};

double roomBetween(const std::vector<InnerSphere>& spheres, const Vec3& p, double room) {
  for (const InnerSphere& one : spheres) room = std::min(room, (p - one.centre).norm() - one.radius);
  return room;
}

}  // namespace

std::vector<InnerSphere> packSpheres(const std::function<double(const Vec3&)>& depth, const AxisBox& bounds,
                                     std::size_t count, std::size_t cells) {
  const Vec3 size = bounds.high - bounds.low;
  if (!(size.minCoeff() > 0)) return {};
  const double grid = std::cbrt(size.prod() / static_cast<double>(cells));
  std::priority_queue<Candidate> heap;
  std::uint64_t order = 0;
  const auto steps = [&](int axis) { return static_cast<int>(std::ceil(size[axis] / grid)); };
  for (int i = 0; i < steps(0); ++i) {
    for (int j = 0; j < steps(1); ++j) {
      for (int k = 0; k < steps(2); ++k) {
        const Vec3 cell(i + 0.5, j + 0.5, k + 0.5);
        const Vec3 at = bounds.low + cell.cwiseQuotient(Vec3(steps(0), steps(1), steps(2))).cwiseProduct(size);
        const double deep = depth(at);
        if (deep > 0) heap.push({deep, ++order * kScatter, deep, at});
      }
    }
  }
  std::vector<InnerSphere> spheres;
  while (spheres.size() < count && !heap.empty()) {
    Candidate top = heap.top();
    heap.pop();
    const double room = roomBetween(spheres, top.at, top.depth);
    if (room < top.room) {
      top.room = room;
      if (room > kSmallestSphere * grid) heap.push(top);
      continue;
    }
    InnerSphere best{top.at, room};
    for (double step = grid / 2; step > kClimbUntil * grid;) {
      bool climbed = false;
      for (int way = 0; way < 6; ++way) {
        Vec3 to = best.centre;
        to[way / 2] += way % 2 == 0 ? step : -step;
        const double there = roomBetween(spheres, to, depth(to));
        if (there <= best.radius) continue;
        best = {to, there};
        climbed = true;
      }
      if (!climbed) step /= 2;
    }
    spheres.push_back(best);
  }
  return spheres;
}

double overlapVolume(double r, double q, double apart) noexcept {
  if (apart >= r + q) return 0;
  const double smaller = std::min(r, q);
  if (apart <= std::abs(r - q)) return 4 * std::numbers::pi / 3 * smaller * smaller * smaller;
  const double depth = r + q - apart;
  return std::numbers::pi * depth * depth * (apart * apart + 2 * apart * (r + q) - 3 * (r - q) * (r - q)) /
         (12 * apart);
}

double overlapArea(double r, double q, double apart) noexcept {
  if (apart >= r + q || apart <= std::abs(r - q)) return 0;
  const double along = (apart * apart + r * r - q * q) / (2 * apart);
  return std::numbers::pi * std::max(0.0, r * r - along * along);
}

}  // namespace presa
