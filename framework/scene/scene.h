#pragma once
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "framework/diagnostics/diagnostics.h"
#include "framework/math/spatial.h"

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

/// One geometry of a body (visual, haptic or physics), placed in the body frame B.
struct Geometry {
  Shape shape;
  Pose X_BG;
  SourceLocation where;
};

struct Material {
  std::string name;
  double stiffness = 0;         ///< [N/m], > 0
  double damping = 0;           ///< [N s/m], >= 0
  double friction_static = 0;   ///< [-], >= dynamic
  double friction_dynamic = 0;  ///< [-]
  Vec3 color{0.7, 0.7, 0.7};    ///< linear RGB in [0, 1]
  SourceLocation where;
};

struct Body {
  std::string name;
  bool fixed = false;
  Pose X_WB;                        ///< start pose; B's origin is the centre of mass for primitives
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
  double fingertip_radius = 0.008;  ///< [m], > 0
  DeviceLimits limits;
  SourceLocation where;
};

struct Rates {
  double haptic = 1000;    ///< [Hz]
  double collision = 100;  ///< [Hz], haptic / collision is a whole number
  double dynamics = 200;   ///< [Hz], haptic / dynamics is a whole number
  double view = 60;        ///< [Hz]
};

struct Scene {
  std::string name;
  std::string description;
  std::string file;           ///< as given
  std::string default_rig;    ///< resolved path, may be empty
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  Rates rates;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<DeviceRole> devices;
  std::string resolved_xml;  ///< the document after --set and defaults, as saved with recordings

  const Material& materialOf(const Body& body) const { return materials[body.material]; }
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
  SourceLocation where;
};

/// A lab's devices. The scene stays portable, the rig is this desk.
struct Rig {
  std::string name;
  std::string file;
  std::vector<DeviceBinding> devices;
  std::string resolved_xml;
};

}  // namespace presa
