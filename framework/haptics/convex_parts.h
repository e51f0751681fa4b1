#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/geometry/convex_contact/cylinder.h"
#include "framework/geometry/convex_contact/distance.h"
#include "framework/geometry/convex_contact/manifold.h"
#include "framework/scene/world.h"

namespace presa {

/// A convex part of a tool or of a body.
struct ConvexPart {
  SupportOf support;             ///< its hull, in the frame P of the part
  Pose X_AP;                     ///< P in the tool or body
  Vec3 centre_A = Vec3::Zero();  ///< of a sphere around the part, in the tool or body [m]
  double reach = 0;              ///< radius of that sphere [m]
};

/// A tool or a body as convex parts.
struct ConvexSolid {
  std::int32_t body = kNoBody;    ///< index into Scene::bodies; kNoBody: a tool
  std::vector<ConvexPart> parts;  ///< at least one
  double error = 0;               ///< how far their union is from the surface that was given, at most [m]
};

/// How meshes become convex parts. Primitives are exact.
struct PartSettings {
  Decomposition cut;               ///< of meshes that are not convex
  std::size_t max_vertices = 256;  ///< of a part
};

/// From the attributes max_pieces, max_error and max_vertices of a renderer's element.
PartSettings partSettings(const PluginElement& settings);

/// The touchable bodies of a world. A cut that took long is kept in the user's cache. Throws std::invalid_argument for a
/// mesh that is open. Thread: before a run.
std::vector<ConvexSolid> convexBodies(const World& world, const PartSettings& settings);
/// The touchable bodies that are no meshes; each is one part, exactly. Thread: before a run.
std::vector<ConvexSolid> convexShapes(const World& world);
/// The tool of a device role, in the frame T of the handle; the same errors.
ConvexSolid convexTool(const World& world, std::size_t role, const PartSettings& settings);

/// "3 solids of 17 convex parts", and by how much they differ from their meshes, for `presa explain`.
std::string textOf(const std::vector<ConvexSolid>& solids);

}  // namespace presa
