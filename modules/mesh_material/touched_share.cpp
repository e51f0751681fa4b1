#include "modules/mesh_material/touched_share.h"

#include <algorithm>
#include <array>

#include "framework/geometry/closest_point.h"

namespace presa {
namespace {

constexpr double kEdge = 1e-4;      // sine of the angle between contact and face, from which it is an edge or a corner
constexpr double kCorner = 1e-9;    // barycentric weight below which a corner has no part in a point
constexpr double kParallel = 1e-9;  // determinant of the products of normals, below which they are one plane
constexpr double kReach = 1e-3;     // of the search for the nearest triangle, beyond the tool [m]

/// Facet nearest to p, within `reach`; null: none.
struct NearestFacet {
  const MeshTree& tree;
  const Vec3& p;
  double reach;
  const MeshTree::Facet* found = nullptr;

  void look(std::int32_t index) noexcept {
    const MeshTree::Node& node = tree.node(index);
    for (std::int32_t f = 0; f < node.count; ++f) {
      const MeshTree::Facet& facet = tree.facet(node.first + f);
      const double away =
          (p - closestOnTriangle(p, tree.corner(facet, 0), tree.corner(facet, 1), tree.corner(facet, 2))).norm();
      if (away > reach) continue;
      reach = away;
      found = &facet;
    }
    if (node.isLeaf()) return;
    double left = 0, right = 0;
    tree.bound(node.first, p, left);
    tree.bound(node.first + 1, p, right);
    const bool left_first = left <= right;
    if (std::min(left, right) <= reach) look(node.first + (left_first ? 0 : 1));
    if (std::max(left, right) <= reach) look(node.first + (left_first ? 1 : 0));
  }
};

/// The part of a gradient over the triangle along which the touched point can move; w: its barycentric weights.
Vec3 alongFeature(const Vec3& gradient, const PreparedTriangle& t, const Vec3& w, const Vec3& nhat_G) noexcept {
  const Vec3 face = t.ab.cross(t.ac).normalized();
  if (!(face.cross(nhat_G).norm() > kEdge)) return gradient;
  if ((w.array() < kCorner).count() > 1) return Vec3::Zero();
  Eigen::Index opposite = 0;
  w.minCoeff(&opposite);
  const Vec3 edge = (opposite == 0 ? Vec3(t.c - t.b) : opposite == 1 ? t.ac : t.ab).normalized();
  return gradient.dot(edge) * edge;
}

}  // namespace

ShareFinder::ShareFinder(std::shared_ptr<const MeshShares> shares, std::shared_ptr<const MeshTree> tree,
                         const Pose& X_BG)
    : shares_(std::move(shares)), tree_(std::move(tree)), X_BG_(X_BG) {}

// Gradient in mesh coordinates.
TouchedShare ShareFinder::on(const MeshTree& tree, const MeshTree::Facet& facet, const Vec3& x_G,
                             const Vec3& nhat_G) const noexcept {
  const PreparedTriangle t(tree.corner(facet, 0), tree.corner(facet, 1), tree.corner(facet, 2));
  const TriMesh::Triangle& corners = shares_->mesh->triangles[static_cast<std::size_t>(facet.id)];
  const auto share = [&](std::size_t i) -> const MaterialShare& {
    return shares_->of_vertex[static_cast<std::size_t>(corners[i])];
  };
  const MaterialShare &a = share(0), &b = share(1), &c = share(2);
  const Vec3 aq = closestOnTriangle(x_G, t) - t.a;
  const double d1 = t.ab.dot(aq), d2 = t.ac.dot(aq), area = t.ab_ab * t.ac_ac - t.ab_ac * t.ab_ac;
  if (!(area > 0)) return {a.stiffness, a.friction, Vec3::Zero()};
  const double w1 = (t.ac_ac * d1 - t.ab_ac * d2) / area, w2 = (t.ab_ab * d2 - t.ab_ac * d1) / area;
  const Vec3 w(1 - w1 - w2, w1, w2);
  const double sb = b.stiffness - a.stiffness, sc = c.stiffness - a.stiffness;
  TouchedShare here{a.stiffness + w1 * sb + w2 * sc,
                    a.friction + w1 * (b.friction - a.friction) + w2 * (c.friction - a.friction), Vec3::Zero()};
  if (sb == 0 && sc == 0) return here;
  const Vec3 gradient = ((sb * t.ac_ac - sc * t.ab_ac) * t.ab + (sc * t.ab_ab - sb * t.ab_ac) * t.ac) / area;
  here.gradient = alongFeature(gradient, t, w, nhat_G);
  return here;
}

// Zero nhat_B: any direction of contact that its triangle can have.
TouchedShare ShareFinder::nearest(const Vec3& p_B, double reach, const Vec3& nhat_B) const noexcept {
  if (!tree_) return {};
  const Vec3 p_G = X_BG_.inverseTimes(p_B);
  NearestFacet nearest{*tree_, p_G, reach};
  nearest.look(MeshTree::kRoot);
  if (nearest.found == nullptr) return {};
  TouchedShare here = on(*tree_, *nearest.found, p_G, X_BG_.q.conjugate() * nhat_B);
  here.gradient = X_BG_.q * here.gradient;
  return here;
}

TouchedShare ShareFinder::near(const Vec3& p_B, double reach) const noexcept {
  return nearest(p_B, reach, Vec3::Zero());
}

// In a hollow edge the tool's centre x can move along the edge only, while the goal g moves within the wedge of the
// normals N: x - g = N w. The share s = sum w_i s_i / sum w_i has, by g, the gradient
// P sum w_i grad s_i / sum w_i - N (N^T N)^-1 c, c_i = (s_i - s) / sum w, P the projection across all normals.
TouchedShare ShareFinder::at(const SurfaceInput& input, std::int32_t body) const noexcept {
  const ActiveSet& active = input.contact.active;
  std::array<TouchedShare, 3> each;
  Mat3 normals = Mat3::Zero();  // of up to three planes
  Vec3 weight = Vec3::Zero();
  double sum = 0;
  int last = -1, own = 0;
  for (int i = 0; i < active.count; ++i) {
    const ActiveSet::Member& member = active.member[static_cast<std::size_t>(i)];
    normals.col(i) = member.nhat;
    if (member.body != body) continue;
    const Surroundings::Triangle touched =
        input.near.triangleOf(Point::kGodObject, member.piece, input.contact.state.god_object);
    if (touched.facet == nullptr) continue;
    const Mat3 R_AG = input.near.turnOf(member.piece);
    TouchedShare& here = each[static_cast<std::size_t>(i)];
    here = on(*touched.tree, *touched.facet, touched.x_G, R_AG.transpose() * member.nhat);
    here.gradient = R_AG * here.gradient;
    weight[i] = member.weight;
    sum += member.weight;
    ++own;
    if (last < 0 || weight[i] > weight[last]) last = i;
  }
  if (own == 0) {
    const Pose X_BA = input.X_BA(body);
    TouchedShare here = nearest(input.touched_B(), input.radius + kReach, X_BA.q * input.contact.nhat);
    here.gradient = X_BA.q.conjugate() * here.gradient;
    return here;
  }
  const TouchedShare& most = each[static_cast<std::size_t>(last)];
  const auto alone = [&]() -> TouchedShare {
    const Vec3 nhat = normals.col(last);
    return {most.stiffness, most.friction, most.gradient - most.gradient.dot(nhat) * nhat};
  };
  if (active.count == 1 || !(sum > 0)) return alone();
  Mat3 products = normals.transpose() * normals;
  for (int i = active.count; i < 3; ++i) products(i, i) = 1;
  if (!(products.determinant() > kParallel)) return alone();
  weight /= sum;
  TouchedShare mean{0, 0, Vec3::Zero()};
  for (int i = 0; i < active.count; ++i) {
    const TouchedShare& here = each[static_cast<std::size_t>(i)];
    mean.stiffness += weight[i] * here.stiffness;
    mean.friction += weight[i] * here.friction;
    mean.gradient += weight[i] * here.gradient;
  }
  Vec3 steps = Vec3::Zero();
  for (int i = 0; i < active.count; ++i) {
    const bool is_own = active.member[static_cast<std::size_t>(i)].body == body;
    steps[i] = is_own ? (each[static_cast<std::size_t>(i)].stiffness - mean.stiffness) / sum : 0;
  }
  mean.gradient -= normals * (products.inverse() * (normals.transpose() * mean.gradient + steps));
  return mean;
}

}  // namespace presa
