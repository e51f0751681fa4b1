#include <algorithm>

#include "framework/geometry/convex_contact/cylinder.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {

std::optional<Hull> polyhedronOf(const PhysicsShape& shape) {
  if (const Box* box = std::get_if<Box>(shape.shape)) return boxHull(box->size);
  if (const Sphere* sphere = std::get_if<Sphere>(shape.shape)) return sphereHull(sphere->radius);
  if (const Cylinder* rod = std::get_if<Cylinder>(shape.shape)) return cylinderHull(rod->radius, rod->length);
  if (const Capsule* rod = std::get_if<Capsule>(shape.shape)) return capsuleHull(rod->radius, rod->length);
  return shape.mesh != nullptr ? meshHull(*shape.mesh) : std::nullopt;
}

namespace {

double halfDiagonal(const dReal* bounds) {
  return 0.5 * Vec3(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]).norm();
}

}  // namespace

void BodySet::createShapes(std::size_t i, const std::vector<PhysicsShape>& shapes) {
  Entry& entry = bodies_[i];
  entry.shapes.first = shapes_.size();
  for (const PhysicsShape& shape : shapes) {
    createGeom(entry, shape);
    if (shapes_.back().geom == nullptr) {
      shapes_.pop_back();
      continue;
    }
    shapes_.back().body = i;
    ++entry.shapes.count;
  }
  if (entry.shapes.count == 0) return;
  entry.extent = entry.rim = halfDiagonal(bounds(i).side);
  if (entry.shapes.count == 1) return;
  more_shapes_ += entry.shapes.count - 1;
  // the centre of mass may be far from the middle: a hammer's is in its head
  if (entry.body == nullptr) return;
  for (const ShapeEntry& shape : shapesOf(entry)) {
    entry.rim = std::max(entry.rim, toVec3(dGeomGetOffsetPosition(shape.geom)).norm() + shape.extent);
  }
}

void BodySet::createGeom(const Entry& entry, const PhysicsShape& physics) {
  ShapeEntry& shape = shapes_.emplace_back();
  struct Create {
    ShapeEntry& shape;
    const TriMesh* mesh;
    dGeomID operator()(const Box& box) { return dCreateBox(nullptr, box.size.x(), box.size.y(), box.size.z()); }
    dGeomID operator()(const Sphere& sphere) { return dCreateSphere(nullptr, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) { return dCreateCylinder(nullptr, cylinder.radius, cylinder.length); }
    dGeomID operator()(const Capsule& capsule) { return dCreateCapsule(nullptr, capsule.radius, capsule.length); }
    dGeomID operator()(const Compound&) { return nullptr; }
    dGeomID operator()(const MeshRef&) {
      if (mesh == nullptr || mesh->triangles.empty()) return nullptr;
      for (const Vec3& v : mesh->vertices) shape.vertices.insert(shape.vertices.end(), {v.x(), v.y(), v.z()});
      for (const TriMesh::Triangle& t : mesh->triangles) {
        for (const std::int32_t index : t) shape.indices.push_back(static_cast<dTriIndex>(index));
      }
      shape.mesh_data = dGeomTriMeshDataCreate();
      dGeomTriMeshDataBuildDouble(shape.mesh_data, shape.vertices.data(), 3 * sizeof(double),
                                  static_cast<int>(mesh->vertices.size()), shape.indices.data(),
                                  static_cast<int>(shape.indices.size()), 3 * sizeof(dTriIndex));
      return dCreateTriMesh(nullptr, shape.mesh_data, nullptr, nullptr, nullptr);
    }
  };
  shape.hull = polyhedronOf(physics);
  shape.geom = std::visit(Create{shape, physics.mesh}, *physics.shape);
  if (shape.geom == nullptr) return;
  if (entry.body != nullptr) {
    dGeomSetBody(shape.geom, entry.body);
    const Vec3 p_CmG = physics.X_BG.p - entry.p_BCm;
    dGeomSetOffsetPosition(shape.geom, p_CmG.x(), p_CmG.y(), p_CmG.z());
    dGeomSetOffsetQuaternion(shape.geom, toOde(physics.X_BG.q).data());
  } else {
    const Pose X_WG = entry.X_WB * physics.X_BG;
    dGeomSetPosition(shape.geom, X_WG.p.x(), X_WG.p.y(), X_WG.p.z());
    dGeomSetQuaternion(shape.geom, toOde(X_WG.q).data());
  }
  dReal bounds[6];
  dGeomGetAABB(shape.geom, bounds);
  shape.extent = halfDiagonal(bounds);
}

}  // namespace presa::ode
