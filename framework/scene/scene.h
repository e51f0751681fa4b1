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
#include "framework/scene/joints/joint.h"
#include "framework/scene/plugin_element.h"

/// A scene as plain data: the user's values with every default filled in. SI units throughout.
/// Immutable after loading. Every module reads it; no module keeps a second copy of a value.
namespace presa {

/// How a physics mesh that is not convex is cut into convex pieces at load.
struct Decomposition {
  std::size_t max_pieces = 64;  ///< upper bound of their number, up to 256
  double max_error = 0.001;     ///< depth to which a piece may bridge a hollow of the mesh [m]
};
/// A mesh file and how it is read.
struct MeshRef {
  std::string file;                          ///< resolved path: absolute, or relative to the working directory
  Vec3 scale = Vec3::Ones();                 ///< per axis [-]; see ImportOptions::scale
  std::optional<Decomposition> decompose{};  ///< physics only; none: the mesh as it is
};
/// A box, centred.
struct Box {
  Vec3 size = Vec3::Zero();  ///< full edge lengths [m]
};
/// A sphere, centred.
struct Sphere {
  double radius = 0;  ///< [m]
};
/// A cylinder, axis z, centred.
struct Cylinder {
  double radius = 0;  ///< [m]
  double length = 0;  ///< [m]
};
/// A capsule, axis z, centred.
struct Capsule {
  double radius = 0;  ///< [m]
  double length = 0;  ///< without the caps [m]
};
struct ShapePart;
/// Several shapes that together are one physics geometry (framework/scene/physics_shapes.h lists them).
struct Compound {
  std::vector<ShapePart> parts;  ///< at least one, in document order
};
/// Any shape that a geometry can have.
using Shape = std::variant<MeshRef, Box, Sphere, Cylinder, Capsule, Compound>;
/// One shape of a Compound.
struct ShapePart {
  Shape shape;           ///< no Compound
  Pose X_GP;             ///< in the frame of the geometry
  SourceLocation where;  ///< its element in the scene
};

/// Radius of the bounding sphere of a primitive about its own origin [m]; 0 for a mesh, whose size is not known here,
/// and for a Compound.
inline double boundingRadius(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return (box->size / 2).norm();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return std::hypot(cylinder->radius, cylinder->length / 2);
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius + capsule->length / 2;
  return 0;
}

/// One geometry of a body (visual, haptic or physics), placed in the body frame B.
struct Geometry {
  Shape shape;           ///< in the geometry frame G
  Pose X_BG;             ///< pose of G in the body
  SourceLocation where;  ///< its element in the scene
  bool smooth = false;   ///< haptic mesh: rendered with normals interpolated over the facets (force shading)
};

/// Coulomb friction between a finger and a surface.
struct FrictionCoefficients {
  double mu_static = 0;   ///< [-], >= dynamic
  double mu_dynamic = 0;  ///< [-]
};

/// How surfaces feel, look, and rub against each other.
struct Material {
  std::string name;             ///< unique among materials (E203)
  double stiffness = 0;         ///< [N/m], > 0
  double damping = 0;           ///< [N s/m], >= 0
  double friction_static = 0;   ///< [-], >= dynamic
  double friction_dynamic = 0;  ///< [-]
  double torsional_radius = 0;  ///< torsional friction radius of a soft fingertip about the contact normal [m]
  double rolling = 0;  ///< rolling resistance between bodies: moment over normal force [m], >= 0; a pair has the sum
  double restitution = 0;  ///< between bodies [-], in [0, 1]; a pair has the geometric mean
  std::optional<FrictionCoefficients>
      changed_friction;       ///< friction under a finger after the surface change of an experiment; none: no change
  Vec3 color{0.7, 0.7, 0.7};  ///< linear RGB in [0, 1]
  /// Pattern that the view draws over `color`.
  enum class Texture { kNone, kStone, kEarth };
  Texture texture = Texture::kNone;  ///< how it is drawn
  SourceLocation where;              ///< its element in the scene
};

/// A rigid body.
struct Body {
  std::string name;                 ///< unique among bodies (E203)
  bool fixed = false;               ///< never moves: part of the world
  Pose X_WB;                        ///< start pose; B's origin is the centre of mass for primitives
  Vec3 v_WCm = Vec3::Zero();        ///< initial velocity of the centre of mass [m/s]
  Vec3 w_WB = Vec3::Zero();         ///< initial angular velocity [rad/s]
  Vec3 force_W = Vec3::Zero();      ///< constant external force at the centre of mass [N]
  std::size_t material = 0;         ///< index into Scene::materials
  std::optional<double> mass;       ///< [kg]; exactly one of mass and density for a free body
  std::optional<double> density;    ///< [kg/m^3]
  std::optional<Vec3> p_BCm;        ///< centre of mass [m]; only with `inertia`; absent: that of the shapes
  std::optional<Mat3> inertia_B;    ///< about the centre of mass [kg m^2], with `mass`; absent: that of the shapes
  std::optional<Geometry> visual;   ///< absent: the haptic geometry is drawn, else the physics geometry
  std::optional<Geometry> haptic;   ///< absent: fingers pass through
  std::optional<Geometry> physics;  ///< absent (fixed bodies only): other bodies pass through
  SourceLocation where;             ///< its element in the scene
};

/// Limits that the scene sets for a device role. The rig may tighten them.
struct DeviceLimits {
  double force = 8;          ///< magnitude [N]
  double force_rate = 1000;  ///< slew [N/s]
  double torque = 0.5;       ///< magnitude [N m]
  double torque_rate = 50;   ///< slew [N m/s]; raised if `torque` would take more than 12 ms to zero
  double watchdog_ms = 20;   ///< age of the object state at which the force fades [ms]
};

/// The spring-damper between a tool with volume and the handle of the device that holds it (virtual coupling). Its
/// forces grow linearly up to half of their limit and then approach the limit, so that no jam exceeds it.
struct ToolCoupling {
  double stiffness = 1000;     ///< [N/m], > 0
  double turn_stiffness = 1;   ///< [N m/rad], > 0
  double damping = 0,          ///< of the tool's motion against the handle [N s/m]
      turn_damping = 0;        ///< the same of its turning [N m s/rad]
  double max_force = 8,        ///< [N], > 0
      max_torque = 0.5;        ///< [N m], > 0
  bool damping_along = false;  ///< damps only along the spring, and only a tool that comes back to the handle
};

/// A solid in the hand, instead of a fingertip: it touches with its whole surface.
struct Tool {
  Geometry geometry;      ///< X_BG is its pose in the frame T of the handle
  ToolCoupling coupling;  ///< between handle and tool
  /// Bit of FingerInput::buttons that puts it down and picks it up; none: it is always held.
  std::optional<int> put_down{};
};

/// A device role that the scene asks for. The rig binds hardware to it.
struct DeviceRole {
  std::string role;                 ///< "thumb": the rig binds a device to it
  double fingertip_radius = 0.008;  ///< [m]; 0: point contact
  std::optional<Tool> tool{};       ///< none: a fingertip, a sphere; its radius does not count then
  DeviceLimits limits;              ///< the rig may tighten them
  SourceLocation where;             ///< its element in the scene
};

inline constexpr const char* kDefaultRenderer = "god_object";      ///< of a scene that names none, as in its schema
inline constexpr const char* kDefaultToolRenderer = "pointshell";  ///< of a scene with tools that names none
inline constexpr const char* kDefaultEngine = "ode";               ///< of a scene that names none, as in its schema

/// Haptic rendering method. The defaults are Presa's methods; the other values select the conventional ones for
/// comparison.
struct HapticSettings {
  /// Poses of bodies within a dynamics step: interpolated to the tick, or held at the end of the step.
  enum class PoseUse { kInterpolate, kHold };
  std::string renderer = kDefaultRenderer;           ///< plug-in (framework/haptics/renderer.h)
  bool proxy = true;                                 ///< its manifest gives a proxy that friction can hold
  PoseUse pose = PoseUse::kInterpolate;              ///< of bodies in the haptic tick
  std::string tool_renderer = kDefaultToolRenderer;  ///< plug-in of tools (framework/haptics/tool_renderer.h)
};

/// How the collision thread finds what is near a finger.
struct CollisionSettings {
  /// How the collision thread finds the triangles near a finger: the hierarchy of the haptic tick alone, a tree of
  /// oriented boxes, or a uniform grid of such trees (H-COLLIDE).
  enum class Index { kTree, kObb, kHcollide };
  Index index = Index::kTree;  ///< of haptic meshes
  double margin = 0;  ///< extent of the neighbourhood beyond the fingertip [m]; 0: chosen from the finger's motion
};

/// Dynamics methods. The defaults are Presa's methods; the other values select the conventional ones for comparison.
struct DynamicsSettings {
  /// kSoft: fingers are implicit spring-dampers in the solver; kExplicit: their force acts for one step; kAveraged: the
  /// mean force since the step before acts for one step; kHapticRate: soft, and at the haptic rate for bodies that
  /// fingers hold, up to `max_held` together.
  enum class Coupling { kSoft, kExplicit, kAveraged, kHapticRate };
  /// kAuto: chosen for each island; kDirect, kIterative: of the engine; kNewton, kSmallSteps: Presa's own
  /// (modules/dynamics_ode).
  enum class Solver { kAuto, kDirect, kIterative, kNewton, kSmallSteps };
  /// Between bodies: Coulomb's cone, or the engine's own pyramid, too strong between its axes.
  enum class Friction { kIsotropic, kPyramid };
  /// kExact: Presa's own; kEngine: the engine's; kNone: no gyroscopic term; kMatrix: R (I + S(w) dt),
  /// re-orthonormalised; kEuler: one Euler step of Euler's equations.
  enum class Rotation { kExact, kEngine, kNone, kEuler, kMatrix };
  std::string engine = kDefaultEngine;       ///< name of a plug-in's manifest
  Coupling coupling = Coupling::kSoft;       ///< of fingers with bodies
  Solver solver = Solver::kAuto;             ///< of contacts between bodies
  std::size_t iterations = 0;                ///< of the iterative solver; 0: as many as fit into the period
  std::size_t substeps = 0;                  ///< per period; 0: chosen for each island
  Friction friction = Friction::kIsotropic;  ///< between bodies
  Rotation rotation = Rotation::kExact;      ///< of free bodies over a step
  bool sleeping = true;                      ///< bodies at rest and out of reach cost nothing
  std::string coupling_reason{};  ///< why kHapticRate was chosen for a scene that states no coupling; else empty
  std::size_t max_held = 3;       ///< of kHapticRate: largest group of bodies in contact that the haptic thread moves
};

/// A goal of an assembly: a target pose and the bodies that may fill it.
struct AssemblyGoal {
  std::string name;                  ///< unique among the goals (E203)
  std::vector<std::size_t> bodies;   ///< indices into Scene::bodies; any one of them fits
  Pose X_WB;                         ///< target pose of the body
  std::size_t fold = 1;              ///< order of rotational symmetry about the body's z axis (n-fold; 0: continuous)
  std::vector<std::size_t> after;    ///< goals that must be filled first, indices into Assembly::goals
  std::size_t element = kNoElement;  ///< index into AssemblyWords::elements
  double snap_distance = 0;          ///< of this goal; 0: Assembly::snap_distance [m]
};

/// An assembly task. A body near a free goal is pulled to it and then stays there.
struct Assembly {
  double snap_distance = 0.02;     ///< snap distance: a goal pulls bodies within it [m]
  double snap_angle_deg = 30;      ///< snap angle: maximum rotation away from the goal [deg]
  double tolerance = 0.0005;       ///< a body counts as placed within this distance [m]
  double tolerance_angle_deg = 1;  ///< and within this angle [deg]
  double snap_force = 1.5;         ///< maximum snap force, in multiples of the body's weight on Earth [-]
  /// Workspace, an axis-aligned box in W: a body that leaves it is brought back. None: unlimited.
  struct Workspace {
    Vec3 centre = Vec3::Zero(),  ///< [m]
        size = Vec3::Zero();     ///< full edge lengths [m]
  };
  std::optional<Workspace> workspace;  ///< none: unlimited
  std::vector<AssemblyGoal> goals;     ///< in document order
  AssemblyWords words;                 ///< shown to the user
  double elapsed = 0;                  ///< assembly time carried over from earlier runs [s]

  /// Snap distance of one of its goals [m].
  double snapDistanceOf(const AssemblyGoal& goal) const noexcept {
    return goal.snap_distance > 0 ? goal.snap_distance : snap_distance;
  }
};

/// Where a run's state is published for viewers (framework/bus).
struct BusSettings {
  std::string network = "loopback";  ///< loopback, lan, lan:INTERFACE, or none
  int domain = 0;                    ///< DDS domain that viewers must join; kMinBusDomain to kMaxBusDomain
  bool commands = false;             ///< accept commands that set parameters of the run
  std::string keys{};                ///< folder with this process's certificate (presa bus keys); empty: no security
};
inline constexpr int kMinBusDomain = 0,  ///< of BusSettings::domain
    kMaxBusDomain = 200;                 ///< the same
/// Whether `network` is a valid value of BusSettings::network.
bool isBusNetwork(const std::string& network);

/// One scene file, resolved.
struct Scene {
  std::string name;                            ///< attribute of the root element
  std::string description;                     ///< one or two sentences; may be empty
  std::string file;                            ///< path as given by the user
  std::string default_rig;                     ///< resolved path, may be empty
  Vec3 gravity{0, 0, -9.81};                   ///< [m/s^2]
  Rates rates;                                 ///< of the groups [Hz]
  HapticSettings haptics;                      ///< rendering of contacts with fingers
  CollisionSettings collision;                 ///< query of the collision thread
  DynamicsSettings dynamics;                   ///< motion of free bodies
  std::vector<Material> materials;             ///< indices: Body::material
  std::vector<Body> bodies;                    ///< indices as in ObjectState::bodies
  std::vector<Joint> joints;                   ///< in document order
  std::vector<DeviceRole> devices;             ///< indices as in DeviceState::fingers
  std::optional<Assembly> assembly;            ///< none: no task
  std::vector<PluginElement> plugin_elements;  ///< in document order
  std::optional<BusSettings> bus;              ///< none: not published, unless rig or options say so
  std::string resolved_xml;                    ///< document after --set and defaults, as stored in recordings

  bool hasForceEffects() const;  ///< some element's plug-in is a force effect
  bool hasTools() const;         ///< some device holds a tool
  bool hasFingertips() const;    ///< some device holds none
  const Material& materialOf(const Body& body) const { return materials[body.material]; }  ///< of this scene's bodies
  /// Whether some touchable material has changed_friction and the renderer supports friction.
  bool surfacesChange() const;
};

inline constexpr const char* kWorldFrame = "world";  ///< Frame::parent: W itself

/// A frame of a rig, such as a desk, a user who walks, or a head.
struct Frame {
  /// A pose of a frame on its way.
  struct Key {
    double time = 0;  ///< [s]
    Pose X_PF;        ///< relative to Frame::X_PF
  };
  /// What a user may do with the frame.
  enum class Moves { kNot, kWalk, kFly };
  /// A button that the user holds; none: only the window's key does it.
  struct Button {
    std::optional<int> number{};  ///< bit of FingerInput::buttons
    SourceLocation where;         ///< in the rig
  };
  /// Scale of a frame, which its user changes with two buttons.
  struct Zoom {
    double min = 1,   ///< metres of the parent for one of the frame
        max = 1;      ///< metres of the parent for one of the frame
    double rate = 2;  ///< factor per second while a button is held
    Button in,        ///< smaller scale: what the hand does becomes finer
        out;          ///< larger scale: what the hand does becomes coarser
  };
  std::string name;                ///< unique among frames and roles of the rig
  std::string parent;              ///< kWorldFrame, a frame, or a role: then the frame moves with that role's tool
  Pose X_PF;                       ///< in the parent
  std::vector<Key> keys;           ///< minimum-jerk from one to the next; empty: fixed
  Moves moves = Moves::kNot;       ///< what its user may do with it: on its level plane and about z, or also along z
  double speed = 1,                ///< of a user who moves it [m/s]
      turn = 1;                    ///< of a user who turns it [rad/s]
  Vec3 drift = Vec3::Zero();       ///< velocity with which it moves by itself, in its own axes [m/s]
  std::optional<Button> clutch{};  ///< while held, the frame slides back under the hand
  std::optional<Zoom> zoom{};      ///< none: the scale is 1
  /// Whether more than time moves it. Such a frame rests while a finger that stands in it feels a force.
  bool driven() const { return moves != Moves::kNot || clutch || zoom || !drift.isZero(); }
};

/// One role bound to a driver, with the driver's own settings.
struct DeviceBinding {
  /// Value of one setting.
  struct Setting {
    std::string value;     ///< as written, or an absolute path
    SourceLocation where;  ///< in the rig
  };
  std::string role;                         ///< DeviceRole::role
  std::string driver;                       ///< folder name under devices/
  std::string frame = kWorldFrame;          ///< in which the driver's samples and forces are, as Frame::parent
  std::map<std::string, Setting> settings;  ///< `<set key= value=/>`; the driver checks keys and values
  /// Limits of this installation, beside those of the scene. Absent values: the driver's rating applies.
  struct Limits {
    std::optional<double> force,    ///< max magnitude [N]
        force_rate,                 ///< max slew [N/s]
        soft_start,                 ///< from zero to the full force [s]
        continuous,                 ///< rating of warm motors [N]
        speed;                      ///< of the fingertip, max [m/s]
    std::optional<double> torque,   ///< max magnitude [N m]
        torque_rate,                ///< max slew [N m/s]
        continuous_torque,          ///< rating of warm motors [N m]
        angular_speed;              ///< of the tool, max [rad/s]
    bool records_overload = false;  ///< exceeding `continuous` is recorded as an event instead of being limited
    bool passivity = false;         ///< passivity control: no net energy to the hand
  };
  Limits limits;         ///< absent in the rig: none of its own
  SourceLocation where;  ///< its element in the rig
};

/// The devices of one laboratory. Scenes are portable; the rig describes one installation.
struct Rig {
  std::string name;                    ///< of the root element
  std::string file;                    ///< path as given by the user
  std::optional<BusSettings> bus;      ///< takes precedence over the scene's
  std::vector<DeviceBinding> devices;  ///< one for each role that it serves
  std::vector<Frame> frames;           ///< in document order
  std::string resolved_xml;            ///< document with defaults, as stored in recordings
};

}  // namespace presa
