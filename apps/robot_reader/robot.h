#pragma once
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/geometry/tri_mesh.h"
#include "framework/plugin/plugin_loader.h"

/// Robots and other articulated models of URDF and MJCF files, as MuJoCo understands them.
namespace presa::robot {

enum class Solid { kPlane, kBox, kSphere, kCapsule, kCylinder, kEllipsoid, kMesh };

/// One solid of a link, in its own frame G.
struct Part {
  std::string name;  ///< may be empty
  Solid solid = Solid::kBox;
  /// Box: edges [m]. Sphere: radius. Capsule, cylinder: radius, length along z, a capsule's without its caps. Ellipsoid:
  /// half axes. Plane: edges along x and y, zero where it has no end; its surface is z = 0.
  Vec3 size = Vec3::Zero();
  Pose X_LG;                  ///< in the link
  std::size_t mesh = 0;       ///< index into Robot::meshes, of a kMesh
  Vec3 color = Vec3::Zero();  ///< linear red, green, blue
  double friction = 0;        ///< Coulomb's coefficient
  bool collides = false;      ///< else it is only drawn
};

/// One degree of freedom of a link against its parent, or three of a ball, or six of a free link.
struct Freedom {
  enum class Kind { kHinge, kSlide, kBall, kFree };
  std::string name;  ///< may be empty
  Kind kind = Kind::kHinge;
  Vec3 p_L = Vec3::Zero(), dir_L = Vec3::UnitZ();  ///< point [m] and direction, in the link
  bool limited = false;
  double lower = 0, upper = 0;       ///< from the start position [m or rad]
  double stiffness = 0, rest = 0;    ///< spring [N/m or N m/rad] and its relaxed position from the start
  double damping = 0, friction = 0;  ///< [N s/m or N m s/rad], [N or N m]
  double armature = 0;               ///< inertia that a gear adds [kg or kg m^2]
};

struct Link {
  std::string name;
  std::size_t parent = 0;         ///< index into Robot::links; 0: the world
  Pose X_WL;                      ///< at the start
  double mass = 0;                ///< [kg]
  Vec3 com_L = Vec3::Zero();      ///< centre of mass [m]
  Mat3 inertia_L = Mat3::Zero();  ///< about it, along the link's axes [kg m^2]
  std::vector<Freedom> freedoms;  ///< in the order from the parent to the link
  std::vector<Part> parts;
};

struct Robot {
  Vec3 gravity = Vec3::Zero();     ///< [m/s^2]
  bool masked = false;             ///< bits keep some solids from meeting others
  std::vector<Link> links;         ///< the first is the world; a parent stands before its children
  std::vector<TriMesh> meshes;     ///< in the frames of their parts
  std::vector<std::string> names;  ///< of the meshes
};

/// What the plug-in presa_robot_reader gives.
struct ReaderPlugin {
  int abi = kPluginAbi;
  /// Reads a URDF or MJCF file; every file that it names is opened, too. Returns why it cannot be read, or nothing.
  /// Thread: main.
  std::string (*read)(const std::string& file, Robot& robot) = nullptr;
};
inline constexpr const char* kReaderSymbol = "presaRobotReader";

}  // namespace presa::robot
