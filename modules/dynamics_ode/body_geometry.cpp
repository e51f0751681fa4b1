#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/convex/cylinder.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {

void BodySet::createGeom(Entry& entry, const Geometry& geometry, const TriMesh* mesh) {
  struct Create {
    Entry& entry;
    const TriMesh* mesh;
    dGeomID operator()(const Box& box) { return dCreateBox(nullptr, box.size.x(), box.size.y(), box.size.z()); }
    dGeomID operator()(const Sphere& sphere) { return dCreateSphere(nullptr, sphere.radius); }
    dGeomID operator()(const Cylinder& cylinder) { return dCreateCylinder(nullptr, cylinder.radius, cylinder.length); }
    dGeomID operator()(const Capsule& capsule) { return dCreateCapsule(nullptr, capsule.radius, capsule.length); }
    dGeomID operator()(const MeshRef&) {
      if (mesh == nullptr || mesh->triangles.empty()) return nullptr;
      for (const Vec3& v : mesh->vertices) entry.vertices.insert(entry.vertices.end(), {v.x(), v.y(), v.z()});
      for (const TriMesh::Triangle& t : mesh->triangles) {
        for (const std::int32_t index : t) entry.indices.push_back(static_cast<dTriIndex>(index));
      }
      entry.mesh_data = dGeomTriMeshDataCreate();
      dGeomTriMeshDataBuildDouble(entry.mesh_data, entry.vertices.data(), 3 * sizeof(double),
                                  static_cast<int>(mesh->vertices.size()), entry.indices.data(),
                                  static_cast<int>(entry.indices.size()), 3 * sizeof(dTriIndex));
      return dCreateTriMesh(nullptr, entry.mesh_data, nullptr, nullptr, nullptr);
    }
  };
  if (const Box* box = std::get_if<Box>(&geometry.shape)) entry.hull = boxHull(box->size);
  if (const Sphere* sphere = std::get_if<Sphere>(&geometry.shape)) entry.hull = sphereHull(sphere->radius);
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&geometry.shape)) {
    entry.hull = cylinderHull(cylinder->radius, cylinder->length);
  }
  if (const Capsule* capsule = std::get_if<Capsule>(&geometry.shape)) {
    entry.hull = capsuleHull(capsule->radius, capsule->length);
  }
  if (std::holds_alternative<MeshRef>(geometry.shape) && mesh != nullptr) entry.hull = meshHull(*mesh);
  entry.geom = std::visit(Create{entry, mesh}, geometry.shape);
  if (entry.geom == nullptr) return;
  if (entry.body != nullptr) {
    dGeomSetBody(entry.geom, entry.body);
    const Vec3 p_CmG = geometry.X_BG.p - entry.p_BCm;
    dGeomSetOffsetPosition(entry.geom, p_CmG.x(), p_CmG.y(), p_CmG.z());
    dGeomSetOffsetQuaternion(entry.geom, toOde(geometry.X_BG.q).data());
  } else {
    const Pose X_WG = entry.X_WB * geometry.X_BG;
    dGeomSetPosition(entry.geom, X_WG.p.x(), X_WG.p.y(), X_WG.p.z());
    dGeomSetQuaternion(entry.geom, toOde(X_WG.q).data());
  }
  dReal bounds[6];
  dGeomGetAABB(entry.geom, bounds);
  entry.extent = 0.5 * Vec3(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]).norm();
}

}  // namespace presa::ode
