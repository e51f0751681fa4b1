#include "modules/view_osg/models/model_surface.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "modules/view_osg/crease_normals.h"

namespace presa::view {
namespace {

using Vec3f = Eigen::Vector3f;

struct PlaceHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
    std::uint64_t h = 0;
    for (const std::uint32_t word : bits) h = (h ^ word) * 0x9e3779b97f4a7c15U, h ^= h >> 29U;
    return h;
  }
};

Vec3f vec(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

bool lacksNormal(const ModelVertex& vertex) { return vec(vertex.normal).isZero(0); }

/// One normal for each corner, from the shape alone.
std::vector<Vec3f> normalsFromShape(const Model& model, double crease_angle) {
  const std::vector<std::uint32_t> places = placesOf(model.vertices);
  TriMesh mesh;
  mesh.vertices.resize(model.vertices.size());
  for (std::size_t v = 0; v < places.size(); ++v)
    mesh.vertices[places[v]] = vec(model.vertices[v].position).cast<double>();
  for (std::size_t c = 0; c + 2 < model.corners.size(); c += 3) {
    const auto place = [&](std::size_t i) { return static_cast<std::int32_t>(places[model.corners[c + i]]); };
    mesh.triangles.push_back({place(0), place(1), place(2)});
  }
  return cornerNormals(mesh, crease_angle);
}

/// Gives each vertex the normals of its corners, and one copy for each further normal.
void splitByNormals(const Model& model, const std::vector<Vec3f>& normals, ModelSurface& out) {
  std::vector<std::vector<std::uint32_t>> copies(model.vertices.size());
  for (const Model::Part& part : model.parts) {
    Model::Part now = part;
    now.first_vertex = static_cast<std::uint32_t>(out.vertices.size());
    for (std::uint32_t c = part.first_corner; c < part.first_corner + part.corner_count; ++c) {
      const std::uint32_t v = model.corners[c];
      const bool has = !lacksNormal(model.vertices[v]);
      const Vec3f normal = has ? vec(model.vertices[v].normal) : normals[c];
      const auto same = [&](std::uint32_t copy) {
        return (vec(out.vertices[copy].normal) - normal).squaredNorm() < 1e-10F;
      };
      auto found = std::ranges::find_if(copies[v], same);
      if (found == copies[v].end()) {
        ModelVertex copy = model.vertices[v];
        copy.normal = {normal.x(), normal.y(), normal.z()};
        copies[v].push_back(static_cast<std::uint32_t>(out.vertices.size()));
        out.vertices.push_back(copy);
        found = copies[v].end() - 1;
      }
      out.corners.push_back(*found);
    }
    now.vertex_count = static_cast<std::uint32_t>(out.vertices.size()) - now.first_vertex;
    out.parts.push_back(now);
  }
}

void addTangents(ModelSurface& surface) {
  std::vector<Vec3f> along(surface.vertices.size(), Vec3f::Zero()), up = along;
  for (std::size_t c = 0; c + 2 < surface.corners.size(); c += 3) {
    const std::uint32_t* const at = &surface.corners[c];
    const ModelVertex &a = surface.vertices[at[0]], &b = surface.vertices[at[1]], &d = surface.vertices[at[2]];
    const Vec3f ab = vec(b.position) - vec(a.position), ad = vec(d.position) - vec(a.position);
    const float u1 = b.at[0] - a.at[0], v1 = b.at[1] - a.at[1], u2 = d.at[0] - a.at[0], v2 = d.at[1] - a.at[1];
    const float area = u1 * v2 - u2 * v1;
    if (area == 0) continue;
    const float weight = ab.cross(ad).norm();  // large triangles count more
    const Vec3f x = (ab * v2 - ad * v1) / area, y = (ad * u1 - ab * u2) / area;
    if (!x.allFinite() || !y.allFinite()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      along[at[i]] += weight * x.normalized();
      up[at[i]] += weight * y.normalized();
    }
  }
  surface.tangents.resize(surface.vertices.size());
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec3f n = vec(surface.vertices[v].normal);
    Vec3f t = along[v] - n * n.dot(along[v]);
    if (!(t.squaredNorm() > 0)) t = n.unitOrthogonal();
    t.normalize();
    surface.tangents[v] = {t.x(), t.y(), t.z(), n.cross(t).dot(up[v]) < 0 ? -1.0F : 1.0F};
  }
}

}  // namespace

std::vector<std::uint32_t> placesOf(const std::vector<ModelVertex>& vertices) {
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, PlaceHash> known;
  known.reserve(vertices.size());
  std::vector<std::uint32_t> places;
  places.reserve(vertices.size());
  for (const ModelVertex& vertex : vertices)
    places.push_back(known
                         .try_emplace(std::bit_cast<std::array<std::uint32_t, 3>>(vertex.position),
                                      static_cast<std::uint32_t>(known.size()))
                         .first->second);
  return places;
}

ModelSurface modelSurface(const Model& model, double crease_angle) {
  ModelSurface surface;
  if (std::ranges::any_of(model.vertices, lacksNormal)) {
    splitByNormals(model, normalsFromShape(model, crease_angle), surface);
  } else {
    surface.vertices = model.vertices, surface.corners = model.corners, surface.parts = model.parts;
  }
  const auto has_relief = [](const Model::Part& part) { return part.material.normal_map >= 0; };
  if (std::ranges::any_of(surface.parts, has_relief)) addTangents(surface);
  return surface;
}

}  // namespace presa::view
