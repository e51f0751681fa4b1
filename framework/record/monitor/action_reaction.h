#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"

namespace presa {

/// How well the impulse given to the objects agrees with the impulse rendered to the fingers. Both are summed; at every end of
/// a dynamics step the two sums are compared over the 0.1 s before, for each finger that touched one and the same free body all
/// that time. They come from different threads: the haptic side renders k (p_WP - p_WH), the dynamics solve an implicit row.
/// Each force is counted around the instant for which it was computed: that of a tick around its sample, that of an implicit
/// step around its end. (Taken as they are held, the sums would differ by half a step and half a tick times the change of
/// the force; that does not grow with time.)
/// Thread: haptic; nonblocking, all memory is taken at construction.
class ActionReaction {
 public:
  /// Windows with less impulse than a mean force of 0.05 N would give are measured against that.
  static constexpr double kWindow = 0.1;       // [s]
  static constexpr double kLeastForce = 0.05;  // [N]

  explicit ActionReaction(const Scene& scene);
  void add(const Tick& tick, const ContactExchange& contact, const ObjectState& objects, bool fresh) noexcept;

  struct Result {
    double worst = 0;  ///< largest |given + rendered| / |rendered| of any window
    double time = -1;  ///< end of that window [s]; -1: there was none
    std::uint64_t windows = 0;
  };
  const Result& of(std::size_t finger) const noexcept { return results_[finger]; }

 private:
  struct Sums {
    double time = 0;
    std::array<Vec3, kMaxFingers> rendered, given;  // [N s]
    std::array<std::uint64_t, kMaxFingers> grasp;   // counts changes of body: equal means the same touch
  };
  struct Given {
    double time = 0;
    std::array<Vec3, kMaxFingers> impulse;
  };
  void pair(const Tick& tick) noexcept;
  void compare(const Sums& now) noexcept;

  bool moves(std::int32_t body) const noexcept;

  std::vector<char> free_;         // by body
  std::size_t span_;               // dynamics steps in a window
  std::vector<Sums> ring_;         // at the ends of dynamics steps
  std::uint64_t count_ = 0;        // put into ring_
  std::array<Given, 64> pending_;  // given, whose end the haptic side has not reached
  std::size_t pending_count_ = 0;
  Sums sums_;                            // rendered so far
  std::array<Vec3, kMaxFingers> force_;  // rendered in the last tick
  std::array<std::int32_t, kMaxFingers> body_;
  std::array<Result, kMaxFingers> results_;
  std::int32_t fingers_ = 0;
};

}  // namespace presa
