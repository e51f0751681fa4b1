#pragma once
#include <mutex>
#include <vector>

#include "apps/temple/sound/stone_sound.h"
#include "framework/core/graph/port.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"

namespace presa::temple {

/// Hears stones hit each other or the ground: a free body lost speed faster than a hand slows it. Thread: step() runs on
/// the view's thread; take() is for any other.
class HitWatch final : public Module {
 public:
  static constexpr double kLoss = 0.06;   ///< min loss of speed from one state to the next [m/s]
  static constexpr double kPause = 0.12;  ///< min time between two hits of one stone [s]

  /// `density`: of the stones [kg/m³]. `full_size`: size of the building over that of its model.
  HitWatch(std::shared_ptr<const World> world, double density, double full_size);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override { return {"hear stones hit each other"}; }

  /// Hit::length of a free body [m].
  double lengthOf(std::size_t body) const { return stones_[body].length; }
  /// Hits since the last call.
  std::vector<Hit> take();

 private:
  In<ObjectState> objects_{*this, "object_state"};
  struct Stone {
    double length = 0;             // Hit::length [m]; 0: a fixed body
    double speed = 0, heard = -1;  // at the last state [m/s]; last hit [s]
  };
  std::vector<Stone> stones_;  // by body
  double seen_ = -1;           // time of the last state [s]
  std::mutex mutex_;
  std::vector<Hit> hits_;
};

}  // namespace presa::temple
