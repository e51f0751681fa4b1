#include "framework/haptics/convex_parts.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <utility>

#include "framework/geometry/convex.h"
#include "framework/scene/piece_cache.h"

namespace presa {
namespace {

constexpr double kConvex = 1e-5;  // of the mesh's size: as isConvex

ConvexPart partOf(Hull hull, const Pose& X_AP) {
  hull.directions.clear();  // of the separating axis test alone; they would be turned in every tick
  ConvexPart part{.support = SupportOf(std::move(hull)), .X_AP = X_AP};
  const Hull& own = part.support.hull();
  part.centre_A = X_AP * own.centre;
  for (const Vec3& v : own.vertices) part.reach = std::max(part.reach, (v - own.centre).norm());
  part.reach += own.radius;
  return part;
}

/// A convex mesh, with few enough vertices; `error` grows to the height of the parts of it that this leaves out.
Hull hullOf(const TriMesh& mesh, std::size_t max_vertices, double& error) {
  if (mesh.vertices.size() <= max_vertices) {
    if (std::optional<Hull> hull = meshHull(mesh, kConvex, 2 * max_vertices)) return *std::move(hull);
  }
  const std::optional<TriMesh> around = convexHull(mesh.vertices, max_vertices);
  std::optional<Hull> hull = around ? meshHull(*around, kConvex, 2 * max_vertices) : std::nullopt;
  if (!hull) throw std::invalid_argument("a part of it is too flat for a convex solid");
  for (const Vec3& v : mesh.vertices) {
    double above = -1e300;
    for (const Hull::Face& face : hull->faces) above = std::max(above, face.nhat.dot(v) - face.offset);
    error = std::max(error, above);
  }
  return *std::move(hull);
}

/// Parts of a mesh in its own frame.
ConvexSolid partsOf(const TriMesh& mesh, const PartSettings& settings) {
  const MeshReport report = checkMesh(mesh);
  if (!report.closed() || report.flipped_edges > 0)
    throw std::invalid_argument("it is open or folded (" + std::to_string(report.open_edges) +
                                " open edges), and convex parts need an inside: close the mesh, or give a primitive");
  ConvexSolid solid;
  const auto add = [&](const TriMesh& piece) {
    solid.parts.push_back(partOf(hullOf(piece, settings.max_vertices, solid.error), Pose()));
  };
  if (isConvex(mesh, kConvex)) {
    add(mesh);
    return solid;
  }
  const ConvexPieces cut = cutIntoPieces(mesh, settings.cut);
  if (cut.pieces.empty()) throw std::invalid_argument("it encloses no volume");
  solid.error = cut.error;
  for (const auto& piece : cut.pieces) add(*piece);
  return solid;
}

std::optional<Hull> hullOf(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return boxHull(box->size);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphereHull(sphere->radius);
  if (const auto* rod = std::get_if<Cylinder>(&shape)) return cylinderHull(rod->radius, rod->length);
  if (const auto* rod = std::get_if<Capsule>(&shape)) return capsuleHull(rod->radius, rod->length);
  return std::nullopt;
}

/// Makes solids; equal meshes are cut once.
class Maker {
 public:
  explicit Maker(const PartSettings& settings) : settings_(settings) {}

  /// `X_AG`: of the mesh. Without parts where there is no mesh.
  ConvexSolid solidOf(const Geometry& geometry, const TriMesh* mesh, const Pose& X_AG, const std::string& whose) {
    if (std::optional<Hull> hull = hullOf(geometry.shape)) return {.parts = {partOf(*std::move(hull), geometry.X_BG)}};
    if (mesh == nullptr) return {};
    try {
      const auto [found, is_new] = known_.try_emplace(mesh);
      if (is_new) found->second = partsOf(*mesh, settings_);
      ConvexSolid solid = found->second;
      for (ConvexPart& part : solid.parts) {
        part.X_AP = X_AG;
        part.centre_A = X_AG * part.centre_A;
      }
      return solid;
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("the mesh of " + whose + " cannot be touched: " + error.what());
    }
  }

 private:
  PartSettings settings_;
  std::map<const TriMesh*, ConvexSolid> known_;
};

}  // namespace

PartSettings partSettings(const PluginElement& settings) {
  return {.cut = {.max_pieces = static_cast<std::size_t>(settings.number("max_pieces")),
                  .max_error = settings.number("max_error")},
          .max_vertices = static_cast<std::size_t>(settings.number("max_vertices"))};
}

std::vector<ConvexSolid> convexBodies(const World& world, const PartSettings& settings) {
  Maker maker(settings);
  std::vector<ConvexSolid> solids;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    if (!body.haptic) continue;
    ConvexSolid solid =
        maker.solidOf(*body.haptic, world.meshes[b].haptic.get(), body.haptic->X_BG, "body '" + body.name + "'");
    if (solid.parts.empty()) continue;
    solid.body = static_cast<std::int32_t>(b);
    solids.push_back(std::move(solid));
  }
  return solids;
}

std::vector<ConvexSolid> convexShapes(const World& world) {
  std::vector<ConvexSolid> solids;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const std::optional<Geometry>& haptic = world.scene.bodies[b].haptic;
    std::optional<Hull> hull = haptic ? hullOf(haptic->shape) : std::nullopt;
    if (hull)
      solids.push_back({.body = static_cast<std::int32_t>(b), .parts = {partOf(*std::move(hull), haptic->X_BG)}});
  }
  return solids;
}

// World::tools has the mesh in T already.
ConvexSolid convexTool(const World& world, std::size_t role, const PartSettings& settings) {
  const DeviceRole& device = world.scene.devices[role];
  return Maker(settings).solidOf(device.tool->geometry, world.tools[role].get(), Pose(),
                                 "the tool of '" + device.role + "'");
}

std::string textOf(const std::vector<ConvexSolid>& solids) {
  std::size_t parts = 0;
  double error = 0;
  for (const ConvexSolid& solid : solids) {
    parts += solid.parts.size();
    error = std::max(error, solid.error);
  }
  char text[120];
  std::snprintf(text, sizeof text, "%zu solids of %zu convex parts, up to %.3f mm from their meshes", solids.size(),
                parts, 1e3 * error);
  return text;
}

}  // namespace presa
