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

/// What came of an assembly.
struct Rebuilt {
  int pieces = 0, placed = 0;
  double worst_position_error = 0;  ///< of the placed, from where they belong [m]
  double worst_angle_error = 0;     ///< [rad]
  int drops = 0;                    ///< times a lifted piece fell
  double mean_fingertip_depth = 0;  ///< of the fingertips into what they touch, while they do [m]
  /// Of blocks into each other and the ground, over all contact points of the run [m]; NaN: not known.
  double mean_penetration = 0;
  double worst_penetration = 0;  ///< of the deepest point, as a mean over kPenetrationOver [m]; NaN: not known
  int lost = 0;                  ///< blocks not finite, below the ground or outside the field at the end
  double longest_outside = 0;    ///< that one block was it without a break [s]
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint32_t faults = 0;  ///< ObjectFault bits
  bool interrupted = false;
};

/// What blocks of an assembly have been through: how deep they stood in each other, and how long they were where nobody reaches them.
/// Once for each state of the dynamics. Thread: haptic.
class BlockWatch {
 public:
  /// An impact of 5 or 10 ms is deeper than what rests: the worst is that of means over so long.
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
  std::vector<std::size_t> blocks_;  // that some goal is for
  std::vector<double> outside_;      // by block: for so long now [s]
  double longest_outside_ = 0;
  double seen_ = 0;  // up to here [s]
  bool known_ = true;
  double depths_ = 0;  // of all points
  std::uint64_t points_ = 0;
  double window_ = 0, deepest_ = 0, worst_ = 0;  // [s], [m s], [m]
};

/// Sees a run as it goes, tick by tick; read when it is over. Thread: haptic.
class Witness final : public Module {
 public:
  explicit Witness(std::shared_ptr<const World> world);
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
  std::vector<double> taken_;  // by body: height at which a finger first touched it; kNotTaken
  int drops_ = 0;
  double depth_ = 0;
  std::uint64_t touches_ = 0;
};

/// All but the times.
Rebuilt measure(const Assembly& assembly, const Witness& witness);

/// As JSON: size seed pieces placed worst_position_error_m worst_angle_error_deg drops mean_fingertip_depth_m mean_penetration_m
/// worst_penetration_m (null: not known) lost longest_outside_s simulated_s wall_s faults.
std::string summaryText(const Rebuilt& rebuilt, const std::string& size, std::uint64_t seed);

}  // namespace presa::temple
