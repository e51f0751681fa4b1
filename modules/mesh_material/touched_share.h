#pragma once
#include <memory>

#include "framework/haptics/surface_effect.h"
#include "modules/mesh_material/mesh_shares.h"

namespace presa {

/// The shares where a tool touches.
struct TouchedShare {
  double stiffness = 1, friction = 1;
  Vec3 gradient = Vec3::Zero();  ///< of the stiffness, by the place of the tool, in A [1/m]
};

/// Finds the shares of a body's mesh where a tool touches it. Thread: haptic, except for construction; nonblocking.
class ShareFinder {
 public:
  /// `tree`: of the mesh; null: a tool whose renderer names no triangles feels the material as it stands.
  ShareFinder(std::shared_ptr<const MeshShares> shares, std::shared_ptr<const MeshTree> tree, const Pose& X_BG);

  /// At the touched triangles; of a renderer that does not name any, at the one nearest to the touched point. On a
  /// convex edge the touched point moves along it only, at a corner not at all. In a hollow edge, where several triangles
  /// hold the tool, the shares are their mean by the parts of the force that they bear: continuous from side to side.
  TouchedShare at(const SurfaceInput& input, std::int32_t body) const noexcept;
  /// At the triangle nearest to p_B, within `reach`. Thread: any.
  TouchedShare near(const Vec3& p_B, double reach) const noexcept;
  const MeshShares& shares() const noexcept { return *shares_; }  ///< of the mesh

 private:
  TouchedShare nearest(const Vec3& p_B, double reach, const Vec3& nhat_B) const noexcept;
  TouchedShare on(const MeshTree& tree, const MeshTree::Facet& facet, const Vec3& x_G,
                  const Vec3& nhat_G) const noexcept;

  std::shared_ptr<const MeshShares> shares_;
  std::shared_ptr<const MeshTree> tree_;
  Pose X_BG_;
};

}  // namespace presa
