#include "experiments/stability/masonry_arch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace presa::stability {
namespace {

constexpr double kPi = std::numbers::pi;

/// One half of the arch: its joints from the crown down, and the weight that each carries. A stone weighs 1.
struct Joint {
  double angle = 0;   ///< from the vertical
  double weight = 0;  ///< of all stones between crown and joint
  double moment = 0;  ///< sum of weight times distance from the vertical axis
};

/// Distance of a stone's centroid from the centre of the arch: that of a trapezoid.
double centroidRadius(const MasonryArch& arch) {
  const double inner = arch.radius - arch.thickness / 2, outer = arch.radius + arch.thickness / 2;
  const double height = arch.thickness / 3 * (inner + 2 * outer) / (inner + outer);
  return (inner + height) * std::cos(kPi / 2 / arch.stones);
}

std::vector<Joint> jointsOf(const MasonryArch& arch) {
  const double step = kPi / arch.stones, r = centroidRadius(arch);
  const bool keystone = arch.stones % 2 != 0;
  Joint joint;
  if (keystone) {  // half of it is a right trapezoid with these parallel sides
    const double low = (arch.radius - arch.thickness / 2) * std::sin(step / 2);
    const double high = (arch.radius + arch.thickness / 2) * std::sin(step / 2);
    joint = {step / 2, 0.5, 0.5 * (low * low + low * high + high * high) / (3 * (low + high))};
  }
  std::vector<Joint> joints{joint};
  for (int stone = 0; stone < arch.stones / 2; ++stone) {
    joint.moment += r * std::sin(joint.angle + step / 2);
    joint.weight += 1;
    joint.angle += step;
    joints.push_back(joint);
  }
  return joints;
}

}  // namespace

// The resultant of the thrust H, at height h of the crown, and of the weights W passes inside of the outer end O of a
// joint when z_O H - h H >= M - x_O W, and outside of its inner end I when h H - z_I H >= -(M - x_I W). The sum of one
// of the first kind and one of the second has no h H: every pair of joints bounds H.
bool thrustLineFits(const MasonryArch& arch) {
  const std::vector<Joint> joints = jointsOf(arch);
  const double inner = arch.radius - arch.thickness / 2, outer = arch.radius + arch.thickness / 2;
  double low = 0, high = std::numeric_limits<double>::infinity();
  for (const Joint& o : joints) {
    for (const Joint& i : joints) {
      const double rise = outer * std::cos(o.angle) - inner * std::cos(i.angle);
      const double load =
          o.moment - outer * std::sin(o.angle) * o.weight - (i.moment - inner * std::sin(i.angle) * i.weight);
      if (rise > 0) low = std::max(low, load / rise);
      if (rise < 0) high = std::min(high, load / rise);
      if (rise == 0 && load > 0) return false;
    }
  }
  return low <= high;
}

double minThickness(int stones) {
  double falls = 0, stands = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (falls + stands) / 2;
    (thrustLineFits({stones, 1, middle}) ? stands : falls) = middle;
  }
  return stands;
}

Solid archStone(const MasonryArch& arch, double width) {
  const double half = kPi / 2 / arch.stones;
  Solid stone;
  for (const double y : {-width / 2, width / 2}) {
    for (const double side : {-1.0, 1.0}) {
      for (const double r : {arch.radius - arch.thickness / 2, arch.radius + arch.thickness / 2}) {
        stone.vertices.emplace_back(side * r * std::sin(half), y, r * std::cos(half) - arch.radius);
      }
    }
  }
  // corners: bit 0 outer, bit 1 +x, bit 2 +y
  stone.triangles = {{0, 5, 4}, {0, 1, 5}, {2, 7, 3}, {2, 6, 7}, {0, 6, 2}, {0, 4, 6},
                     {1, 7, 5}, {1, 3, 7}, {0, 3, 1}, {0, 2, 3}, {4, 7, 6}, {4, 5, 7}};
  return stone;
}

}  // namespace presa::stability
