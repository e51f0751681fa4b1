#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// Compares the impulse that the dynamics gives to the objects with the impulse rendered to the fingers. Both are
/// summed. At the end of every dynamics step the sums over the preceding 0.1 s are compared, for each finger that
/// touched the same free body all that time. The two come from different threads: the haptic side renders k (p_WP -
/// p_WH), the dynamics solves an implicit constraint row. Each force is counted around the instant for which it was
/// computed: a tick's force around its sample, an implicit step's force around the end of the step. (Counted over the
/// interval in which it is held, the sums would differ by half a step and half a tick times the change of the force;
/// that error does not grow with time.)
/// Thread: haptic; nonblocking, all memory is allocated at construction.
class ActionReaction {
 public:
  /// kMinForce: a window with less impulse than this mean force would give is measured against that impulse.
  static constexpr double kWindow = 0.1;     // [s]
  static constexpr double kMinForce = 0.05;  // [N]

  explicit ActionReaction(const Scene& scene);
  void add(const Tick& tick, const ContactExchange& contact, const ObjectState& objects, bool fresh) noexcept;

  struct Result {
    double worst = 0;  ///< maximum of |given + rendered| / |rendered| over all windows [-]
    double time = -1;  ///< end of that window [s]; -1: no window was compared
    std::uint64_t windows = 0;
  };
  const Result& of(std::size_t finger) const noexcept { return results_[finger]; }

 private:
  struct Sums {
    double time = 0;
    std::array<Vec3, kMaxFingers> rendered, given;  // [N s]
    std::array<std::uint64_t, kMaxFingers> grasp;  // counter of contact changes: equal counts mean an unchanged contact
  };
  struct BodyImpulse {
    double time = 0;
    std::array<Vec3, kMaxFingers> impulse;
  };
  void pair(const Tick& tick) noexcept;
  void compare(const Sums& now) noexcept;

  bool moves(std::int32_t body) const noexcept;

  std::vector<char> free_;               // by body
  std::size_t span_;                     // dynamics steps in a window
  std::vector<Sums> ring_;               // at the ends of dynamics steps
  std::uint64_t count_ = 0;              // entries put into ring_ so far
  std::array<BodyImpulse, 64> pending_;  // impulses whose time the haptic side has not reached
  std::size_t pending_count_ = 0;
  Sums sums_;                            // rendered impulse so far
  std::array<Vec3, kMaxFingers> force_;  // force rendered in the last tick [N]
  std::array<std::int32_t, kMaxFingers> body_;
  std::array<Result, kMaxFingers> results_;
  std::int32_t fingers_ = 0;
};

}  // namespace presa
