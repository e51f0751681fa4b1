#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "framework/record/monitor/monitor.h"
#include "framework/scene/world.h"

namespace presa {

/// How far a grasp came away from how it began, seen from the frame in which the devices stand (a hand that is carried
/// about stays itself). The line between two fingers stands for the hand; the object turns in the hand about that line.
struct GraspTurn {
  double object = 0;    ///< max turn of the object in the hand [rad]
  double hand = 0;      ///< max angle between the line between the fingers and that line when the grasp began [rad]
  double sideways = 0;  ///< max displacement of either finger from the middle, across the first line [m]

  /// Above it, object or hand is not as it was grasped [rad]. Half as much again as the cube swings when its user walks
  /// and turns (9.6 degrees, config/rigs/walking_pair.xml); other shipped grasps stay below 0.2 degrees. An object that
  /// turns comes to rest at another angle altogether, and a hand that buckles goes on until it folds.
  static constexpr double kMax = 0.262;  // 15 degrees
  bool objectTurned() const noexcept { return object > kMax; }
  bool handBuckled() const noexcept { return hand > kMax; }
};

/// Two fingers and the object that they hold.
struct TracedGrasp {
  std::size_t first = 0, second = 0;  ///< indices into TraceSample::fingers
  std::int32_t body = kNoBody;        ///< index into Scene::bodies
  std::size_t slot = 0;               ///< index into TraceSample::bodies
};

/// From a `trace` that ends with the hold, which begins at `hold_begin` [s]. The grasp begins where both fingers touch
/// and do not let go until the hold. None where the devices stand in two frames, or in one on the tool of a device.
std::optional<GraspTurn> graspTurn(const World& world, std::span<const TraceSample> trace, double hold_begin,
                                   const TracedGrasp& grasp);

}  // namespace presa
