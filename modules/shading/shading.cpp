// Force shading [Morgenbesser1996]: the normal is interpolated barycentrically between vertex normals [Thurmer1998], as
// in Phong shading. Each active constraint keeps its multiplier; only its normal is replaced. Invariants: the magnitude
// of the force and the depth stay; the force rotates by less than 60 degrees.
#include <cmath>
#include <vector>

#include "framework/geometry/rotation_between.h"
#include "framework/haptics/touchables.h"
#include "modules/haptics_proxy/finger_stage.h"

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
class Shading final : public FingerStage {
 public:
  explicit Shading(const World& world) {
    for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
      const auto& haptic = world.scene.bodies[b].haptic;
      const auto& mesh = world.meshes[b].haptic;
      const bool smooth = haptic && haptic->smooth && mesh;
      bodies_.push_back(smooth ? Smooth{mesh, haptic->X_BG.q, vertexNormals(*mesh)} : Smooth{});
    }
  }

  void apply(FingerTick& tick) noexcept override {
    ProxyContact& contact = tick.contact;
    if (!contact.state.touching || !bodies_[static_cast<std::size_t>(contact.body)].mesh) return;
    Surroundings& near = *tick.finger.near;
    near.use(Point::kGodObject);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.active.count); ++i) {
      const ActiveSet::Member& member = contact.active.member[i];
      sum += member.weight * normalOf(member, near.triangleOf(member.piece, contact.state.god_object), tick);
    }
    const double length = sum.norm();
    if (!(length > 0) || !(sum.dot(contact.nhat) > kMinCosine * length)) return;
    const Quat turn = rotationBetween(contact.nhat, sum);
    contact.nhat = sum / length;
    contact.tangential_displacement = turn * contact.tangential_displacement;
    contact.x = tick.g + contact.depth * contact.nhat + contact.tangential_displacement;
  }
  std::string what() const override { return "force shading: normals interpolated over the facets"; }

 private:
  struct Smooth {
    std::shared_ptr<const TriMesh> mesh;  ///< null: not smooth
    Quat q_BG = Quat::Identity();
    std::vector<Vec3> normals;  ///< mesh frame
  };

  // Interpolated normal, in A, of a piece that holds the fingertip.
  Vec3 normalOf(const ActiveSet::Member& member, const Surroundings::Triangle& triangle,
                const FingerTick& tick) const noexcept {
    const Smooth& body = bodies_[static_cast<std::size_t>(member.body)];
    if (!body.mesh || triangle.facet == nullptr) return member.nhat;
    const MeshTree::Facet& facet = *triangle.facet;
    const PreparedTriangle prepared(triangle.tree->corner(facet, 0), triangle.tree->corner(facet, 1),
                                    triangle.tree->corner(facet, 2));
    const Vec3 weight = cornerWeights(prepared, closestOnTriangle(triangle.x_G, prepared));
    const TriMesh::Triangle& corners = body.mesh->triangles[static_cast<std::size_t>(facet.id)];
    Vec3 normal_G = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      normal_G += weight[static_cast<Eigen::Index>(i)] * body.normals[static_cast<std::size_t>(corners[i])];
    }
    const Vec3 normal_W = tick.touchables.frameOf(member.body).q * (body.q_BG * normal_G);
    const Vec3 normal = tick.X_WA.q.conjugate() * normal_W;
    const double length = normal.norm();
    return length > 0 && normal.dot(member.nhat) > 0 ? Vec3(normal / length) : member.nhat;
  }

  static constexpr double kMinCosine = 0.5;  // the force rotates by less than 60 degrees, else shading is skipped
  std::vector<Smooth> bodies_;               // as Scene::bodies
};

}  // namespace

std::unique_ptr<FingerStage> makeShading(const World& world) { return std::make_unique<Shading>(world); }

}  // namespace presa
