#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/core/state/limits.h"
#include "framework/record/haptic_observer.h"
#include "framework/scene/world.h"

namespace presa::python {

/// One contact of a finger with a body, in the world frame.
struct ContactRow {
  std::int32_t finger, body, mode;  ///< indices into the scene; ContactMode
  double depth;                     ///< [m]
  std::array<double, 3> point, normal,
      force;  ///< where the force acts [m]; from the body into the finger; on the finger [N]
};

/// The states of one tick in arrays that stay where they are, for views without copies. Rows are in the order of the
/// scene, vectors x y z, quaternions w x y z, SI units, world frame. Thread: that of the run.
class Snapshot {
 public:
  /// Bodies at their start poses, fingers at the origin.
  explicit Snapshot(const World& world);
  void take(const HapticSample& sample) noexcept;

  using Rows3 = std::vector<std::array<double, 3>>;
  using Rows4 = std::vector<std::array<double, 4>>;
  struct Bodies {
    Rows3 position;          ///< of the body frame [m]
    Rows4 orientation;       ///< unit quaternions, body to world
    Rows3 velocity;          ///< at the end of the last dynamics step [m/s]
    Rows3 angular_velocity;  ///< [rad/s]
    std::vector<std::uint8_t> asleep;
  };
  struct Fingers {
    Rows3 position, velocity;                 ///< of the device (HIP) [m], [m/s]
    Rows3 proxy;                              ///< held at the surface [m]
    Rows3 force;                              ///< sent to the device, after the output stage [N]
    Rows3 rendered_force;                     ///< before it [N]
    std::vector<double> depth, normal_force;  ///< [m], [N]
    std::vector<std::int32_t> mode, body;     ///< ContactMode; -1: none
  };
  double time = 0;           ///< [s]
  std::uint32_t status = 0;  ///< OutputStatus of all fingers
  Bodies bodies;
  Fingers fingers;
  std::vector<ContactRow> contacts;  ///< as many as there can be
  std::size_t contact_count = 0;     ///< of these in use

 private:
  void add(const ToolContact& part, std::int32_t finger) noexcept;
};

/// Takes the snapshot of the ticks that are wanted.
class SnapshotTap final : public HapticObserver {
 public:
  explicit SnapshotTap(Snapshot& snapshot) : HapticObserver("snapshot"), snapshot_(snapshot) {}
  void want(bool wanted) noexcept { wanted_ = wanted; }
  void observe(const HapticSample& sample) noexcept override {
    if (wanted_) snapshot_.take(sample);
  }

 private:
  Snapshot& snapshot_;
  bool wanted_ = false;
};

}  // namespace presa::python
