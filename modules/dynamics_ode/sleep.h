#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// Puts islands without finger contact to sleep when all their bodies have rested: the mean pose of each moved by less
/// than 10 um between two windows of half a second, and the body stayed within 0.2 mm of its pose at the start of the
/// window. The mean distinguishes the trembling of an iterative solution from slow sliding or rolling (20 um/s keeps a
/// body awake).
///
/// A heap creeps for ever, at about 0.2 mm/s (0.8 at rims), as contacts come and go. In an island of more than 16
/// contacts the limits are therefore 0.4 mm for the mean and 0.8 mm for trembling. Falling, sliding or tipping exceeds
/// them within a window.
///
/// What a joint's motor drives stays awake, however slow it is: an hour hand.
///
/// A sleeping body does not move and collides only with awake bodies. Its whole island wakes in the step in which a
/// finger or an awake body touches one of its bodies.
class Sleep {
 public:
  /// `driven`: bodies whose islands stay awake.
  explicit Sleep(const BodySet& bodies, std::vector<std::size_t> driven = {})
      : stillness_(bodies.size()), may_sleep_(bodies.size()), group_(bodies.size()), driven_(std::move(driven)) {}

  /// Call after each step of `h` [s]: observes awake bodies and puts resting islands to sleep.
  void afterStep(BodySet& bodies, Islands& islands, double h);
  /// The island in which sleeping body `i` fell asleep.
  std::size_t islandOf(std::size_t i) const noexcept { return group_[i]; }
  /// Wakes the whole island of sleeping or paused body `i`.
  void wake(BodySet& bodies, std::size_t i);

  /// Leaves every awake body out of this step whose island of the last step is not `wanted`. Returns their number.
  std::size_t pauseOthers(BodySet& bodies, Islands& islands, const std::vector<char>& wanted);
  /// Wakes all paused bodies.
  void resume(BodySet& bodies);

 private:
  using Displacement = Eigen::Matrix<double, 6, 1>;  // centre of mass, and rotation times extent [m]
  struct Stillness {
    Pose reference;
    Displacement sum = Displacement::Zero(), last_mean = Displacement::Constant(1);
    double farthest = 0;  // maximum distance from the reference in this window [m]
    int samples = 0;      // in this window
    bool still = false;   // rested in the last window
  };
  void watch(const BodySet& bodies, std::size_t i);
  void closeWindow(const BodySet& bodies, std::size_t i, bool in_a_heap);

  std::vector<Stillness> stillness_;
  std::vector<char> may_sleep_;     // by island, while a window closes
  std::vector<std::size_t> group_;  // by sleeping body: the island in which it fell asleep
  std::vector<std::size_t> driven_;
  double window_time_ = 0;
  bool any_paused_ = false;
};

}  // namespace presa::ode
