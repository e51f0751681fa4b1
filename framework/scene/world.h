#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/mesh_tree.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/scene/scene.h"

namespace presa {

/// Who holds fingers that are simulated. What is set here goes before the settings of the rig.
struct SimulatedPerson {
  std::uint64_t seed = 1, subject = 0;  ///< the same pair is the same person, in every run
  std::string level;                    ///< of the model; empty: the rig's
};

/// What the user asked of this run, beyond the scene.
struct RunOptions {
  enum class View { kNone, kOffscreen, kWindow };
  bool realtime = false;
  double duration = 10;  ///< simulated seconds
  std::uint64_t seed = 1;
  View view = View::kNone;
  std::string screenshot;         ///< PNG path, may be empty
  double screenshot_time = -1;    ///< [s]; -1: at the end
  std::string screenshots;        ///< folder for one picture every `screenshot_every`; may be empty
  double screenshot_every = 0;    ///< simulated [s]
  std::string record;             ///< HDF5 path, may be empty
  bool overwrite = false;         ///< `record` may replace an existing file
  std::vector<std::string> show;  ///< what the picture shows or leaves out beside its own choice: "haptic", "no-cones"
  std::string video;              ///< MP4 path, may be empty
  std::string flight;  ///< HDF5 path for the last seconds before a fault, where nothing is recorded; may be empty
  /// The same for a run that moves real hardware against the clock.
  std::string hardware_flight;
  bool allow_no_rt = false;  ///< hardware may run without real-time scheduling, with half the force
  double force_share = 1;    ///< of the force limits that this run may use
  bool bound_stiffness =
      false;  ///< materials too stiff for the devices are brought down; else they are as the scene has them
  std::optional<SimulatedPerson> person{};
  std::optional<BusSettings> bus{};  ///< goes before the rig's and the scene's; network none: no bus whatever those say
  bool bus_commands = false;         ///< the run takes commands, whatever rig and scene say
};

/// Meshes of one body; null where the geometry is a primitive or absent.
struct BodyMeshes {
  std::shared_ptr<const TriMesh> visual, haptic, physics;
  std::shared_ptr<const MeshTree> haptic_tree;  ///< over `haptic`; null where no finger can touch it
};

/// Mass, centre of mass (body frame) and inertia about it (body axes). Zero mass: fixed.
struct BodyInertia {
  double mass = 0;
  Vec3 p_BCm = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// The scene with its meshes read and its masses computed: constant during a run, shared by all modules.
struct World {
  Scene scene;
  Rig rig;
  RunOptions options;
  std::vector<BodyMeshes> meshes;     ///< as Scene::bodies
  std::vector<BodyInertia> inertias;  ///< as Scene::bodies
};

/// The bus that such a run publishes on; none: nobody asked for one.
std::optional<BusSettings> busOf(const Scene& scene, const Rig& rig, const RunOptions& options);
inline std::optional<BusSettings> busOf(const World& world) { return busOf(world.scene, world.rig, world.options); }
/// Whether commands may change the surfaces of such a run: over its bus, or in a replay that changes them again.
bool takesCommands(const World& world);

/// Reads every mesh the scene names (each file once) and computes mass properties from the physics geometry.
World buildWorld(Scene scene, Rig rig, RunOptions options, Diagnostics& diagnostics);

/// Makes the hierarchies over the haptic meshes, one for each mesh, if the scene has fingers. Part of buildWorld.
void indexHapticMeshes(World& world);

}  // namespace presa
