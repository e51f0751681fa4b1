#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/graph/graph.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/scene/world.h"

// Worlds made in memory, fingers that slide over them, and the two modules that render them, driven by a graph as in a
// run.
namespace presa::bench {

inline constexpr double kSphere = 0.05;  ///< radius of every sphere [m]
inline constexpr double kDepth = 1e-3;   ///< depth of the HIP below the resting position of the fingertip [m]
inline constexpr double kSpeed = 0.1;    ///< speed of the HIP along the surface [m/s]

/// An icosphere of radius kSphere with 20 * 4^k triangles, cached. `bumpy`: with bumps of 0.5 mm.
std::shared_ptr<const TriMesh> sphereMesh(int triangles, bool bumpy = false);

/// A body to be touched: a mesh, or a box.
struct Touched {
  std::shared_ptr<const TriMesh> mesh;  ///< null: the box
  Vec3 box = Vec3::Zero();              ///< full edge lengths [m]
  Vec3 p_WB = Vec3::Zero();
  bool fixed = true;
};
/// A world with these bodies of one material (1 N/mm, friction 0.6/0.4) and `fingers` fingertips of this radius [m].
/// The only place where the benchmarks make a World. `renderer` with friction only if its proxy can be held.
std::shared_ptr<const World> worldOf(const std::vector<Touched>& bodies, double fingertip_radius, int fingers = 1,
                                     const std::string& renderer = "god_object");

/// As worldOf() one finger, but the hand holds a line of 100 mm and this radius, which `renderer` renders.
std::shared_ptr<const World> worldOfLine(const std::vector<Touched>& bodies, double radius,
                                         const std::string& renderer);

/// A smooth closed path around the unit sphere, up and down, that never comes close to itself: one point per haptic
/// tick at constant speed, which is kSpeed on a sphere of this radius [m]. Its length is a whole number of collision
/// periods.
std::vector<Vec3> wayAround(double radius);

/// Periodic motion of fingers and bodies; one period is a lap.
struct Motion {
  std::size_t lap = 0;  ///< length in haptic ticks
  /// Position of a finger's HIP at a tick of the lap, in coordinates of body `carrier`, raised by `height` [m].
  std::function<Vec3(std::size_t finger, std::size_t tick, double height)> p_BH;
  std::size_t carrier = 0;
  std::vector<std::size_t> swinging;  ///< bodies that swing by 5 mm and 0.2 rad, four times a lap
};
/// Motion of fingers around a sphere, the second one half a lap ahead of the first.
Motion aroundSphere(double fingertip_radius);

/// HapticsProxy and CollisionModule in one graph with sources of their inputs, stepped by hand. In a pass the fingers
/// lift off, come down again and slide, then do the timed lap, whose ticks count from 0. All passes are identical; time
/// restarts in each.
class Rig {
 public:
  Rig(std::shared_ptr<const World> world, Motion motion);
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  std::ptrdiff_t lap() const { return static_cast<std::ptrdiff_t>(motion_.lap); }
  /// The part of a pass before the lap.
  void comeDown();
  /// Update the inputs before a tick, not timed: the bodies' part, then the fingers'.
  void moveBodies(std::ptrdiff_t tick) noexcept;
  void moveFingers(std::ptrdiff_t tick) noexcept;
  void collide(std::ptrdiff_t tick) noexcept;  ///< a step of the collision group
  void haptic(std::ptrdiff_t tick) noexcept;   ///< a step of the haptic group
  const ContactExchange& contacts() const;

  static constexpr std::ptrdiff_t kDynamics = 5, kCollision = 10;  ///< haptic ticks per step

 private:
  struct Hands;
  struct Bodies;
  struct Watcher;
  Pose swung(std::size_t body, std::ptrdiff_t tick) const;
  void fillPass();

  std::shared_ptr<const World> world_;
  Motion motion_;
  Graph graph_;
  Hands* hands_ = nullptr;
  Bodies* bodies_ = nullptr;
  Watcher* watcher_ = nullptr;
  struct Held {
    Vec3 p_WH, v_WH;
  };
  std::vector<Quat> turns_;  ///< of lines, as held_; else empty
  std::vector<Held> held_;   ///< every finger's state, tick by tick of a pass
  bool fresh_ = true;
};

}  // namespace presa::bench
