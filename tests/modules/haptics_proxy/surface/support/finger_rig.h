#pragma once
#include <memory>

#include "framework/core/graph/graph_builder.h"
#include "framework/scene/world.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/object_state.h"

namespace presa::test {

/// One body under one finger.
struct Touch {
  double radius = 0.008;      ///< of the fingertip [m]; 0: a point
  double stiffness = 1000;    ///< [N/m]
  double friction = 0;        ///< static; dynamic is 0.8 of it
  double collision_hz = 100;  ///< of the collision group; 1000 / it is whole
  bool fixed = true;          ///< else the test moves it
  bool smooth = false;        ///< shading
};

/// The only place in these tests that makes a world: one body, felt as `mesh`, whose adjacency is built.
World worldOf(std::shared_ptr<const TriMesh> mesh, const Touch& touch);

/// The haptic renderer and the collision query in a graph, stepped as the lockstep executor steps them, without a
/// device: the finger is where the test says.
class FingerRig {
 public:
  FingerRig(std::shared_ptr<const TriMesh> mesh, const Touch& touch);
  ~FingerRig();

  /// One tick of 1 ms with the finger at p_WH; its velocity is the way since the last tick.
  const FingerContact& tick(const Vec3& p_WH);
  /// The same, the collision query first whatever its rate: for a finger that is put somewhere else.
  const FingerContact& place(const Vec3& p_WH);
  /// Where the moving body is at a time [s] and how fast; from now on.
  void moveBody(const Pose& X_WB_begin, const Pose& X_WB_end, const Vec3& v_WB);

  const Vec3& at() const { return last_; }                 ///< where the finger was last
  double time() const;                                     ///< of the next tick [s]
  bool atDynamicsStep() const { return index_ % 5 == 0; }  ///< the next tick is one of the 200 Hz
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
