// Force shading [Morgenbesser1996]: the normal is interpolated barycentrically between vertex normals [Thurmer1998], as
// in Phong shading. Each active constraint keeps its multiplier; only its normal is replaced. Invariants: the magnitude
// of the force and the depth stay; the force rotates by less than 60 degrees.
#include <cmath>
#include <vector>

#include "framework/haptics/surface_effect.h"

namespace presa {
namespace {

/// Unit vertex normals: mean of the adjacent triangles' normals, weighted by their angle at the vertex [Thurmer1998].
std::vector<Vec3> vertexNormals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[i % 3])]; };
    const Vec3 cross = (at(1) - at(0)).cross(at(2) - at(0));
    if (!(cross.norm() > 0)) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 u = at(i + 1) - at(i), v = at(i + 2) - at(i);
      normals[static_cast<std::size_t>(t[i])] += std::atan2(u.cross(v).norm(), u.dot(v)) * cross.normalized();
    }
  }
  for (Vec3& normal : normals) normal.normalize();
  return normals;
}

/// Barycentric weights of point q of a triangle: q = w0 a + w1 b + w2 c.
Vec3 cornerWeights(const PreparedTriangle& t, const Vec3& q) noexcept {
  const Vec3 aq = q - t.a;
  const double d1 = t.ab.dot(aq), d2 = t.ac.dot(aq);
  const double area = t.ab_ab * t.ac_ac - t.ab_ac * t.ab_ac;
  if (!(area > 0)) return Vec3::Constant(1.0 / 3);
  const double w1 = (t.ac_ac * d1 - t.ab_ac * d2) / area, w2 = (t.ab_ab * d2 - t.ab_ac * d1) / area;
  return {1 - w1 - w2, w1, w2};
}

/// Force shading: facets of a mesh feel like the smooth surface they approximate. The normal of each triangle that
/// holds the fingertip is interpolated between its corners; the force rotates accordingly and keeps its magnitude.
class Shading final : public SurfaceEffect {
 public:
  Shading(const Geometry& haptic, std::shared_ptr<const TriMesh> mesh)
      : mesh_(std::move(mesh)), q_BG_(haptic.X_BG.q), normals_(vertexNormals(*mesh_)) {}

  Vec3 normal(const SurfaceInput& input, const ActiveSet::Member& member, const Vec3& nhat) noexcept override {
    const Surroundings::Triangle triangle =
        input.near.triangleOf(Point::kGodObject, member.piece, input.contact.state.god_object);
    if (triangle.facet == nullptr) return nhat;
    const MeshTree::Facet& facet = *triangle.facet;
    const PreparedTriangle prepared(triangle.tree->corner(facet, 0), triangle.tree->corner(facet, 1),
                                    triangle.tree->corner(facet, 2));
    const Vec3 weight = cornerWeights(prepared, closestOnTriangle(triangle.x_G, prepared));
    const TriMesh::Triangle& corners = mesh_->triangles[static_cast<std::size_t>(facet.id)];
    Vec3 normal_G = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      normal_G += weight[static_cast<Eigen::Index>(i)] * normals_[static_cast<std::size_t>(corners[i])];
    }
    const Vec3 normal_W = input.touchables.frameOf(member.body).q * (q_BG_ * normal_G);
    const Vec3 normal = input.X_WA.q.conjugate() * normal_W;
    const double length = normal.norm();
    return length > 0 && normal.dot(nhat) > 0 ? Vec3(normal / length) : nhat;
  }
  std::string what() const override { return "force shading: normals interpolated over the facets"; }

 private:
  std::shared_ptr<const TriMesh> mesh_;
  Quat q_BG_;
  std::vector<Vec3> normals_;  // mesh frame
};

const SurfaceEffectPlugin kPlugin{
    .name = "shading",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      const auto body = static_cast<std::size_t>(element.body);
      return std::make_unique<Shading>(*world.scene.bodies[body].haptic, world.meshes[body].haptic);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
