#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "modules/dynamics_ode/ode_world.h"

/// Worlds built in code and a minimal haptic side, for the tests of the dynamics.
namespace presa::ode {

inline constexpr double kStep = 0.005;  // [s]
inline constexpr double kGravity = 9.81;
inline constexpr double kEdge = 0.05;  // of the usual cube [m]
inline const Vec3 kCube = Vec3::Constant(kEdge);

inline Mat3 boxInertia(double mass, const Vec3& size) {
  const Vec3 s = size.cwiseProduct(size);
  return Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()).asDiagonal().toDenseMatrix() * (mass / 12);
}

/// The usual cube as twelve triangles.
inline TriMesh twelveTriangles() {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(kEdge / 2 * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1));
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

class WorldMaker {
 public:
  WorldMaker() {
    world_.scene.gravity = Vec3(0, 0, -kGravity);
    friction(0.5);
  }
  WorldMaker& gravity(const Vec3& g) {
    world_.scene.gravity = g;
    return *this;
  }
  WorldMaker& rates(double haptic, double dynamics) {
    world_.scene.rates.haptic = haptic;
    world_.scene.rates.dynamics = dynamics;
    return *this;
  }
  /// Friction of all bodies added from now on.
  WorldMaker& friction(double mu_static, double mu_dynamic) {
    Material material;
    material.stiffness = 1000;
    material.damping = 1;
    material.friction_static = mu_static;
    material.friction_dynamic = mu_dynamic;
    world_.scene.materials.push_back(material);
    return *this;
  }
  WorldMaker& friction(double mu) { return friction(mu, mu); }
  /// Of the bodies with the last material: restitution, and rolling resistance [m].
  WorldMaker& bouncing(double restitution) {
    world_.scene.materials.back().restitution = restitution;
    return *this;
  }
  WorldMaker& rolling(double length) {
    world_.scene.materials.back().rolling = length;
    return *this;
  }
  WorldMaker& add(const Shape& shape, const Pose& X_WB, const BodyInertia& inertia, const Pose& X_BG = {},
                  std::shared_ptr<const TriMesh> mesh = nullptr) {
    Body body;
    body.name = "body" + std::to_string(world_.scene.bodies.size());
    body.fixed = inertia.mass == 0;
    body.X_WB = X_WB;
    body.material = world_.scene.materials.size() - 1;
    body.physics = Geometry{shape, X_BG, {}};
    world_.scene.bodies.push_back(body);
    world_.meshes.push_back({mesh, mesh, mesh, nullptr});
    world_.inertias.push_back(inertia);
    return *this;
  }
  WorldMaker& fixedBox(const Vec3& size, const Pose& X_WB) { return add(Box{size}, X_WB, {}); }
  WorldMaker& ball(double radius, double mass, const Vec3& p_WB) {
    return add(Sphere{radius}, {p_WB, Quat::Identity()},
               {mass, Vec3::Zero(), 0.4 * mass * radius * radius * Mat3::Identity()});
  }
  WorldMaker& box(const Vec3& size, double mass, const Pose& X_WB) {
    return add(Box{size}, X_WB, {mass, Vec3::Zero(), boxInertia(mass, size)});
  }
  /// A joint of the body added last: at p_BJ, along or about axes given in its frame, to another body or the world.
  Joint& joint(JointType type, const Vec3& p_BJ, const std::vector<Vec3>& axes, std::size_t to = Joint::kWorld) {
    Joint joint;
    joint.name = "joint" + std::to_string(world_.scene.joints.size());
    joint.type = type;
    joint.body = world_.scene.bodies.size() - 1;
    joint.to = to;
    joint.p_BJ = p_BJ;
    for (const Vec3& axis : axes) {
      const bool slides = type == JointType::kSlider || (type == JointType::kPrismaticRotary && joint.axes.empty());
      joint.axes.emplace_back().dhat_B = axis.normalized();
      joint.axes.back().turns = !slides;
    }
    return world_.scene.joints.emplace_back(joint);
  }
  /// A table of 2 m by 2 m with its surface at z = 0.
  WorldMaker& table() { return fixedBox({2, 2, 0.1}, {{0, 0, -0.05}, Quat::Identity()}); }
  std::shared_ptr<const World> world() const { return std::make_shared<World>(world_); }

 private:
  World world_;
};

/// Presa's methods without sleeping, for observing bodies at rest.
inline OdeOptions awake() {
  OdeOptions options;
  options.method.sleeping = false;
  return options;
}

/// Steps an OdeWorld at kStep and keeps its last state.
class Runner {
 public:
  explicit Runner(std::shared_ptr<const World> world, const OdeOptions& options = {})
      : bodies(std::move(world), options) {
    bodies.write(0, state);
  }
  void step(const ContactExchange& fingers = {}, double h = kStep, bool late = false) {
    bodies.step(fingers, time, h, state, late);
    time = state.time_end;
  }
  void run(double duration) {
    for (const double end = time + duration - kStep / 2; time < end;) step();
  }
  const BodyMotion& operator[](std::size_t i) const { return state.bodies[i]; }

  OdeWorld bodies;
  ObjectState state;
  double time = 0;
};

/// A finger whose proxy holds one point of a body: a sphere of 8 mm resting on the surface point p_BC. With `slides`
/// the proxy slips within the friction cone, as on the haptic side.
struct ReferenceFinger {
  static constexpr double kRadius = 0.008;
  std::int32_t body = 0;
  Vec3 p_BC, nhat_B;
  Vec3 p_BP = p_BC + kRadius * nhat_B;
  Vec3 p_WH = Vec3::Zero(), v_WH = Vec3::Zero();
  double stiffness = 1000, damping = 0, mu_static = 1, mu_dynamic = 1;
  bool slides = false;

  ReferenceFinger(std::int32_t body_, const Vec3& p_BC_, const Vec3& nhat_B_)
      : body(body_), p_BC(p_BC_), nhat_B(nhat_B_) {}

  FingerContact contact(const Pose& X_WB) {
    FingerContact c;
    const Vec3 nhat = X_WB.q * nhat_B;
    Vec3 stretch = X_WB * p_BP - p_WH;
    double depth = stretch.dot(nhat);
    c.mode = ContactMode::kStick;
    const Vec3 tangential = stretch - depth * nhat;
    if (slides && tangential.norm() > mu_static * depth) {
      const double limit = mu_dynamic * std::max(0.0, depth);
      const Vec3 move_W = -(1 - limit / tangential.norm()) * tangential;
      const Vec3 move_B = X_WB.q.conjugate() * move_W;
      p_BP += move_B;
      p_BC += move_B;
      stretch += move_W;
      c.mode = ContactMode::kSlip;
    }
    if (depth <= 0) c.mode = ContactMode::kNone;
    c.body = body;
    c.p_WH = p_WH;
    c.v_WH = v_WH;
    c.p_BP = p_BP;
    c.p_WP = X_WB * p_BP;
    c.p_BC = p_BC;
    c.nhat_B = nhat_B;
    c.nhat_W = nhat;
    c.depth = depth;
    c.stiffness = stiffness;
    c.damping = damping;
    c.friction_static = mu_static;
    c.friction_dynamic = mu_dynamic;
    c.f_H_W = stiffness * (c.p_WP - p_WH);
    return c;
  }
};

/// The contact exchange that the haptic thread would publish at the runner's time.
inline ContactExchange exchangeOf(std::vector<ReferenceFinger>& fingers, const Runner& runner) {
  ContactExchange exchange(fingers.size());
  exchange.time = runner.time;
  for (std::size_t i = 0; i < fingers.size(); ++i) {
    exchange.fingers[i] = fingers[i].contact(runner.state.poseAt(fingers[i].body, runner.time));
  }
  return exchange;
}

/// Two fingers at rest on the +x and -x faces of a cube with edge `edge` (body `body` at the origin), `depth` inside.
inline std::vector<ReferenceFinger> pinch(std::int32_t body, double edge, double depth, double stiffness, double mu) {
  std::vector<ReferenceFinger> fingers{{body, {edge / 2, 0, 0}, {1, 0, 0}}, {body, {-edge / 2, 0, 0}, {-1, 0, 0}}};
  for (ReferenceFinger& finger : fingers) {
    finger.stiffness = stiffness;
    finger.mu_static = finger.mu_dynamic = mu;
    finger.p_WH = finger.p_BP - depth * finger.nhat_B;
  }
  return fingers;
}

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }
inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }
inline Quat turn(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

}  // namespace presa::ode
