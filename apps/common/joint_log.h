#pragma once
#include <cstddef>
#include <vector>

#include "framework/record/recording.h"
#include "framework/scene/joints/joint_motion.h"

namespace presa {

/// One position of a joint over a run [m, rad]; 0 in the start pose. Angles go on beyond half a turn.
struct JointTravel {
  double start = 0, min = 0, max = 0, end = 0;
  double at_lower = 0, at_upper = 0;  ///< time within kAtStop of a stop, or beyond it [s]
};
/// A joint stands at a stop within this: below what is seen, above what a solver leaves open.
inline constexpr double kAtStop = 1e-4, kAtStopAngle = 1e-3;  ///< [m], [rad]

/// Positions of all joints of a scene over a run: their ranges, and samples for plots. Memory is allocated by the
/// constructor only.
class JointLog {
 public:
  struct Position {
    std::size_t joint, axis;  ///< index into Scene::joints, position of it
    JointTravel travel;
    std::vector<double> samples;  ///< as times()
  };
  /// Keeps every `stride`-th sample, `capacity` of them at most. `scene` must outlive this.
  JointLog(const Scene& scene, std::size_t capacity, std::size_t stride);

  /// The state at `time`, `span` after the one before [s]; `pose(i)`: X_WB of body i.
  template <class PoseOfBody>
  void add(double time, double span, const PoseOfBody& pose) {
    motion_.follow(pose);
    keep(time, span);
  }
  const Scene& scene() const noexcept { return scene_; }
  const Joint& jointOf(const Position& position) const noexcept { return scene_.joints[position.joint]; }
  /// Joint by joint, in the order of the scene. A fixed joint has none.
  const std::vector<Position>& positions() const noexcept { return positions_; }
  const std::vector<double>& times() const noexcept { return times_; }

 private:
  void keep(double time, double span) noexcept;

  const Scene& scene_;
  JointMotion motion_;
  std::vector<Position> positions_;
  std::vector<double> times_;
  std::size_t capacity_, stride_, count_ = 0;
};

/// The positions at every tick of a recording, whose scene this is. Bodies without a table stand at their start.
JointLog jointLogOf(const RecordedSamples& samples, const Scene& scene);

}  // namespace presa
