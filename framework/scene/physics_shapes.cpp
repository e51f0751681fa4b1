#include "framework/scene/physics_shapes.h"

#include <algorithm>
#include <cmath>

namespace presa {
namespace {

void append(std::vector<PhysicsShape>& shapes, const Shape& shape, const TriMesh* mesh, const Pose& X_BG,
            const BodyMeshes& meshes, std::size_t index) {
  if (index >= meshes.decomposed.size() || meshes.decomposed[index].pieces.empty()) {
    shapes.push_back({&shape, mesh, X_BG});
    return;
  }
  for (const auto& piece : meshes.decomposed[index].pieces) shapes.push_back({&shape, piece.get(), X_BG});
}

template <class SceneOrConst, class Ref>
void appendMeshes(SceneOrConst& scene, std::vector<Ref*>& refs) {
  const auto add = [&](auto& shape) {
    if (auto* mesh = std::get_if<MeshRef>(&shape)) refs.push_back(mesh);
  };
  for (auto& body : scene.bodies) {
    for (auto* geometry : {&body.visual, &body.haptic, &body.physics}) {
      if (!geometry->has_value()) continue;
      add((*geometry)->shape);
      if (auto* compound = std::get_if<Compound>(&(*geometry)->shape)) {
        for (auto& part : compound->parts) add(part.shape);
      }
    }
  }
  for (auto& device : scene.devices) {
    if (device.tool) add(device.tool->geometry.shape);
  }
}

struct Support {
  const TriMesh* mesh;
  const Vec3& n;
  double operator()(const Box& box) const { return n.cwiseAbs().dot(box.size) / 2; }
  double operator()(const Sphere& sphere) const { return sphere.radius; }
  double operator()(const Cylinder& rod) const {
    return rod.radius * std::hypot(n.x(), n.y()) + rod.length / 2 * std::abs(n.z());
  }
  double operator()(const Capsule& rod) const { return rod.radius + rod.length / 2 * std::abs(n.z()); }
  double operator()(const MeshRef&) const {
    if (mesh == nullptr || mesh->vertices.empty()) return 0;
    double farthest = mesh->vertices[0].dot(n);
    for (const Vec3& v : mesh->vertices) farthest = std::max(farthest, v.dot(n));
    return farthest;
  }
  double operator()(const Compound&) const { return 0; }
};

}  // namespace

std::vector<PhysicsShape> physicsShapes(const Body& body, const BodyMeshes& meshes) {
  std::vector<PhysicsShape> shapes;
  if (!body.physics) return shapes;
  const Geometry& geometry = *body.physics;
  const auto* compound = std::get_if<Compound>(&geometry.shape);
  if (compound == nullptr) {
    append(shapes, geometry.shape, meshes.physics.get(), geometry.X_BG, meshes, 0);
    return shapes;
  }
  for (std::size_t k = 0; k < compound->parts.size(); ++k) {
    const ShapePart& part = compound->parts[k];
    const TriMesh* mesh = k < meshes.parts.size() ? meshes.parts[k].get() : nullptr;
    append(shapes, part.shape, mesh, geometry.X_BG * part.X_GP, meshes, k);
  }
  return shapes;
}

bool hasSeveralShapes(const Body& body, const BodyMeshes& meshes) {
  return body.physics && (std::holds_alternative<Compound>(body.physics->shape) || !meshes.decomposed.empty());
}

double supportOf(const Shape& shape, const TriMesh* mesh, const Vec3& nhat_G) {
  return std::visit(Support{mesh, nhat_G}, shape);
}

double supportOf(const Body& body, const BodyMeshes& meshes, const Vec3& nhat_B) {
  const std::vector<PhysicsShape> shapes = physicsShapes(body, meshes);
  if (shapes.empty()) return 0;
  double farthest = -1e300;
  for (const PhysicsShape& shape : shapes) {
    const Vec3 nhat_G = shape.X_BG.q.conjugate() * nhat_B;
    farthest = std::max(farthest, shape.X_BG.p.dot(nhat_B) + supportOf(*shape.shape, shape.mesh, nhat_G));
  }
  return farthest;
}

std::vector<MeshRef*> meshesOf(Scene& scene) {
  std::vector<MeshRef*> refs;
  appendMeshes(scene, refs);
  return refs;
}

std::vector<const MeshRef*> meshesOf(const Scene& scene) {
  std::vector<const MeshRef*> refs;
  appendMeshes(scene, refs);
  return refs;
}

}  // namespace presa
