#pragma once
#include <ode/ode.h>

#include <cstdint>
#include <vector>

#include "framework/scene/world.h"
#include "framework/state/object_state.h"
#include "modules/dynamics_ode/finger_row.h"

namespace presa::ode {

/// The bodies of a scene inside one ODE world, in scene order. ODE wants the centre of mass at a body's origin; here and
/// nowhere else poses and velocities are carried between it and the body frame B.
class BodySet {
 public:
  /// Takes bodies and geometries from `world`, which must outlive this.
  BodySet(const World& world, dWorldID ode_world, dSpaceID space);
  ~BodySet();
  BodySet(const BodySet&) = delete;
  BodySet& operator=(const BodySet&) = delete;

  std::size_t size() const noexcept { return bodies_.size(); }
  /// Takes part in the dynamics: neither fixed nor frozen.
  bool moves(std::size_t i) const noexcept { return bodies_[i].body != nullptr && !bodies_[i].frozen; }
  dBodyID body(std::size_t i) const noexcept { return moves(i) ? bodies_[i].body : nullptr; }
  dGeomID geom(std::size_t i) const noexcept { return bodies_[i].geom; }
  static std::size_t indexOf(dGeomID geom) noexcept { return reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)); }
  /// Half the diagonal of the physics geometry's bounds at the start [m].
  double extent(std::size_t i) const noexcept { return bodies_[i].extent; }

  /// State at the start of the step: pose, mass, inverse inertia in W. Only for bodies that move.
  BodyInertiaState inertiaState(std::size_t i) const;
  /// [1/kg]; zero when it does not move
  double inverseMass(std::size_t i) const noexcept { return moves(i) ? 1 / bodies_[i].mass : 0; }
  Vec3 centreVelocity(std::size_t i) const;   ///< of the centre of mass [m/s]; zero when it does not move
  Vec3 angularVelocity(std::size_t i) const;  ///< [rad/s]

  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB);  ///< of B's origin; nothing if it does not move

  /// Remembers every state, so that the step can be undone or a body kept at its last good pose.
  void beginStep();
  /// Puts body `i` back where beginStep found it.
  void restore(std::size_t i);
  /// Replaces ODE's rotation over the step by the exact free one (see rotation.h).
  void driftRotations(double h);
  /// Freezes each body whose state is not finite or beyond reason; returns how many. It stays a fixed obstacle
  /// at its pose of beginStep.
  std::size_t freezeBroken();
  /// Freezes all of them.
  void freezeAll();

  /// All bodies in scene order; each pose starts where the last one written ended.
  void write(ObjectState& out);

 private:
  struct State {
    Vec3 p_WCm = Vec3::Zero(), v_WCm = Vec3::Zero(), w_WB = Vec3::Zero();
    Quat q_WB = Quat::Identity();
  };
  struct Entry {
    dBodyID body = nullptr;  ///< null: fixed from the start
    dGeomID geom = nullptr;  ///< null: nothing collides with it
    dTriMeshDataID mesh_data = nullptr;
    std::vector<double> vertices;  // ODE keeps pointers to these
    std::vector<dTriIndex> indices;
    Vec3 p_BCm = Vec3::Zero();
    Mat3 inertia = Mat3::Zero(), inverse_inertia = Mat3::Zero();
    double mass = 0, extent = 0;
    bool frozen = false;
    State begin;
    Pose X_WB;  ///< as last written
  };
  void createGeom(Entry& entry, const Geometry& geometry, const TriMesh* mesh, dSpaceID space);
  static State read(const Entry& entry);
  static Pose poseOf(const Entry& entry, const State& state);
  static bool sane(const State& state);
  void freeze(Entry& entry);

  std::vector<Entry> bodies_;
};

}  // namespace presa::ode
