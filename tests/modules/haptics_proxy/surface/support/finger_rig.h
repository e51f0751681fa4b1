#pragma once
#include <memory>

#include "framework/core/graph/graph_builder.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::test {

/// One body under one finger.
struct Touch {
  double radius = 0.008;      ///< fingertip radius [m]; 0: a point
  double stiffness = 1000;    ///< [N/m]
  double friction = 0;        ///< static coefficient; the dynamic one is 0.8 of it
  double collision_hz = 100;  ///< collision rate; 1000 / collision_hz must be whole
  bool fixed = true;          ///< false: the test moves the body
  bool smooth = false;        ///< force shading
  CollisionSettings collision{};
};

/// Makes the world of these tests: one body with the haptic mesh `mesh`, whose adjacency must be built.
World worldOf(std::shared_ptr<const TriMesh> mesh, const Touch& touch);

/// The haptic renderer and the collision query in a graph, stepped like the lockstep executor, without a device: the
/// test sets the finger's position.
class FingerRig {
 public:
  FingerRig(std::shared_ptr<const TriMesh> mesh, const Touch& touch);
  ~FingerRig();

  /// One tick of 1 ms with the finger at p_WH; its velocity follows from the last tick.
  const FingerContact& tick(const Vec3& p_WH);
  /// Places the finger elsewhere: as tick, with a collision query first.
  const FingerContact& place(const Vec3& p_WH);
  /// Sets the body's motion from now on: poses at start and end of the dynamics step, and velocity.
  void moveBody(const Pose& X_WB_begin, const Pose& X_WB_end, const Vec3& v_WB);

  const Vec3& at() const { return last_; }                 ///< last position of the finger
  double time() const;                                     ///< time of the next tick [s]
  bool atDynamicsStep() const { return index_ % 5 == 0; }  ///< whether the next tick coincides with a 200 Hz step
  const ContactExchange& all() const;
  const Touch& touch() const { return touch_; }

 private:
  template <class T>
  struct Source;
  struct Sink;

  Touch touch_;
  std::shared_ptr<const World> world_;
  Graph graph_;
  Source<DeviceState>* device_ = nullptr;
  Source<ObjectState>* objects_ = nullptr;
  Sink* sink_ = nullptr;
  std::uint64_t index_ = 0;
  Vec3 last_ = Vec3::Zero();
};

}  // namespace presa::test
