#pragma once
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"
#include "framework/core/schedule/rates.h"
#include "framework/scene/assembly_words.h"

/// A scene as plain data: what the user wrote, with every default filled in. SI units throughout.
/// Immutable after loading; every module reads it, none keeps a second copy of a value.
namespace presa {

struct MeshRef {
  std::string file;  ///< absolute or relative to the working directory, already resolved
  Vec3 scale = Vec3::Ones();
};
struct Box {
  Vec3 size = Vec3::Zero();
};  ///< full edge lengths [m], centred
struct Sphere {
  double radius = 0;
};  ///< [m]
struct Cylinder {
  double radius = 0;
  double length = 0;
};  ///< axis z, centred [m]
struct Capsule {
  double radius = 0;
  double length = 0;
};  ///< axis z, centred; length without the caps [m]
using Shape = std::variant<MeshRef, Box, Sphere, Cylinder, Capsule>;

/// Of the sphere around a primitive, about its own origin [m]; a mesh is not known here and gives 0.
inline double boundingRadius(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return (box->size / 2).norm();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return std::hypot(cylinder->radius, cylinder->length / 2);
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius + capsule->length / 2;
  return 0;
}

/// One geometry of a body (visual, haptic or physics), placed in the body frame B.
struct Geometry {
  Shape shape;
  Pose X_BG;
  SourceLocation where;
  bool smooth = false;  ///< haptic mesh: felt with normals interpolated over its facets
};

struct FrictionCoefficients {
  double mu_static = 0;   ///< [-], >= dynamic
  double mu_dynamic = 0;  ///< [-]
};

struct Material {
  std::string name;
  double stiffness = 0;         ///< [N/m], > 0
  double damping = 0;           ///< [N s/m], >= 0
  double friction_static = 0;   ///< [-], >= dynamic
  double friction_dynamic = 0;  ///< [-]
  double torsion = 0;           ///< a soft fingertip resists turning about its normal by friction at this radius [m]
  std::optional<FrictionCoefficients>
      changed_friction;       ///< under a finger after the surfaces have changed; none: as before
  Vec3 color{0.7, 0.7, 0.7};  ///< linear RGB in [0, 1]
  enum class Texture { kNone, kStone, kEarth };
  Texture texture = Texture::kNone;  ///< how it is drawn
  SourceLocation where;
};

struct Body {
  std::string name;
  bool fixed = false;
  Pose X_WB;                        ///< start pose; B's origin is the centre of mass for primitives
  Vec3 v_WCm = Vec3::Zero();        ///< of the centre of mass at the start [m/s]
  Vec3 w_WB = Vec3::Zero();         ///< at the start [rad/s]
  Vec3 force_W = Vec3::Zero();      ///< constant, at the centre of mass [N]
  std::size_t material = 0;         ///< index into Scene::materials
  std::optional<double> mass;       ///< [kg]; exactly one of mass and density for a free body
  std::optional<double> density;    ///< [kg/m^3]
  std::optional<Geometry> visual;   ///< absent: drawn as haptic, else as physics
  std::optional<Geometry> haptic;   ///< absent: fingers pass through
  std::optional<Geometry> physics;  ///< absent (fixed bodies only): other bodies pass through
  SourceLocation where;
};

struct DeviceLimits {
  double force = 8;          ///< magnitude [N]
  double force_rate = 1000;  ///< slew [N/s]
  double watchdog_ms = 20;   ///< age of the contact information at which the force fades [ms]
};

/// A device role: what the scene asks for. The rig says which hardware plays it.
struct DeviceRole {
  std::string role;
  double fingertip_radius = 0.008;  ///< [m]; 0: a point
  DeviceLimits limits;
  SourceLocation where;
};

/// How fingers are rendered. The defaults are Presa's methods, the others what they replace.
struct HapticSettings {
  enum class Renderer { kGodObject, kPenalty };
  enum class PoseUse { kInterpolate, kHold };
  Renderer renderer = Renderer::kGodObject;
  PoseUse pose = PoseUse::kInterpolate;
};

struct CollisionSettings {
  double margin = 0;              ///< of the patch beyond the fingertip [m]; 0: from the finger's motion
  std::size_t max_triangles = 0;  ///< without effect; accepted for the sake of older scenes
};

/// How moving bodies are stepped. The defaults are Presa's methods, the others what they replace.
struct DynamicsSettings {
  enum class Engine { kOde, kMujoco, kBullet };  ///< all but the first: to compare with, without fingers
  enum class Coupling { kSoft, kExplicit };
  enum class Solver { kAuto, kDirect, kIterative };
  enum class Friction { kIsotropic, kPyramid };
  /// kMatrix: R (I + S(w) dt), re-orthonormalised; kEuler: one Euler step of Euler's equations.
  enum class Rotation { kExact, kEngine, kNone, kEuler, kMatrix };
  Engine engine = Engine::kOde;
  Coupling coupling = Coupling::kSoft;
  Solver solver = Solver::kAuto;
  std::size_t iterations = 0;  ///< of the iterative solver; 0: as many as the period allows
  std::size_t substeps = 0;    ///< within one period; 0: chosen for each island
  Friction friction = Friction::kIsotropic;
  Rotation rotation = Rotation::kExact;
  bool sleeping = true;
};

/// A place of an assembly, and what may stand there.
struct AssemblyGoal {
  std::string name;
  std::vector<std::size_t> bodies;   ///< indices into Scene::bodies: any one of them fits
  Pose X_WB;                         ///< of the body that stands here
  std::size_t fold = 1;              ///< turned by 1/fold about its own z axis it is the same; 0: by anything
  std::vector<std::size_t> after;    ///< goals that have to be filled first, indices into Assembly::goals
  std::size_t element = kNoElement;  ///< index into AssemblyWords::elements
};

/// Bodies that are to be put together: each is drawn to its place when it is near, and stays there.
struct Assembly {
  double reach = 0.02;             ///< a place draws what is this near [m]
  double reach_angle_deg = 30;     ///< and turned away by no more than this
  double tolerance = 0.0005;       ///< in its place: this near [m]
  double tolerance_angle_deg = 1;  ///< and turned away by no more than this
  double pull = 1.5;               ///< most that a place draws with, in weights of the body on Earth
  /// A body that leaves this box, axes along W's, is brought back; none: it may go where it likes.
  struct Field {
    Vec3 centre = Vec3::Zero(), size = Vec3::Zero();  ///< [m]
  };
  std::optional<Field> field;
  std::vector<AssemblyGoal> goals;
  AssemblyWords words;
  double spent = 0;  ///< that people have worked on it before this run [s]
};

/// Where a run's state is published for viewers (framework/bus).
struct BusSettings {
  std::string network = "loopback";  ///< loopback, lan, lan:INTERFACE, or none
  int domain = 0;                    ///< viewers join the same; kLeastBusDomain to kMostBusDomain
  bool commands = false;             ///< others may set parameters of the run; else nobody listens
  std::string keys{};                ///< folder of this process's certificate (presa bus keys); empty: none
};
inline constexpr int kLeastBusDomain = 0, kMostBusDomain = 200;
/// Whether that names a network.
bool isBusNetwork(const std::string& network);

struct Scene {
  std::string name;
  std::string description;
  std::string file;           ///< as given
  std::string default_rig;    ///< resolved path, may be empty
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  Rates rates;
  HapticSettings haptics;
  CollisionSettings collision;
  DynamicsSettings dynamics;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<DeviceRole> devices;
  std::optional<Assembly> assembly;
  std::optional<BusSettings> bus;
  std::string resolved_xml;  ///< the document after --set and defaults, as saved with recordings

  const Material& materialOf(const Body& body) const { return materials[body.material]; }
  /// Something that fingers touch has friction to change to, and a renderer that has friction.
  bool surfacesChange() const;
};

/// One role bound to a driver, with the driver's own settings.
struct DeviceBinding {
  struct Setting {
    std::string value;
    SourceLocation where;
  };
  std::string role;
  std::string driver;                       ///< folder name under devices/
  std::map<std::string, Setting> settings;  ///< <set key= value=/>; the driver checks keys and values
  /// What this desk allows, beside what the scene wants; where nothing is said, the driver's rating holds.
  struct Limits {
    std::optional<double> force, force_rate, soft_start, continuous, speed;  ///< [N] [N/s] [s] [N] [m/s]
    bool records_overload = false;  ///< past `continuous` is an event, no limit
    bool passivity = false;         ///< the hand may get no net energy
  };
  Limits limits;
  SourceLocation where;
};

/// A lab's devices. The scene stays portable, the rig is this desk.
struct Rig {
  std::string name;
  std::string file;
  std::optional<BusSettings> bus;  ///< goes before the scene's
  std::vector<DeviceBinding> devices;
  std::string resolved_xml;
};

}  // namespace presa
