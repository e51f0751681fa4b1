#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "framework/core/schedule/tick.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// Compares the impulse that the dynamics gives to the objects with the impulse rendered to the fingers, body by body.
/// Both are summed. At the end of every dynamics step the sums over the preceding 0.1 s are compared, for each finger
/// and free body that touched all that time. The two come from different threads: the haptic side renders k (p_WP -
/// p_WH), the dynamics solves an implicit constraint row. Each force is counted around the instant for which it was
/// computed: a tick's force around its sample, an implicit step's force around the end of the step. (Counted over the
/// interval in which it is held, the sums would differ by half a step and half a tick times the change of the force;
/// that error does not grow with time.) A body that the haptic thread moves gets each tick's own force in the next step,
/// so its sums are compared at the ends of ticks.
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
  /// Over all bodies that the finger touched.
  const Result& of(std::size_t finger) const noexcept { return results_[finger]; }

 private:
  /// One finger on one body, from the tick in which they met.
  struct Touch {
    std::int32_t finger = 0, body = kNoBody;
    double since = 0, given_since = 0;                   // first tick, first dynamics step [s]
    Vec3 force = Vec3::Zero();                           // rendered in the last tick [N]
    Vec3 rendered = Vec3::Zero(), given = Vec3::Zero();  // [N s]
    bool renewed = false;
  };
  struct Sums {
    double time = 0;
    BoundedList<Touch> touches;
  };
  struct Given {
    double time = 0;
    BoundedList<FingerImpulse> impulses;
  };
  /// What one integrator gave: the dynamics, or the haptic thread.
  struct Giver {
    Giver(std::size_t span, const BoundedList<Touch>& touches);
    std::vector<Sums> ring;         // at the ends of dynamics steps
    std::uint64_t count = 0;        // entries put into the ring so far
    std::array<Given, 64> pending;  // impulses whose time the haptic side has not reached
    std::size_t pending_begin = 0, pending_count = 0;
  };
  // A state that knows of held bodies may come as many ticks after it was made.
  static constexpr std::size_t kTicksKept = 16;
  Given* giveAt(Giver& giver, double time) noexcept;
  const Sums* feltBy(double time) const noexcept;
  void sum(const Tick& tick, const ContactExchange& contact) noexcept;
  void sum(const Tick& tick, std::int32_t finger, const ToolContact& contact) noexcept;
  void pair(const Tick& tick, Giver& giver) noexcept;
  void compare(const Giver& giver, const Sums& now) noexcept;
  bool moves(std::int32_t body) const noexcept;

  std::vector<char> free_;  // by body
  std::size_t span_;        // dynamics steps in a window
  BoundedList<Touch> touches_;
  std::vector<Sums> felt_;       // at the begins of the last ticks, in a ring
  std::size_t newest_ = 0;       // in felt_
  std::vector<Giver> givers_;    // the dynamics, then the haptic thread if it moves what fingers hold
  std::vector<Result> results_;  // by finger
};

}  // namespace presa
