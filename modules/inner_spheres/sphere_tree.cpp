#include "modules/inner_spheres/sphere_tree.h"

#include <algorithm>

namespace presa {

SphereTree::SphereTree(std::vector<InnerSphere> spheres) {
  nodes_.resize(1);
  build(spheres, 0, spheres.size(), 0);
}

// Halves along the longest side of the centres' box.
void SphereTree::build(std::vector<InnerSphere>& spheres, std::size_t begin, std::size_t end, std::size_t node) {
  const auto first = spheres.begin() + static_cast<std::ptrdiff_t>(begin),
             last = spheres.begin() + static_cast<std::ptrdiff_t>(end);
  if (end - begin == 1) {
    nodes_[node] = {first->centre, first->radius, -1};
    return;
  }
  AxisBox box;
  for (auto one = first; one != last; ++one) {
    box.low = box.low.cwiseMin(one->centre);
    box.high = box.high.cwiseMax(one->centre);
  }
  const Vec3 centre = (box.low + box.high) / 2;
  double radius = 0;
  for (auto one = first; one != last; ++one) radius = std::max(radius, (one->centre - centre).norm() + one->radius);
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const std::size_t middle = (begin + end) / 2;
  std::nth_element(first, spheres.begin() + static_cast<std::ptrdiff_t>(middle), last,
                   [&](const InnerSphere& a, const InnerSphere& b) { return a.centre[axis] < b.centre[axis]; });
  const std::size_t children = nodes_.size();
  nodes_[node] = {centre, radius, static_cast<std::int32_t>(children)};
  nodes_.resize(children + 2);
  build(spheres, begin, middle, children);
  build(spheres, middle, end, children + 1);
}

}  // namespace presa
