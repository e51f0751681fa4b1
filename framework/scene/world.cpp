#include "framework/scene/world.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <tuple>

#include "framework/geometry/convex.h"
#include "framework/geometry/model.h"
#include "framework/input/folders.h"
#include "framework/scene/inertia.h"
#include "framework/scene/piece_cache.h"
#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

enum WorldCode { kNotConvex = 322, kFarFromMesh = 323 };

using MeshPointer = std::shared_ptr<const TriMesh>;

/// A mesh file at one scale, with the strictest import options among its users.
struct MeshRequest {
  MeshRef ref;
  ImportOptions options;
  SourceLocation where;
  bool drawn = false;  ///< one of its users is a visual geometry, which takes colours and textures from it
  MeshPointer mesh = nullptr;
  std::shared_ptr<const Model> model = nullptr;
};

bool isDecomposed(const std::optional<Geometry>& geometry) {
  const auto* mesh = geometry ? std::get_if<MeshRef>(&geometry->shape) : nullptr;
  return mesh != nullptr && mesh->decompose;
}

int strictness(const ImportOptions& options) { return options.display_only ? 0 : options.must_be_closed ? 2 : 1; }

class MeshLibrary {
 public:
  /// Registers the mesh of a geometry; returns the index of the request, or -1 for primitives and absent geometry.
  int request(const std::optional<Geometry>& geometry, const ImportOptions& options) {
    return geometry ? request(geometry->shape, geometry->where, options) : -1;
  }
  int request(const Shape& shape, const SourceLocation& where, ImportOptions options) {
    const auto* ref = std::get_if<MeshRef>(&shape);
    if (ref == nullptr) return -1;
    options.scale = ref->scale;
    const auto same = [&](const MeshRequest& r) { return r.ref.file == ref->file && r.ref.scale == ref->scale; };
    const auto found = std::ranges::find_if(requests_, same);
    if (found == requests_.end()) {
      requests_.push_back({*ref, options, where, options.display_only});
      return static_cast<int>(requests_.size()) - 1;
    }
    found->drawn = found->drawn || options.display_only;
    if (strictness(options) > strictness(found->options)) {
      found->options = options;
      found->where = where;
    }
    return static_cast<int>(found - requests_.begin());
  }

  void importAll(Diagnostics& diagnostics) {
    std::vector<MeshOrder> orders;
    std::vector<MeshRequest*> allowed;
    for (MeshRequest& request : requests_) {
      if (!input::checkNamed(request.where, request.ref.file, diagnostics)) continue;
      orders.push_back({request.ref.file, request.options, request.where, request.drawn});
      allowed.push_back(&request);
    }
    std::vector<DrawnMesh> read = importMeshes(orders, diagnostics);
    for (std::size_t i = 0; i < read.size(); ++i) {
      allowed[i]->model = std::move(read[i].model);
      if (!read[i].mesh.triangles.empty()) allowed[i]->mesh = std::make_shared<const TriMesh>(std::move(read[i].mesh));
    }
  }

  /// Null when there is no mesh or it could not be read.
  MeshPointer get(int request) const {
    return request < 0 ? nullptr : requests_[static_cast<std::size_t>(request)].mesh;
  }
  std::shared_ptr<const Model> model(int request) const {
    return request < 0 ? nullptr : requests_[static_cast<std::size_t>(request)].model;
  }

 private:
  std::vector<MeshRequest> requests_;
};

/// Cuts meshes into convex pieces, equal ones once.
class Decomposer {
 public:
  const ConvexPieces& cut(const MeshPointer& mesh, const Decomposition& wanted) {
    const auto [found, is_new] = known_.try_emplace({mesh.get(), wanted.max_pieces, wanted.max_error});
    if (is_new) found->second = cutIntoPieces(*mesh, wanted);
    return found->second;
  }

 private:
  std::map<std::tuple<const TriMesh*, std::size_t, double>, ConvexPieces> known_;
};

std::string millimetres(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g mm", 1e3 * length);
  return text;
}

void warnIfFar(const Body& body, const MeshRef& mesh, const SourceLocation& where, const ConvexPieces& found,
               Diagnostics& diagnostics) {
  const Decomposition& wanted = *mesh.decompose;
  if (found.error <= wanted.max_error) return;
  diagnostics.warning(kFarFromMesh, where,
                      "body '" + body.name + "': " + std::to_string(found.pieces.size()) +
                          " convex pieces differ from " + mesh.file + " by " + millimetres(found.error) +
                          ", wanted: up to " + millimetres(wanted.max_error),
                      "more max_pieces (found " + std::to_string(wanted.max_pieces) +
                          ", up to 256), a larger max_error, or a mesh of fewer and larger faces");
}

/// Decomposes the meshes of a physics geometry that ask for it; of several shapes each must be convex then (E322).
void makeConvex(const Body& body, BodyMeshes& meshes, Decomposer& decomposer, Diagnostics& diagnostics) {
  if (!body.physics) return;
  const auto look = [&](const Shape& shape, const SourceLocation& where, const MeshPointer& mesh, std::size_t index,
                        std::size_t count) {
    const auto* ref = std::get_if<MeshRef>(&shape);
    if (ref == nullptr || !ref->decompose) return false;
    meshes.decomposed.resize(count);
    meshes.decomposed[index] = decomposer.cut(mesh, *ref->decompose);
    warnIfFar(body, *ref, where, meshes.decomposed[index], diagnostics);
    return true;
  };
  const auto* compound = std::get_if<Compound>(&body.physics->shape);
  if (compound == nullptr) {
    look(body.physics->shape, body.physics->where, meshes.physics, 0, 1);
    return;
  }
  for (std::size_t k = 0; k < compound->parts.size(); ++k) {
    const ShapePart& part = compound->parts[k];
    if (look(part.shape, part.where, meshes.parts[k], k, compound->parts.size())) continue;
    if (!meshes.parts[k] || isConvex(*meshes.parts[k])) continue;
    diagnostics.error(kNotConvex, part.where,
                      "body '" + body.name + "': mesh " + std::get<MeshRef>(part.shape).file +
                          " is one of several physics shapes, but not convex",
                      "decompose=\"true\" cuts it into convex pieces; or give a convex mesh, or primitives");
  }
}

/// The surface of a tool in the frame of its handle; empty: its file could not be read.
TriMesh toolMesh(const Geometry& geometry, const MeshPointer& read) {
  TriMesh mesh;
  if (const auto* box = std::get_if<Box>(&geometry.shape)) mesh = makeBox(box->size);
  if (const auto* sphere = std::get_if<Sphere>(&geometry.shape)) mesh = makeSphere(sphere->radius);
  if (const auto* rod = std::get_if<Cylinder>(&geometry.shape)) mesh = makeCylinder(rod->radius, rod->length);
  if (const auto* rod = std::get_if<Capsule>(&geometry.shape)) mesh = makeCapsule(rod->radius, rod->length);
  if (read) mesh = *read;
  for (Vec3& v : mesh.vertices) v = geometry.X_BG * v;
  buildAdjacency(mesh);
  return mesh;
}

}  // namespace

World buildWorld(Scene scene, Rig rig, Diagnostics& diagnostics) {
  World world{std::move(scene), std::move(rig), {}, {}};
  MeshLibrary library;
  std::vector<std::array<int, 3>> requests;
  std::vector<std::vector<int>> part_requests;
  for (const Body& body : world.scene.bodies) {
    const ImportOptions drawn{.must_be_closed = false, .display_only = true};
    const ImportOptions solid{.must_be_closed = !body.fixed};
    const ImportOptions moved{.must_be_closed = !body.fixed || isDecomposed(body.physics)};
    requests.push_back({library.request(body.visual, drawn), library.request(body.haptic, solid),
                        library.request(body.physics, moved)});
    part_requests.emplace_back();
    const auto* compound = body.physics ? std::get_if<Compound>(&body.physics->shape) : nullptr;
    if (compound == nullptr) continue;
    for (const ShapePart& part : compound->parts)
      part_requests.back().push_back(library.request(part.shape, part.where, {.must_be_closed = true}));
  }
  std::vector<int> tool_requests;
  for (const DeviceRole& role : world.scene.devices) {
    tool_requests.push_back(
        role.tool ? library.request(role.tool->geometry.shape, role.tool->geometry.where, {.must_be_closed = true})
                  : -1);
  }
  library.importAll(diagnostics);
  Decomposer decomposer;
  // the plug-ins read them, when a run makes their objects
  for (const PluginElement& element : world.scene.plugin_elements) {
    for (const std::string& file : filesNamedBy(element)) input::checkNamed(element.where, file, diagnostics);
  }
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    const auto& [visual, haptic, physics] = requests[b];
    world.meshes.push_back({library.get(visual), library.get(haptic), library.get(physics), nullptr});
    BodyMeshes& meshes = world.meshes.back();
    meshes.model = library.model(visual);
    for (const int part : part_requests[b]) meshes.parts.push_back(library.get(part));
    // an unreadable physics mesh has been reported; checking its mass would only add a second finding
    const bool unread = (physics >= 0 && !meshes.physics) ||
                        std::ranges::any_of(part_requests[b], [&](int r) { return r >= 0 && !library.get(r); });
    world.inertias.push_back(unread ? BodyInertia{} : inertiaOf(body, meshes, diagnostics));
    if (!unread) makeConvex(body, meshes, decomposer, diagnostics);
  }
  for (std::size_t d = 0; d < world.scene.devices.size(); ++d) {
    const std::optional<Tool>& tool = world.scene.devices[d].tool;
    world.tools.push_back(
        tool ? std::make_shared<const TriMesh>(toolMesh(tool->geometry, library.get(tool_requests[d]))) : nullptr);
  }
  if (!diagnostics.hasErrors()) indexHapticMeshes(world);
  return world;
}

void indexHapticMeshes(World& world) {
  if (world.scene.devices.empty()) return;
  std::map<const TriMesh*, std::shared_ptr<const MeshTree>> trees;  // bodies with the same mesh share its hierarchy
  for (BodyMeshes& meshes : world.meshes) {
    if (!meshes.haptic) continue;
    std::shared_ptr<const MeshTree>& tree = trees[meshes.haptic.get()];
    if (!tree) tree = std::make_shared<const MeshTree>(meshes.haptic);
    meshes.haptic_tree = tree;
  }
}

}  // namespace presa
