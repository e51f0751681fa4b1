// Reads URDF and MJCF with MuJoCo: its compiler resolves classes of defaults, frames, inertias and units.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "apps/robot_reader/robot.h"
#include "apps/robot_reader/trial.h"
#include "framework/geometry/srgb.h"

namespace presa::robot {
namespace {

constexpr std::size_t kMaxMessage = 1000;
constexpr double kSame = 1e-6;  // of a mesh's diagonal: vertices nearer than this are one

void throwIt(const char* message) { throw std::runtime_error(message); }
void ignoreIt(const char* /*message*/) {}  // MuJoCo would write a file otherwise

/// MuJoCo's handlers, which are the process's, for the time of one call.
class Handlers {
 public:
  Handlers() : error_(mju_user_error), warning_(mju_user_warning) {
    mju_user_error = throwIt;
    mju_user_warning = ignoreIt;
  }
  ~Handlers() {
    mju_user_error = error_;
    mju_user_warning = warning_;
  }
  Handlers(const Handlers&) = delete;
  Handlers& operator=(const Handlers&) = delete;

 private:
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

template <class Number>
Vec3 vec(const Number* v) {
  return Vec3(v[0], v[1], v[2]);
}
Quat quat(const mjtNum* q) { return Quat(q[0], q[1], q[2], q[3]).normalized(); }
Pose pose(const mjtNum* p, const mjtNum* q) { return {vec(p), quat(q)}; }

/// A model in its start position.
class Reading {
 public:
  Reading(const mjModel& model, mjData& data) : m_(model), d_(data) { mj_kinematics(&m_, &d_); }

  Robot robot() const {
    Robot robot;
    if ((m_.opt.disableflags & mjDSBL_GRAVITY) == 0) robot.gravity = vec(m_.opt.gravity);
    robot.masked = masksSeparate();
    for (int i = 0; i < m_.nmesh; ++i) {
      robot.meshes.push_back(mesh(i));
      robot.names.push_back(nameOf(mjOBJ_MESH, i));
    }
    for (int i = 0; i < m_.nbody; ++i) robot.links.push_back(link(i));
    for (int i = 0; i < m_.njnt; ++i) at(robot, m_.jnt_bodyid[i]).freedoms.push_back(freedom(i));
    for (int i = 0; i < m_.ngeom; ++i) {
      if (m_.geom_type[i] != mjGEOM_HFIELD) at(robot, m_.geom_bodyid[i]).parts.push_back(part(i));
    }
    return robot;
  }

 private:
  static Link& at(Robot& robot, int i) { return robot.links[static_cast<std::size_t>(i)]; }

  std::string nameOf(mjtObj kind, int i) const {
    const char* const name = mj_id2name(&m_, kind, i);
    return name == nullptr ? "" : name;
  }

  Link link(int i) const {
    Link link;
    link.name = nameOf(mjOBJ_BODY, i);
    link.parent = static_cast<std::size_t>(m_.body_parentid[i]);
    link.X_WL = pose(d_.xpos + 3 * i, d_.xquat + 4 * i);
    link.mass = m_.body_mass[i];
    link.com_L = vec(m_.body_ipos + 3 * i);
    const Mat3 R_LI = quat(m_.body_iquat + 4 * i).toRotationMatrix();
    link.inertia_L = R_LI * vec(m_.body_inertia + 3 * i).asDiagonal() * R_LI.transpose();
    return link;
  }

  Freedom freedom(int i) const {
    Freedom f;
    f.name = nameOf(mjOBJ_JOINT, i);
    static constexpr std::array kKinds{Freedom::Kind::kFree, Freedom::Kind::kBall, Freedom::Kind::kSlide,
                                       Freedom::Kind::kHinge};  // as mjtJoint
    f.kind = kKinds.at(static_cast<std::size_t>(m_.jnt_type[i]));
    f.p_L = vec(m_.jnt_pos + 3 * i);
    f.dir_L = vec(m_.jnt_axis + 3 * i);
    const int dof = m_.jnt_dofadr[i];
    f.stiffness = m_.jnt_stiffness[i];
    f.damping = m_.dof_damping[dof];
    f.friction = m_.dof_frictionloss[dof];
    f.armature = m_.dof_armature[dof];
    f.limited = m_.jnt_limited[i] != 0;
    if (f.kind == Freedom::Kind::kHinge || f.kind == Freedom::Kind::kSlide) {
      const double start = m_.qpos0[m_.jnt_qposadr[i]];
      f.lower = m_.jnt_range[2 * i] - start;
      f.upper = m_.jnt_range[2 * i + 1] - start;
      f.rest = m_.qpos_spring[m_.jnt_qposadr[i]] - start;
    }
    return f;
  }

  /// Whether bits keep some solids from meeting others that they would meet in a scene.
  bool masksSeparate() const {
    std::set<std::pair<int, int>> masks;
    for (int i = 0; i < m_.ngeom; ++i) {
      if (m_.geom_contype[i] != 0 || m_.geom_conaffinity[i] != 0)
        masks.insert({m_.geom_contype[i], m_.geom_conaffinity[i]});
    }
    for (const auto& a : masks)
      for (const auto& b : masks)
        if ((a.first & b.second) == 0 && (b.first & a.second) == 0) return true;
    return false;
  }

  Part part(int i) const {
    Part part;
    part.name = nameOf(mjOBJ_GEOM, i);
    part.X_LG = pose(m_.geom_pos + 3 * i, m_.geom_quat + 4 * i);
    part.friction = m_.geom_condim[i] == 1 ? 0 : m_.geom_friction[3 * i];
    part.collides = m_.geom_contype[i] != 0 || m_.geom_conaffinity[i] != 0;
    part.color = vec(colorOf(i)).unaryExpr([](double c) { return srgb::toLinear(std::clamp(c, 0.0, 1.0)); });
    const Vec3 size = vec(m_.geom_size + 3 * i);
    switch (m_.geom_type[i]) {
      case mjGEOM_PLANE:
        part.solid = Solid::kPlane, part.size = 2 * size;
        break;
      case mjGEOM_SPHERE:
        part.solid = Solid::kSphere, part.size = size;
        break;
      case mjGEOM_CAPSULE:
        part.solid = Solid::kCapsule, part.size = Vec3(size.x(), 2 * size.y(), 0);
        break;
      case mjGEOM_CYLINDER:
        part.solid = Solid::kCylinder, part.size = Vec3(size.x(), 2 * size.y(), 0);
        break;
      case mjGEOM_ELLIPSOID:
        part.solid = Solid::kEllipsoid, part.size = size;
        break;
      case mjGEOM_MESH:
        part.solid = Solid::kMesh, part.mesh = static_cast<std::size_t>(m_.geom_dataid[i]);
        break;
      default:
        part.solid = Solid::kBox, part.size = 2 * size;
        break;
    }
    return part;
  }

  /// A geom's own colour, unless it has the default and a material.
  const float* colorOf(int geom) const {
    const float* const own = m_.geom_rgba + 4 * geom;
    const bool is_default = own[0] == 0.5F && own[1] == 0.5F && own[2] == 0.5F && own[3] == 1.0F;
    return is_default && m_.geom_matid[geom] >= 0 ? m_.mat_rgba + 4 * m_.geom_matid[geom] : own;
  }

  TriMesh mesh(int i) const {
    TriMesh mesh;
    const float* const vertices = m_.mesh_vert + 3 * m_.mesh_vertadr[i];
    for (int v = 0; v < m_.mesh_vertnum[i]; ++v) mesh.vertices.push_back(vec(vertices + 3 * v));
    const int* const faces = m_.mesh_face + 3 * m_.mesh_faceadr[i];
    for (int f = 0; f < m_.mesh_facenum[i]; ++f)
      mesh.triangles.push_back({faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]});
    // single precision, and a vertex for each corner
    const AxisBox box = boundsOf(mesh);
    weld(mesh, kSame * (box.high - box.low).norm());
    return mesh;
  }

  const mjModel& m_;
  mjData& d_;
};

std::string readHere(const std::string& file, Robot& robot) {
  const Handlers handlers;
  std::array<char, kMaxMessage> message{};
  try {
    const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
        mj_loadXML(file.c_str(), nullptr, message.data(), kMaxMessage), mj_deleteModel);
    if (model == nullptr) return message[0] == 0 ? "MuJoCo does not say why" : message.data();
    const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), mj_deleteData);
    robot = Reading(*model, *data).robot();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// A child process reads the file first: a file that crashes MuJoCo crashes the child.
std::string read(const std::string& file, Robot& robot) {
  const std::string problem = trial([&] {
    Robot tried;
    return readHere(file, tried);
  });
  return problem.empty() ? readHere(file, robot) : problem;
}

}  // namespace
}  // namespace presa::robot

extern "C" __attribute__((visibility("default"))) const presa::robot::ReaderPlugin* presaRobotReader() {
  static const presa::robot::ReaderPlugin kPlugin{presa::kPluginAbi, presa::robot::read};
  return &kPlugin;
}
