#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <vector>

#include "framework/scene/world.h"
#include "framework/core/state/object_state.h"
#include "modules/dynamics_ode/finger_row.h"

namespace presa::ode {

/// The bodies of a scene inside one ODE world, in scene order. ODE wants the centre of mass at a body's origin; here and
/// nowhere else poses and velocities are carried between it and the body frame B.
class BodySet {
 public:
  /// Takes bodies, their velocities at the start and geometries from `world`.
  BodySet(const World& world, DynamicsSettings::Rotation rotation, dWorldID ode_world);
  ~BodySet();
  BodySet(const BodySet&) = delete;
  BodySet& operator=(const BodySet&) = delete;

  std::size_t size() const noexcept { return bodies_.size(); }
  /// Takes part in the dynamics: neither fixed nor frozen nor put.
  bool moves(std::size_t i) const noexcept { return bodies_[i].body != nullptr && !bodies_[i].still; }
  bool asleep(std::size_t i) const noexcept { return bodies_[i].asleep; }
  /// Moves and does not sleep: takes part in this step.
  bool awake(std::size_t i) const noexcept { return moves(i) && !bodies_[i].asleep; }
  bool anyAwake() const noexcept;
  dBodyID body(std::size_t i) const noexcept { return moves(i) ? bodies_[i].body : nullptr; }
  dGeomID geom(std::size_t i) const noexcept { return bodies_[i].geom; }
  /// Half the diagonal of the physics geometry's bounds at the start [m].
  double extent(std::size_t i) const noexcept { return bodies_[i].extent; }
  /// Whether the bounds of their physics geometries come within `distance` of each other along every axis of W [m].
  bool areNear(std::size_t i, std::size_t j, double distance) const;

  /// State at the start of the step: pose, mass, inverse inertia in W. Only for bodies that move.
  BodyInertiaState inertiaState(std::size_t i) const;
  /// [1/kg]; zero when it does not move
  double inverseMass(std::size_t i) const noexcept { return moves(i) ? 1 / bodies_[i].mass : 0; }
  /// Centre of mass at the last beginStep [m]; W's origin when it does not move.
  Vec3 centreAtBegin(std::size_t i) const { return moves(i) ? bodies_[i].begin.p_WCm : Vec3(Vec3::Zero()); }
  /// Pose of the centre of mass, with the body's axes. Only for bodies that move.
  Pose centrePose(std::size_t i) const;
  /// Velocity now, of the point of body `i` that was at p_W at the last beginStep [m/s]; zero when it does not move.
  Vec3 velocityAt(std::size_t i, const Vec3& p_W) const;

  /// How far a point of body `i` goes in `h` at the speed it has, at most [m]; zero when it does not move.
  double reach(std::size_t i, double h) const;

  struct Motion {
    Vec3 p_WCm = Vec3::Zero(), v_WCm = Vec3::Zero(), w_WB = Vec3::Zero();
    Quat q_WB = Quat::Identity();
  };
  Motion motion(std::size_t i) const { return read(bodies_[i]); }           ///< now; only for bodies that move
  Pose pose(std::size_t i) const { return poseOf(bodies_[i], motion(i)); }  ///< X_WB now; not for fixed bodies
  double mass(std::size_t i) const noexcept { return bodies_[i].mass; }     ///< [kg]
  /// Pose of the centre of mass, with the body's axes, when the body is at X_WB.
  Pose centreOf(std::size_t i, const Pose& X_WB) const { return {X_WB * bodies_[i].p_BCm, X_WB.q}; }

  /// Makes body `i` (it moves) a fixed obstacle where it is, until take() gives it back to the dynamics, at rest.
  void put(std::size_t i);
  void take(std::size_t i);
  bool isPut(std::size_t i) const noexcept { return bodies_[i].still && !bodies_[i].frozen; }
  /// Moves a put body.
  void place(std::size_t i, const Pose& X_WB);

  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB);  ///< of B's origin; nothing if it does not move

  /// Adds `speed` to its velocity, and what that is at its rim to its angular velocity, in a direction along no axis.
  void nudge(std::size_t i, double speed);

  void sleep(std::size_t i);  ///< stops it where it is
  void wake(std::size_t i);

  /// Lets the solvers see body `i` (it is awake) or not: it then keeps its state, and its contacts are left out.
  void enable(std::size_t i, bool on);
  /// Starts the external forces of a step with each body's constant one.
  void resetForces();
  /// Adds to body `i` (it moves) a force f_W [N] at p_WP for this step.
  void addForce(std::size_t i, const Vec3& f_W, const Vec3& p_WP);
  /// Hands the external forces of all enabled bodies to ODE, which forgets them with every solve.
  void applyForces();

  /// Remembers every state, so that the step can be undone or a body kept at its last good pose.
  void beginStep();
  /// Puts body `i` back where beginStep found it.
  void restore(std::size_t i);
  /// Replaces ODE's rotation over the step by the chosen one (see rotation.h).
  void driftRotations(double h);
  /// Freezes each body whose state is not finite or beyond reason; returns how many. It stays a fixed obstacle
  /// at its pose of beginStep.
  std::size_t freezeBroken();
  /// Freezes all of them.
  void freezeAll();

  /// All bodies in scene order; each pose starts where the last one written ended.
  void write(ObjectState& out);

 private:
  using State = Motion;
  struct Entry {
    dBodyID body = nullptr;  ///< null: fixed from the start
    dGeomID geom = nullptr;  ///< null: nothing collides with it
    dTriMeshDataID mesh_data = nullptr;
    std::vector<double> vertices;  // ODE keeps pointers to these
    std::vector<dTriIndex> indices;
    Vec3 p_BCm = Vec3::Zero();
    Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();
    double mass = 0, extent = 0;
    bool still = false;   // an obstacle: frozen or put
    bool frozen = false;  // for good
    bool asleep = false, enabled = true;
    Pose X_CmG;  // of the geometry
    Vec3 constant_force_W = Vec3::Zero();
    Vec3 force_W = Vec3::Zero(), torque_W = Vec3::Zero();  // external, of this step, at the centre of mass
    State begin;
    Pose X_WB;  ///< as last written
  };
  void createGeom(Entry& entry, const Geometry& geometry, const TriMesh* mesh);
  static State read(const Entry& entry);
  static Pose poseOf(const Entry& entry, const State& state);
  static bool sane(const State& state);
  void rotate(const Entry& entry, Quat& q_WB, Vec3& w_WB, double h) const;
  static void detach(Entry& entry);
  static void moveTo(Entry& entry, const Pose& X_WCm);
  void freeze(Entry& entry);

  DynamicsSettings::Rotation rotation_;
  std::vector<Entry> bodies_;
};

}  // namespace presa::ode
