#include "modules/inner_spheres/sphere_pairs.h"

#include <algorithm>
#include <limits>

namespace presa {

bool SpherePairs::gather(const Pose& X_WT, const std::vector<Pose>& X_WB, double margin) noexcept {
  pairs_.clear();
  for (std::uint32_t s = 0; s < solids_.size(); ++s) gatherFrom(s, X_WT, X_WB[s], margin);
  return pairs_.lost() == 0;
}

// Both trees at once; the larger sphere is opened first.
void SpherePairs::gatherFrom(std::uint32_t solid, const Pose& X_WT, const Pose& X_WB, double margin) noexcept {
  const Pose X_BT = X_WB.inverse() * X_WT;
  const Mat3 R_BT = X_BT.q.toRotationMatrix();
  const auto &of_tool = tool_.nodes(), &of_body = solids_[solid].tree.nodes();
  stack_.clear();
  stack_.add({0, 0});
  while (!stack_.empty()) {
    const Two two = stack_[stack_.size() - 1];
    stack_.remove(stack_.size() - 1);
    const SphereTree::Node &tool = of_tool[static_cast<std::size_t>(two.tool)],
                           &body = of_body[static_cast<std::size_t>(two.body)];
    const double within = tool.radius + body.radius + margin;
    if ((X_BT.p + R_BT * tool.centre - body.centre).squaredNorm() >= within * within) continue;
    if (tool.children < 0 && body.children < 0) {
      pairs_.add({tool.centre, X_WB * body.centre, tool.radius, body.radius, solid});
    } else if (body.children < 0 || (tool.children >= 0 && tool.radius > body.radius)) {
      stack_.add({tool.children, two.body});
      stack_.add({tool.children + 1, two.body});
    } else {
      stack_.add({two.tool, body.children});
      stack_.add({two.tool, body.children + 1});
    }
  }
}

double SpherePairs::clearance(const Pose& X_WT, const std::vector<Pose>& X_WB) const noexcept {
  const SphereTree::Node& tool = tool_.nodes().front();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    const SphereTree::Node& body = solids_[s].tree.nodes().front();
    least = std::min(least, (X_WT * tool.centre - X_WB[s] * body.centre).norm() - tool.radius - body.radius);
  }
  return least;
}

// Along the line of the centres the force falls with the area of the disc in which the spheres cross; across it, it would
// turn outwards, which is left out of the stiffness: a bound of the resistance that keeps it positive.
Vec6 SpherePairs::evaluate(const Pose& X_WT, Mat6& stiffness) noexcept {
  const Mat3 R_WT = X_WT.q.toRotationMatrix();
  Vec6 wrench = Vec6::Zero();
  for (SpherePair& one : pairs_) {
    const Vec3 centre = R_WT * one.tool_T, way = X_WT.p + centre - one.body_W;
    const double apart = way.norm();
    const double volume = overlapVolume(one.tool_radius, one.body_radius, apart);
    one.f_W = Vec3::Zero();
    if (!(volume > 0)) continue;
    const Vec3 nhat = apart > 0 ? Vec3(way / apart) : Vec3(Vec3::UnitZ());
    const double r = one.tool_radius, q = one.body_radius;
    const double back = apart > 0 ? std::clamp((apart * apart + r * r - q * q) / (2 * apart), -r, r) : 0;
    one.p = centre - back * nhat;
    one.f_W = stiffness_ * volume * nhat;
    wrench.head<3>() += one.f_W;
    wrench.tail<3>() += one.p.cross(one.f_W);
    addStiffness(stiffness_ * overlapArea(r, q, apart) * nhat * nhat.transpose(), one.p, stiffness);
  }
  return wrench;
}

}  // namespace presa
