#pragma once
#include <ode/ode.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "framework/core/state/object_state.h"
#include "framework/geometry/convex_contact/hull.h"
#include "framework/scene/physics_shapes.h"
#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/finger_constraint.h"
#include "modules/dynamics_ode/ode_types.h"

namespace presa::ode {

/// The shape as a convex polyhedron; none where it is no such mesh: ODE collides it.
std::optional<Hull> polyhedronOf(const PhysicsShape& shape);

/// The bodies of a scene in one ODE world, in scene order. ODE requires the centre of mass at a body's origin; this
/// class is the only place that converts poses and velocities between the centre of mass and the body frame B.
class BodySet {
 public:
  /// Creates bodies with their geometries and start velocities from `world`.
  BodySet(const World& world, DynamicsSettings::Rotation rotation, dWorldID ode_world);
  ~BodySet();
  BodySet(const BodySet&) = delete;
  BodySet& operator=(const BodySet&) = delete;

  std::size_t size() const noexcept { return bodies_.size(); }
  /// True for a free body in the dynamics: neither fixed nor frozen nor put.
  bool moves(std::size_t i) const noexcept { return bodies_[i].body != nullptr && !bodies_[i].still; }
  /// True for a body that the scene fixes.
  bool isFixed(std::size_t i) const noexcept { return bodies_[i].body == nullptr; }
  bool asleep(std::size_t i) const noexcept { return bodies_[i].asleep; }
  /// True for a body that moves and does not sleep: it takes part in this step.
  bool awake(std::size_t i) const noexcept { return moves(i) && !bodies_[i].asleep; }
  bool anyAwake() const noexcept;
  dBodyID body(std::size_t i) const noexcept { return moves(i) ? bodies_[i].body : nullptr; }

  /// The shapes of body `i`'s physics geometry: `count` indices from `first`, none for a body that others pass through.
  /// Indices of shapes ascend with those of bodies.
  struct Shapes {
    std::size_t first = 0, count = 0;
  };
  Shapes shapes(std::size_t i) const noexcept { return bodies_[i].shapes; }
  std::size_t shapeCount() const noexcept { return shapes_.size(); }
  std::size_t bodyOf(std::size_t shape) const noexcept { return shapes_[shape].body; }
  dGeomID geom(std::size_t shape) const noexcept { return shapes_[shape].geom; }
  /// The shape as a convex polyhedron in the frame of `geom`; null: it is none.
  const Hull* hullOf(std::size_t shape) const noexcept { return shapes_[shape].hull ? &*shapes_[shape].hull : nullptr; }
  Pose poseOf(std::size_t shape) const;
  /// Half the diagonal of the shape's bounds at the start [m].
  double extentOf(std::size_t shape) const noexcept { return shapes_[shape].extent; }
  /// Whether the bounding boxes of two shapes in W come within `distance` of each other [m].
  bool shapesAreNear(std::size_t a, std::size_t b, double distance) const;

  /// Of a body of one shape: that shape as a convex polyhedron, and the pose of its frame. Null: it has several, or
  /// none that is convex.
  const Hull* hull(std::size_t i) const noexcept { return shapes(i).count == 1 ? hullOf(shapes(i).first) : nullptr; }
  Pose geomPose(std::size_t i) const { return poseOf(shapes(i).first); }
  /// Bounding box of the physics geometry in W [m]; only for a body that has one.
  struct Bounds {
    dReal side[6];  ///< low x, high x, low y, …
  };
  Bounds bounds(std::size_t i) const;
  /// Half the diagonal of the physics geometry's bounds at the start [m].
  double extent(std::size_t i) const noexcept { return bodies_[i].extent; }
  /// Whether the bounding boxes of two physics geometries in W come within `distance` of each other [m].
  bool areNear(std::size_t i, std::size_t j, double distance) const;
  /// Whether the two bodies collide with each other: joints may hold them together.
  bool meet(std::size_t i, std::size_t j) const noexcept {
    return joined_.empty() || !std::ranges::binary_search(joined_, std::pair(std::min(i, j), std::max(i, j)));
  }
  /// Contacts for which memory is reserved at the start; more allocate once.
  std::size_t contactRoom() const noexcept { return kContactsPerBody * (bodies_.size() + more_shapes_); }

  /// Inertia and pose at the start of the step, inverse inertia in W. Only for bodies that move.
  BodyInertiaState inertiaState(std::size_t i) const;
  /// [1/kg]; zero for a body that does not move.
  double inverseMass(std::size_t i) const noexcept { return moves(i) ? 1 / bodies_[i].mass : 0; }
  /// Centre of mass at the last beginStep [m]; the origin of W for a body that does not move.
  Vec3 centreAtBegin(std::size_t i) const { return moves(i) ? bodies_[i].begin.p_WCm : Vec3(Vec3::Zero()); }
  /// Pose of the centre of mass, with the body's axes. Only for bodies that move.
  Pose centrePose(std::size_t i) const { return {toVec3(bodies_[i].p_WCm), toQuat(bodies_[i].q_WB)}; }
  /// Current velocity of the point of body `i` that was at p_W at the last beginStep [m/s]; zero if it does not move.
  Vec3 velocityAt(std::size_t i, const Vec3& p_W) const;

  /// The same, and for a held body the velocity with which hold() says that it moves: for what may meet it [m/s].
  Vec3 pathVelocityAt(std::size_t i, const Vec3& p_W) const;

  /// Maximum distance that a point of body `i` travels in `h` at its current velocity, held or not [m]; zero if it is
  /// fixed.
  double reach(std::size_t i, double h) const;

  struct Motion {
    Vec3 p_WCm = Vec3::Zero(), v_WCm = Vec3::Zero(), w_WB = Vec3::Zero();
    Quat q_WB = Quat::Identity();
  };
  Motion motion(std::size_t i) const { return read(bodies_[i]); }                ///< current; only for bodies that move
  const Motion& motionAtBegin(std::size_t i) const { return bodies_[i].begin; }  ///< only for awake bodies
  Pose pose(std::size_t i) const { return poseOf(bodies_[i], motion(i)); }       ///< current X_WB; not for fixed bodies
  double mass(std::size_t i) const noexcept { return bodies_[i].mass; }          ///< [kg]
  /// About the centre of mass, in the axes of B [kg m^2].
  const Mat3& inertia(std::size_t i) const noexcept { return bodies_[i].inertia; }
  /// Pose of the centre of mass, with the body's axes, for a body at X_WB.
  Pose centreOf(std::size_t i, const Pose& X_WB) const { return {X_WB * bodies_[i].p_BCm, X_WB.q}; }

  /// Turns moving body `i` into a fixed obstacle at its pose, until take() returns it to the dynamics, at rest.
  void put(std::size_t i);
  void take(std::size_t i);
  bool isPut(std::size_t i) const noexcept { return bodies_[i].still && !bodies_[i].frozen && !bodies_[i].held; }
  /// Sets the pose of a put body.
  void place(std::size_t i, const Pose& X_WB);
  /// Turns moving body `i` into an obstacle at this pose, until release(); nonblocking, for Presa's own solvers only. Its
  /// velocities are reported, of B's origin [m/s] and angular [rad/s]; what it touches does not feel them.
  void hold(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB);
  /// Lets it move on from this pose with these velocities.
  void release(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB);
  bool isHeld(std::size_t i) const noexcept { return bodies_[i].held; }
  bool anyHeld() const noexcept;
  /// Whether fingers act on body `i` (default: yes).
  void setReached(std::size_t i, bool reached) noexcept { bodies_[i].reached = reached; }
  bool isReached(std::size_t i) const noexcept { return bodies_[i].reached; }

  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB);  ///< of B's origin; only if it moves

  /// Perturbs velocity by `speed` [m/s] and angular velocity correspondingly at the rim, in a direction along no axis.
  void nudge(std::size_t i, double speed);

  void sleep(std::size_t i);  ///< sets the velocity to zero, too
  void wake(std::size_t i);
  /// Leaves awake body `i` out of this step as if it slept, but with its velocity, until wake().
  void pause(std::size_t i);
  bool paused(std::size_t i) const noexcept { return bodies_[i].paused; }

  /// Shows awake body `i` to the solvers or hides it; a hidden body keeps its state, and its contacts are ignored.
  void enable(std::size_t i, bool on);
  /// Resets the external forces of a step to each body's constant force.
  void resetForces();
  /// Sets the state of awake body `i` at the end of the step; driftRotations then leaves it alone.
  void setMotion(std::size_t i, const Motion& motion);
  /// Moves awake body `i` back on its way in this step; its angular velocity keeps its value in the axes of B.
  void stopAt(std::size_t i, const Vec3& p_WCm, const Quat& q_WB);
  /// What the solvers see of moving body `i` in this step: with added inertia, forces at the centre of mass.
  struct Load {
    double mass = 0;
    Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();
    Vec3 force_W = Vec3::Zero(), torque_W = Vec3::Zero();
  };
  Load load(std::size_t i, const Vec3& gravity_W) const;

  /// Since beginStep, of awake body `i`: gain of kinetic energy and of energy in gravity, and work of its external
  /// forces other than gravity [J].
  double energyGain(std::size_t i, const Vec3& gravity_W) const;
  double externalWork(std::size_t i) const;
  /// Since beginStep: displacement of the point of awake body `i` that was at p_WP [m].
  Vec3 movedSinceBegin(std::size_t i, const Vec3& p_WP) const;
  bool hasAddedInertia(std::size_t i) const noexcept {
    return bodies_[i].added_mass > 0 || bodies_[i].added_inertia > 0;
  }

  /// Adds a force f_W [N] at p_WP to moving body `i` for this step.
  void addForce(std::size_t i, const Vec3& f_W, const Vec3& p_WP);
  /// Adds a force f_W [N] at the origin of B and a torque about it [N m] to moving body `i` for this step.
  void addForceAndTorque(std::size_t i, const Vec3& f_W, const Vec3& torque_W);
  /// Adds a force at the centre of mass [N] and a torque about it [N m] to moving body `i` for this step.
  void addAtCentre(std::size_t i, const Vec3& f_W, const Vec3& torque_W);
  /// Lets the solves see moving body `i` with this much more mass [kg] and, about every axis, moment of inertia
  /// [kg m^2], until the next call. ODE leaves out the gravity of a body with added mass.
  void setAddedInertia(std::size_t i, double mass, double inertia);
  /// Passes the external forces of all enabled bodies to ODE, which clears them in every solve.
  void applyForces();

  /// Saves every state, so that a step can be undone or a body kept at its last good pose.
  void beginStep();
  /// Restores body `i` to its state at beginStep.
  void restore(std::size_t i);
  /// Replaces ODE's rotation over the step by the selected integrator (see rotation.h).
  void driftRotations(double h);
  /// Freezes each body whose state is not finite or not plausible, as a fixed obstacle at its pose of beginStep.
  /// Returns the number of bodies frozen.
  std::size_t freezeBroken();
  /// Freezes all moving bodies.
  void freezeAll();

  /// Current pose, at both ends, and velocities of free body `i`.
  BodyMotion now(std::size_t i) const;
  /// Writes all bodies in scene order; each pose interval starts where the last one written ended.
  void write(ObjectState& out);

 private:
  using State = Motion;
  struct Entry {
    dBodyID body = nullptr;  ///< null: a fixed body of the scene
    // its state in ODE, at the same place as long as it lives: read many times in a step
    const dReal *p_WCm = nullptr, *v_WCm = nullptr, *w_WB = nullptr, *q_WB = nullptr;
    Shapes shapes;  ///< none: no collisions
    Vec3 p_BCm = Vec3::Zero();
    Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();
    double mass = 0, extent = 0, rim = 0;      // rim: for reach(), about the centre of mass
    double added_mass = 0, added_inertia = 0;  // in the solves alone
    bool still = false;                        // an obstacle: frozen, put or held
    bool frozen = false;                       // permanently still after a fault
    bool held = false;                         // still, with its geometries attached
    bool reached = true;                       // fingers act on it
    bool asleep = false, enabled = true;
    bool paused = false;   // asleep, but with its velocity
    bool rotated = false;  // by the solver of this step
    Vec3 constant_force_W = Vec3::Zero();
    Vec3 force_W = Vec3::Zero(), torque_W = Vec3::Zero();  // external load of this step, at the centre of mass
    State begin;
    Pose X_WB;  ///< pose last written
  };
  struct ShapeEntry {
    std::size_t body = 0;
    dGeomID geom = nullptr;
    dTriMeshDataID mesh_data = nullptr;
    std::optional<Hull> hull;
    std::vector<double> vertices;  // ODE keeps pointers to these
    std::vector<dTriIndex> indices;
    double extent = 0;
    Pose X_CmG;  // frame of `geom` in the centre-of-mass frame, while it is detached
  };
  void createShapes(std::size_t i, const std::vector<PhysicsShape>& shapes);
  void createGeom(const Entry& entry, const PhysicsShape& shape);
  std::span<ShapeEntry> shapesOf(const Entry& entry) {
    return std::span(shapes_).subspan(entry.shapes.first, entry.shapes.count);
  }
  static State read(const Entry& entry) {
    return {toVec3(entry.p_WCm), toVec3(entry.v_WCm), toVec3(entry.w_WB), toQuat(entry.q_WB)};
  }
  static void setVelocity(const Entry& entry, const Vec3& v_WB, const Vec3& w_WB);
  static void setPose(const Entry& entry, const Pose& X_WCm);
  static Pose poseOf(const Entry& entry, const State& state);
  static bool sane(const Entry& entry);
  void rotate(const Entry& entry, Quat& q_WB, Vec3& w_WB, double h) const;
  static void makeStill(Entry& entry);
  void detach(Entry& entry);
  void moveTo(Entry& entry, const Pose& X_WCm);
  void freeze(Entry& entry);

  DynamicsSettings::Rotation rotation_;
  std::vector<Entry> bodies_;
  std::vector<ShapeEntry> shapes_;
  std::size_t more_shapes_ = 0;                              // beyond one a body
  std::vector<std::pair<std::size_t, std::size_t>> joined_;  // that do not collide, sorted; the lower index first
};

}  // namespace presa::ode
