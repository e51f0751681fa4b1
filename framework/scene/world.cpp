#include "framework/scene/world.h"

#include <algorithm>
#include <array>

#include "framework/input/folders.h"
#include "framework/scene/inertia.h"
#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

using MeshPointer = std::shared_ptr<const TriMesh>;

/// A mesh file at one scale, with the strictest import options among its users.
struct MeshRequest {
  MeshRef ref;
  ImportOptions options;
  SourceLocation where;
  MeshPointer mesh;
};

int strictness(const ImportOptions& options) { return options.display_only ? 0 : options.must_be_closed ? 2 : 1; }

class MeshLibrary {
 public:
  /// Registers the mesh of a geometry; returns the index of the request, or -1 for primitives and absent geometry.
  int request(const std::optional<Geometry>& geometry, ImportOptions options) {
    const auto* ref = geometry ? std::get_if<MeshRef>(&geometry->shape) : nullptr;
    if (ref == nullptr) return -1;
    options.scale = ref->scale;
    const auto same = [&](const MeshRequest& r) { return r.ref.file == ref->file && r.ref.scale == ref->scale; };
    const auto found = std::ranges::find_if(requests_, same);
    if (found == requests_.end()) {
      requests_.push_back({*ref, options, geometry->where, nullptr});
      return static_cast<int>(requests_.size()) - 1;
    }
    if (strictness(options) > strictness(found->options)) {
      found->options = options;
      found->where = geometry->where;
    }
    return static_cast<int>(found - requests_.begin());
  }

  void importAll(Diagnostics& diagnostics) {
    for (MeshRequest& request : requests_) {
      if (!input::checkNamed(request.where, request.ref.file, diagnostics)) continue;
      TriMesh mesh = importMesh(request.ref.file, request.options, request.where, diagnostics);
      if (!mesh.triangles.empty()) request.mesh = std::make_shared<const TriMesh>(std::move(mesh));
    }
  }

  /// Null when there is no mesh or it could not be read.
  MeshPointer get(int request) const {
    return request < 0 ? nullptr : requests_[static_cast<std::size_t>(request)].mesh;
  }

 private:
  std::vector<MeshRequest> requests_;
};

}  // namespace

World buildWorld(Scene scene, Rig rig, Diagnostics& diagnostics) {
  World world{std::move(scene), std::move(rig), {}, {}};
  MeshLibrary library;
  std::vector<std::array<int, 3>> requests;
  for (const Body& body : world.scene.bodies) {
    const ImportOptions drawn{.must_be_closed = false, .display_only = true};
    const ImportOptions solid{.must_be_closed = !body.fixed};
    requests.push_back({library.request(body.visual, drawn), library.request(body.haptic, solid),
                        library.request(body.physics, solid)});
  }
  library.importAll(diagnostics);
  // the plug-ins read them, when a run makes their objects
  for (const PluginElement& element : world.scene.plugin_elements) {
    for (const std::string& file : filesNamedBy(element)) input::checkNamed(element.where, file, diagnostics);
  }
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    const auto& [visual, haptic, physics] = requests[b];
    world.meshes.push_back({library.get(visual), library.get(haptic), library.get(physics), nullptr});
    // an unreadable physics mesh has been reported; checking its mass would only add a second finding
    const bool unread = physics >= 0 && !world.meshes.back().physics;
    world.inertias.push_back(unread ? BodyInertia{} : inertiaOf(body, world.meshes.back().physics.get(), diagnostics));
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
