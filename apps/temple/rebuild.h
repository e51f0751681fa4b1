#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/assembly_state.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::temple {

/// Result of an assembly run.
struct Rebuilt {
  int pieces = 0, placed = 0;
  double worst_position_error = 0;  ///< max distance of a placed block from its goal [m]
  double worst_angle_error = 0;     ///< max angle of a placed block to its goal [rad]
  int drops = 0;                    ///< number of times that a lifted block fell
  double mean_fingertip_depth = 0;  ///< mean penetration of fingertips in contact [m]
  /// Mean penetration of blocks into each other and the ground, over all contact points of the run [m]; NaN: unknown.
  double mean_penetration = 0;
  double worst_penetration = 0;  ///< max of the deepest point's mean over kPenetrationOver [m]; NaN: unknown
  int lost = 0;                  ///< blocks not finite, below the ground or outside the workspace at the end
  double longest_outside = 0;    ///< longest uninterrupted time that a block was lost [s]
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint32_t faults = 0;  ///< ObjectFault bits
  bool interrupted = false;
};

/// Statistics of an assembly's blocks: penetration, and time spent outside the workspace. Call see() with every state
/// of the dynamics; repeated states are ignored. Thread: haptic.
class BlockWatch {
 public:
  /// Averaging window of the worst penetration: short impacts of 5 or 10 ms are deeper than resting contacts.
  static constexpr double kPenetrationOver = 0.1;  // [s]

  explicit BlockWatch(std::shared_ptr<const World> world);
  void see(const ObjectState& objects) noexcept;

  double meanPenetration() const noexcept;
  double worstPenetration() const noexcept { return known_ ? worst_ : std::numeric_limits<double>::quiet_NaN(); }
  int lost() const noexcept;
  double longestOutside() const noexcept { return longest_outside_; }

 private:
  void notePenetration(const ObjectState& objects, double period) noexcept;
  bool isOutside(const Vec3& p_WB) const noexcept;

  std::shared_ptr<const World> world_;
  std::vector<std::size_t> blocks_;  // bodies that belong to a goal
  std::vector<double> outside_;      // by block: time outside so far [s]
  double longest_outside_ = 0;
  double seen_ = 0;  // time of the last state [s]
  bool known_ = true;
  double depths_ = 0;  // sum over all points [m]
  std::uint64_t points_ = 0;
  double window_ = 0, deepest_ = 0, worst_ = 0;  // [s], [m s], [m]
};

/// Observes a run tick by tick; read the results after the run. Thread: haptic.
class RebuildObserver final : public Module {
 public:
  explicit RebuildObserver(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;

  const AssemblyState& assembly() const noexcept { return assembly_.value(); }
  const ObjectState& objects() const noexcept { return objects_.value(); }
  const BlockWatch& blocks() const noexcept { return blocks_; }
  int drops() const noexcept { return drops_; }
  double meanFingertipDepth() const noexcept { return touches_ > 0 ? depth_ / static_cast<double>(touches_) : 0; }

 private:
  static constexpr double kNotTaken = -1e9;
  void noteFall(std::size_t i) noexcept;

  In<ObjectState> objects_{*this, "object_state"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  BlockWatch blocks_;
  std::vector<double> taken_;  // by body: its height at the first touch [m], or kNotTaken
  int drops_ = 0;
  double depth_ = 0;
  std::uint64_t touches_ = 0;
};

/// The results of a run, except the times.
Rebuilt measure(const Assembly& assembly, const RebuildObserver& rebuild_observer);

/// JSON with the keys size seed pieces placed worst_position_error_m worst_angle_error_deg drops mean_fingertip_depth_m
/// mean_penetration_m worst_penetration_m (null: not known) lost longest_outside_s simulated_s wall_s faults.
std::string summaryText(const Rebuilt& rebuilt, const std::string& size, std::uint64_t seed);

}  // namespace presa::temple
