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

/// The simulated person who holds the simulated fingers. Takes precedence over the settings of the rig.
struct SimulatedPerson {
  std::uint64_t seed = 1, subject = 0;  ///< the same pair gives the same person in every run
  std::string level;                    ///< detail level of the model; empty: the rig's
};

/// Settings of one run beyond the scene, from the command line or an experiment.
struct RunOptions {
  enum class View { kNone, kOffscreen, kWindow };
  bool realtime = false;
  double duration = 10;  ///< simulated seconds
  std::uint64_t seed = 1;
  View view = View::kNone;
  std::string screenshot;         ///< PNG path, may be empty
  double screenshot_time = -1;    ///< simulated time [s]; -1: at the end
  std::string screenshots;        ///< folder for a series of pictures, one per `screenshot_every`; may be empty
  double screenshot_every = 0;    ///< interval in simulated time [s]
  std::string record;             ///< HDF5 path, may be empty
  bool overwrite = false;         ///< `record` may replace an existing file
  std::vector<std::string> show;  ///< overlays to show or hide in the picture: "haptic", "no-cones"
  std::string video;              ///< MP4 path, may be empty
  std::string flight;  ///< HDF5 path for the last seconds before a fault, when `record` is empty; may be empty
  /// As `flight`, for a run that drives real hardware in real time.
  std::string hardware_flight;
  bool allow_no_rt = false;  ///< hardware may run without real-time scheduling, at half the force
  double force_share = 1;    ///< fraction of the force limits that this run may use [-]
  bool bound_stiffness =
      false;  ///< reduce materials that are too stiff for the devices; otherwise the scene's stiffness is used
  std::optional<SimulatedPerson> person{};
  std::optional<BusSettings> bus{};  ///< takes precedence over rig and scene; network "none": no bus
  bool bus_commands = false;         ///< accept commands even if rig and scene do not
};

/// Meshes of one body; null where the geometry is a primitive or absent.
struct BodyMeshes {
  std::shared_ptr<const TriMesh> visual, haptic, physics;
  std::shared_ptr<const MeshTree> haptic_tree;  ///< hierarchy over `haptic`; null when no finger can touch it
};

/// Mass [kg], centre of mass in the body frame [m], inertia about it in body axes [kg m^2]. Zero mass: fixed body.
struct BodyInertia {
  double mass = 0;
  Vec3 p_BCm = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};

/// The scene with its meshes loaded and its masses computed. Constant during a run, shared by all modules and threads.
struct World {
  Scene scene;
  Rig rig;
  RunOptions options;
  std::vector<BodyMeshes> meshes;     ///< as Scene::bodies
  std::vector<BodyInertia> inertias;  ///< as Scene::bodies
};

/// The bus on which the run publishes, or none. Precedence: run options, rig, scene.
std::optional<BusSettings> busOf(const Scene& scene, const Rig& rig, const RunOptions& options);
inline std::optional<BusSettings> busOf(const World& world) { return busOf(world.scene, world.rig, world.options); }
/// Whether commands may change surfaces during the run: over its bus, or in a replay that repeats recorded commands.
bool takesCommands(const World& world);

/// Reads every mesh the scene names (each file once) and computes mass properties from the physics geometry.
World buildWorld(Scene scene, Rig rig, RunOptions options, Diagnostics& diagnostics);

/// Builds the hierarchies over the haptic meshes, one per mesh, when the scene has devices. Called by buildWorld.
void indexHapticMeshes(World& world);

}  // namespace presa
