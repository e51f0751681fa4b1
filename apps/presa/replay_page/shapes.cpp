#include "apps/presa/replay_page/shapes.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/presa/replay_page/packed.h"
#include "framework/geometry/decimate.h"
#include "framework/geometry/model.h"
#include "framework/scene/physics_shapes.h"

namespace presa::replay_page {
namespace {

using nlohmann::json;

struct DrawnShape {
  const Shape* shape = nullptr;
  const TriMesh* mesh = nullptr;  ///< null for a primitive
  Pose X_BG;
};

std::vector<DrawnShape> drawnShapes(const Body& body, const BodyMeshes& meshes) {
  if (body.visual) return {{&body.visual->shape, meshes.visual.get(), body.visual->X_BG}};
  if (body.haptic) return {{&body.haptic->shape, meshes.haptic.get(), body.haptic->X_BG}};
  std::vector<DrawnShape> shapes;
  for (const PhysicsShape& part : physicsShapes(body, meshes)) shapes.push_back({part.shape, part.mesh, part.X_BG});
  return shapes;
}

json poseOf(const Pose& X) { return {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()}; }

std::vector<double> coordinatesOf(const TriMesh& mesh) {
  std::vector<double> all;
  all.reserve(3 * mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) all.insert(all.end(), {p.x(), p.y(), p.z()});
  return all;
}

template <class Index>
std::string cornersOf(const TriMesh& mesh) {
  std::vector<Index> all;
  all.reserve(3 * mesh.triangles.size());
  for (const TriMesh::Triangle& triangle : mesh.triangles) {
    for (const std::int32_t corner : triangle) all.push_back(static_cast<Index>(corner));
  }
  return packedBytes(all);
}

json meshOf(const TriMesh& mesh) {
  const bool small = mesh.vertices.size() <= 0x10000;
  return {{"v", packed(coordinatesOf(mesh))},
          {"i", small ? cornersOf<std::uint16_t>(mesh) : cornersOf<std::uint32_t>(mesh)},
          {"wide", !small}};
}

/// The meshes of a page, each once, and their indices.
class MeshTable {
 public:
  std::size_t add(const TriMesh* mesh) {
    const auto [at, is_new] = index_.try_emplace(mesh, meshes_.size());
    if (is_new) meshes_.push_back(mesh);
    return at->second;
  }
  /// Each mesh keeps its share of the triangles, and is still a solid shape where there are very many.
  json written() const {
    std::size_t all = 0;
    for (const TriMesh* mesh : meshes_) all += mesh->triangles.size();
    json list = json::array();
    for (const TriMesh* mesh : meshes_) {
      const std::size_t share = mesh->triangles.size() * kMaxTriangles / std::max<std::size_t>(all, 1);
      const bool fits = all <= kMaxTriangles;
      TriMesh fewer = fits ? *mesh : decimateMesh(*mesh, std::max<std::size_t>(share, 12));
      dropUnused(fewer);
      list.push_back(meshOf(fewer));
    }
    return list;
  }

 private:
  std::map<const TriMesh*, std::size_t> index_;  // is never iterated: its order is that of addresses
  std::vector<const TriMesh*> meshes_;
};

json shapeOf(const DrawnShape& drawn, MeshTable& meshes) {
  json shape{{"pose", poseOf(drawn.X_BG)}};
  if (drawn.mesh != nullptr) {
    shape["mesh"] = meshes.add(drawn.mesh);
  } else if (const auto* box = std::get_if<Box>(drawn.shape)) {
    shape["box"] = {box->size.x(), box->size.y(), box->size.z()};
  } else if (const auto* sphere = std::get_if<Sphere>(drawn.shape)) {
    shape["sphere"] = sphere->radius;
  } else if (const auto* cylinder = std::get_if<Cylinder>(drawn.shape)) {
    shape["cylinder"] = {cylinder->radius, cylinder->length};
  } else if (const auto* capsule = std::get_if<Capsule>(drawn.shape)) {
    shape["capsule"] = {capsule->radius, capsule->length};
  }
  return shape;
}

json colorOf(const Vec3& color) { return {color.x(), color.y(), color.z()}; }

/// The mean colour of a body's model, where its vertices and materials tell it; textures are not decoded here.
Vec3 shownColor(const Material& material, const Model* model) {
  if (model == nullptr) return material.color;
  Vec3 sum = Vec3::Zero();
  for (const Model::Part& part : model->parts) {
    if (part.material.color_map >= 0) return material.color;
    for (std::uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      const std::array<float, 3>& c = model->vertices[v].color;
      sum += Vec3(c[0], c[1], c[2]).cwiseProduct(part.material.color);
    }
  }
  return sum / static_cast<double>(model->vertices.size());
}

json partsOf(const PageFigures& figures, MeshTable& meshes) {
  json parts = json::array();
  for (const PageFigure& figure : figures) {
    for (const FigurePart& part : figure.drawn->parts()) {
      json shapes = json::array();
      for (const FigureShape& shape : part.shapes) {
        shapes.push_back(shapeOf({&shape.shape, shape.mesh.get(), shape.X_PG}, meshes));
        shapes.back()["color"] = colorOf(shape.color);
      }
      parts.push_back({{"name", part.name}, {"shapes", shapes}});
    }
  }
  return parts;
}

/// The lowest point of a shape at the body's start pose [m].
double lowestOf(const DrawnShape& drawn, const Pose& X_WB) {
  const Pose X_WG = X_WB * drawn.X_BG;
  return X_WG.p.z() - supportOf(*drawn.shape, drawn.mesh, X_WG.q.conjugate() * Vec3(0, 0, -1));
}

}  // namespace

json shapesOf(const World& world, const PageFigures& figures) {
  MeshTable meshes;
  json bodies = json::array();
  double floor = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < std::min(world.scene.bodies.size(), kMaxBodies); ++b) {
    const Body& body = world.scene.bodies[b];
    const Material& material = world.scene.materialOf(body);
    json shapes = json::array();
    for (const DrawnShape& drawn : drawnShapes(body, world.meshes[b])) {
      shapes.push_back(shapeOf(drawn, meshes));
      floor = std::min(floor, lowestOf(drawn, body.X_WB));
    }
    bodies.push_back({{"name", body.name},
                      {"color", colorOf(shownColor(material, world.meshes[b].model.get()))},
                      {"mu", material.friction_static},
                      {"pose", poseOf(body.X_WB)},
                      {"fixed", body.fixed},
                      {"shapes", shapes}});
  }
  const json parts = partsOf(figures, meshes);
  return {{"meshes", meshes.written()},
          {"bodies", bodies},
          {"parts", parts},
          {"floor", std::isfinite(floor) ? floor : 0.0}};
}

}  // namespace presa::replay_page
