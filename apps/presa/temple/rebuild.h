#pragma once
#include <string>
#include <vector>

#include "framework/graph/port.h"
#include "framework/scene/scene.h"
#include "framework/state/assembly_state.h"
#include "framework/state/contact_exchange.h"
#include "framework/state/object_state.h"

namespace presa::temple {

/// What came of an assembly.
struct Rebuilt {
  int pieces = 0, placed = 0;
  double worst_position_error = 0;  ///< of the placed, from where they belong [m]
  double worst_angle_error = 0;     ///< [rad]
  int drops = 0;                    ///< times a lifted piece fell
  double mean_fingertip_depth = 0;  ///< of the fingertips into what they touch, while they do [m]
  double simulated_seconds = 0, wall_seconds = 0;
  std::uint32_t faults = 0;  ///< ObjectFault bits
  bool interrupted = false;
};

/// Sees a run as it goes, tick by tick; read when it is over. Thread: haptic.
class Witness final : public Module {
 public:
  explicit Witness(std::size_t bodies);
  void step(const Tick& tick) noexcept override;

  const AssemblyState& assembly() const noexcept { return assembly_.value(); }
  const ObjectState& objects() const noexcept { return objects_.value(); }
  int drops() const noexcept { return drops_; }
  double meanFingertipDepth() const noexcept { return touches_ > 0 ? depth_ / static_cast<double>(touches_) : 0; }

 private:
  static constexpr double kNotTaken = -1e9;
  void noteFall(std::size_t i) noexcept;

  In<ObjectState> objects_{*this, "object_state"};
  In<AssemblyState> assembly_{*this, "assembly_state"};
  In<ContactExchange> contact_{*this, "contact_exchange"};
  std::vector<double> taken_;  // by body: height at which a finger first touched it; kNotTaken
  int drops_ = 0;
  double depth_ = 0;
  std::uint64_t touches_ = 0;
};

/// All but the times.
Rebuilt measure(const Assembly& assembly, const Witness& witness);

/// As JSON: size seed pieces placed worst_position_error_m worst_angle_error_deg drops mean_fingertip_depth_m simulated_s wall_s faults.
std::string summaryText(const Rebuilt& rebuilt, const std::string& size, std::uint64_t seed);

}  // namespace presa::temple
