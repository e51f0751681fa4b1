#include "framework/geometry/tangent_frame.h"
#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

// Outward normal of the face that bears most: of the triangle, or of the side of a box. A curved primitive has the plane
// that the tool touches.
Vec3 faceNormal_A(const SurfaceInput& input) noexcept {
  const ProxyContact& contact = input.contact;
  const ActiveSet::Member* most = nullptr;
  for (int i = 0; i < contact.active.count; ++i) {
    const ActiveSet::Member& member = contact.active.member[static_cast<std::size_t>(i)];
    if (member.body == contact.body && (most == nullptr || member.weight > most->weight)) most = &member;
  }
  if (most == nullptr) return contact.nhat;
  if (most->piece.source < 0) {
    const auto* primitive = std::get_if<Primitive>(&input.near.primitive(most->piece.item).shape);
    if (primitive == nullptr || primitive->kind != Primitive::Kind::kBox) return most->nhat;
    const Vec3 nhat_G = primitive->X_AG.q.conjugate() * most->nhat;
    Eigen::Index side = 0;
    nhat_G.cwiseAbs().maxCoeff(&side);
    return primitive->X_AG.q * (nhat_G[side] < 0 ? Vec3(-Vec3::Unit(side)) : Vec3(Vec3::Unit(side)));
  }
  const Surroundings::Triangle triangle =
      input.near.triangleOf(Point::kGodObject, most->piece, contact.state.god_object);
  if (triangle.facet == nullptr) return most->nhat;
  const Vec3 a = triangle.tree->corner(*triangle.facet, 0);
  const Vec3 normal_G =
      (triangle.tree->corner(*triangle.facet, 1) - a).cross(triangle.tree->corner(*triangle.facet, 2) - a);
  if (!(normal_G.norm() > 0)) return most->nhat;
  const Vec3 normal = input.near.turnOf(most->piece) * normal_G.normalized();
  return normal.dot(most->nhat) < 0 ? Vec3(-normal) : normal;
}

}  // namespace

Pose SurfaceInput::X_BT() const noexcept {
  return tangentFrame(X_BA(contact.body).q * faceNormal_A(*this), touched_B());
}

}  // namespace presa
