#include "modules/mesh_material/mesh_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <stdexcept>

#include "framework/geometry/mesh_attributes.h"
#include "framework/haptics/graded_stiffness.h"

namespace presa {
namespace {

constexpr const char* kOfPart = "material_part";

/// The corner values of triangles as values of the welded vertices: their means, weighted by the angle at the vertex.
class VertexMeans {
 public:
  explicit VertexMeans(const TriMesh& mesh)
      : mesh_(mesh), sums_(mesh.vertices.size(), MaterialShare{0, 0}), angles_(mesh.vertices.size()) {}

  /// `valueAt(triangle, corner)`
  template <class ValueAt>
  std::vector<MaterialShare> of(const ValueAt& valueAt) {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const TriMesh::Triangle& corners = mesh_.triangles[t];
      const auto at = [&](std::size_t i) -> const Vec3& {
        return mesh_.vertices[static_cast<std::size_t>(corners[i])];
      };
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 u = at((i + 1) % 3) - at(i), v = at((i + 2) % 3) - at(i);
        const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
        const auto vertex = static_cast<std::size_t>(corners[i]);
        const MaterialShare value = valueAt(t, i);
        sums_[vertex].stiffness += angle * (value.stiffness - 1);
        sums_[vertex].friction += angle * (value.friction - 1);
        angles_[vertex] += angle;
      }
    }
    for (std::size_t v = 0; v < sums_.size(); ++v) {
      const double weight = angles_[v] > 0 ? 1 / angles_[v] : 0;
      sums_[v] = {1 + weight * sums_[v].stiffness, 1 + weight * sums_[v].friction};
    }
    return std::move(sums_);
  }

 private:
  const TriMesh& mesh_;
  std::vector<MaterialShare> sums_;  // of what is missing to 1, so that 1 stays exact
  std::vector<double> angles_;
};

MaterialShare shareIn(const PluginElement& element) {
  return {element.number("stiffness"), element.number("friction")};
}

std::vector<MaterialShare> partShares(const std::vector<const PluginElement*>& elements, const TriMesh& mesh,
                                      const MeshAttributes& attributes) {
  std::vector<MaterialShare> of_part(attributes.parts.size());
  for (const PluginElement* element : elements) {
    if (element->element != kOfPart) continue;
    const auto part = std::ranges::find(attributes.parts, element->text("name"));
    if (part != attributes.parts.end())
      of_part[static_cast<std::size_t>(part - attributes.parts.begin())] = shareIn(*element);
  }
  return VertexMeans(mesh).of([&](std::size_t t, std::size_t) {
    const std::int32_t part = attributes.part_of[t];
    return part < 0 ? MaterialShare{} : of_part[static_cast<std::size_t>(part)];
  });
}

std::vector<MaterialShare> colourShares(const MaterialShare& black, const TriMesh& mesh,
                                        const MeshAttributes& attributes) {
  return VertexMeans(mesh).of([&](std::size_t t, std::size_t corner) {
    const double grey = attributes.corner_grey[t][corner];
    return MaterialShare{black.stiffness + (1 - black.stiffness) * grey, black.friction + (1 - black.friction) * grey};
  });
}

/// Throws std::invalid_argument if the force of a triangle leans too far: the steepest one, and by how much.
void requireGentle(const MeshShares& shares) {
  const TriMesh& mesh = *shares.mesh;
  double worst = 0;
  Vec3 where = Vec3::Zero();
  for (const TriMesh::Triangle& corners : mesh.triangles) {
    std::array<Vec3, 3> p;
    std::array<double, 3> s{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = mesh.vertices[static_cast<std::size_t>(corners[i])];
      s[i] = shares.of_vertex[static_cast<std::size_t>(corners[i])].stiffness;
    }
    const Vec3 ab = p[1] - p[0], ac = p[2] - p[0], cross = ab.cross(ac);
    const double slope = ((s[1] - s[0]) * ac - (s[2] - s[0]) * ab).norm() / cross.norm();
    const double least = std::min({s[0], s[1], s[2]});
    if (!leansTooFar(slope, least) || !(slope / least > worst)) continue;
    worst = slope / least;
    where = (p[0] + p[1] + p[2]) / 3;
  }
  if (worst == 0) return;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "the stiffness changes too steeply in the triangle at (%.4g, %.4g, %.4g) of the mesh: at a depth of 2 mm "
      "the force would lean by %.0f degrees, more than 45; triangles there that are larger, or a stiffness "
      "nearer to 1",
      where.x(), where.y(), where.z(), std::atan(worst * kGradedDepth / 2) * 180 / 3.14159265358979);
  throw std::invalid_argument(text);
}

std::shared_ptr<const MeshShares> makeShares(const std::vector<const PluginElement*>& elements, const MeshRef& ref,
                                             std::shared_ptr<const TriMesh> mesh) {
  Diagnostics found;
  AttributedMesh read =
      importAttributed(ref.file, {.must_be_closed = false, .display_only = false, .scale = ref.scale}, {}, found);
  for (const Diagnostic& each : found.all())
    if (each.severity == Diagnostic::Severity::kError) throw std::invalid_argument(each.message);
  if (read.mesh.triangles != mesh->triangles || read.mesh.vertices != mesh->vertices)
    throw std::invalid_argument("mesh " + ref.file + " has changed since the scene was read");
  auto shares = std::make_shared<MeshShares>();
  shares->of_vertex = partShares(elements, *mesh, read.attributes);
  shares->has_colours = !read.attributes.corner_grey.empty();
  for (const PluginElement* element : elements) {
    if (element->element == kOfPart || !shares->has_colours) continue;
    const std::vector<MaterialShare> by_colour = colourShares(shareIn(*element), *mesh, read.attributes);
    for (std::size_t v = 0; v < by_colour.size(); ++v) {
      shares->of_vertex[v].stiffness *= by_colour[v].stiffness;
      shares->of_vertex[v].friction *= by_colour[v].friction;
    }
  }
  for (const MaterialShare& share : shares->of_vertex) {
    shares->grades_stiffness = shares->grades_stiffness || share.stiffness != 1;
    shares->grades_friction = shares->grades_friction || share.friction != 1;
  }
  shares->parts = std::move(read.attributes.parts);
  shares->mesh = std::move(mesh);
  requireGentle(*shares);
  return shares;
}

}  // namespace

std::vector<const PluginElement*> elementsBeside(const PluginElement& element, const World& world) {
  std::vector<const PluginElement*> all;
  for (const PluginElement& each : world.scene.plugin_elements)
    if (each.plugin == element.plugin && each.material == element.material) all.push_back(&each);
  return all;
}

std::shared_ptr<const MeshShares> sharesOf(const PluginElement& element, const World& world) {
  const auto index = static_cast<std::size_t>(element.body);
  const Body& body = world.scene.bodies[index];
  const auto* ref = std::get_if<MeshRef>(&body.haptic->shape);
  const std::shared_ptr<const TriMesh> mesh = world.meshes[index].haptic;
  if (ref == nullptr || !mesh)
    throw std::invalid_argument("body '" + body.name + "' is felt as a primitive; a " + element.element +
                                " needs a mesh from a file: <haptic><mesh file=\"…\"/></haptic>");
  const std::vector<const PluginElement*> elements = elementsBeside(element, world);
  std::string wanted;
  for (const PluginElement* each : elements)
    for (const auto& [name, value] : each->attributes) wanted.append(name).append("=").append(value).append("\n");
  static std::mutex mutex;
  static std::map<std::pair<const TriMesh*, std::string>, std::weak_ptr<const MeshShares>> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const auto& each) { return each.second.expired(); });
  std::weak_ptr<const MeshShares>& there = known[{mesh.get(), wanted}];
  std::shared_ptr<const MeshShares> shares = there.lock();
  if (!shares) there = shares = makeShares(elements, *ref, mesh);
  return shares;
}

}  // namespace presa
