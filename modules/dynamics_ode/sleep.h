#pragma once
#include <cstdint>
#include <vector>

#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/islands.h"

namespace presa::ode {

/// Puts islands to sleep that no finger touches and in which every body has stayed where it was: over two windows of half a
/// second the mean of its pose moved by less than 10 um, and it never left 0.2 mm around it. The mean tells the trembling of an
/// iterative solution from a body that slides or rolls slowly (20 um/s keep it awake).
///
/// A heap creeps for ever, at some 0.2 mm/s (0.8 at rims), as contacts come and go: in an island of more than 16 contacts the
/// mean may move by 0.4 mm and a body tremble by 0.8. What begins to fall, slide or tip is faster than that within a window.
///
/// A sleeping body does not move, collides only with those awake, and its whole island wakes in the step in which a finger or a body
/// that is awake touches one of it.
class Sleep {
 public:
  explicit Sleep(const BodySet& bodies) : stillness_(bodies.size()), may_sleep_(bodies.size()), group_(bodies.size()) {}

  /// After a step of `h`: watches all that is awake, and lets sleep what may.
  void afterStep(BodySet& bodies, Islands& islands, double h);
  /// Wakes the island of sleeping body `i`.
  void wake(BodySet& bodies, std::size_t i);

 private:
  using Displacement = Eigen::Matrix<double, 6, 1>;  // of the centre of mass, and turn times extent [m]
  struct Stillness {
    Pose reference;
    Displacement sum = Displacement::Zero(), last_mean = Displacement::Constant(1);
    double farthest = 0;  // from the reference, in this window [m]
    bool still = false;   // in the last window
  };
  void watch(const BodySet& bodies, std::size_t i);
  void closeWindow(const BodySet& bodies, std::size_t i, bool in_a_heap);

  std::vector<Stillness> stillness_;
  std::vector<char> may_sleep_;     // by island, while a window closes
  std::vector<std::size_t> group_;  // of sleeping bodies: the island they fell asleep in
  double window_time_ = 0;
  int window_steps_ = 0;
};

}  // namespace presa::ode
