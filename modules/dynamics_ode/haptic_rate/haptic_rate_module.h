#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/haptics/body_effects.h"
#include "framework/haptics/effect_reactions.h"
#include "framework/haptics/plugin_host.h"
#include "modules/dynamics_ode/haptic_rate/gentle_return.h"
#include "modules/dynamics_ode/haptic_rate/held_bodies.h"
#include "modules/dynamics_ode/ode_world.h"

namespace presa::ode {

/// Moves the bodies that fingers hold, and what stands on them, in the haptic tick (Harwin and Barrow, section 6.2). In:
/// object state, contact exchange of the last tick. Out: held bodies, and the object state as it is shown. A body is
/// taken over from the dynamics, with all that it is in contact with, when a finger touches it, or when it is about to meet
/// such a body. It is given back when no finger holds its group for kLetGo, or when the group grows beyond
/// DynamicsSettings::max_held. Thread: haptic; nonblocking after start().
class HapticRateModule final : public Module, public PluginHost {
 public:
  HapticRateModule(std::shared_ptr<const World> world, std::uint64_t seed);

  void start() override;
  void step(const Tick& tick) noexcept override;
  void stop() override;
  std::vector<std::string> stages() const override;
  std::optional<std::string> brokenPlugin() const override;

 private:
  static constexpr double kLetGo = 0.05;                      // [s]
  static constexpr double kMargin = 0.05;                     // a body that moves at 10 m/s needs 5 ms for it [m]
  static constexpr double kTouches = 1e-5;                    // bodies with a smaller gap are in contact [m]
  static constexpr double kFirstWait = 0.5, kLastWait = 8.0;  // before a group that was too large is tried again [s]

  struct Entry {
    HeldBody held;
    double touched = 0;        // when a finger last held its group [s]
    double leaving_since = 0;  // [s]
    GentleReturn way;          // of a body that was given back
    std::size_t group = 0;     // least index of an entry in contact with it
    bool finger = false;       // a finger touches it
  };
  /// Of a free body of the scene.
  struct Reach {
    double radius = 0;           // of a sphere about its origin that holds its physics geometry [m]
    Vec3 placed = Vec3::Zero();  // origin, where it stands as an obstacle [m]
  };
  struct Wait {
    double until = 0, next = kFirstWait;  // [s]
  };
  struct Velocity {
    Vec3 v_WB = Vec3::Zero(), w_WB = Vec3::Zero();  // [m/s, rad/s]
  };
  /// Of the entries of one group.
  struct Group {
    std::size_t size = 0;
    bool touched = false, grows = true;
  };

  /// What a body joins that is taken over.
  struct Joined {
    std::size_t size = 0;   // bodies of the group so far
    double touched = 0;     // Entry::touched [s]
    std::size_t group = 0;  // Entry::group
  };

  bool isHeld(const Entry& entry) const noexcept { return entry.held.phase == HeldBody::Phase::kHeld; }
  bool moves(const Entry& entry) const noexcept { return entry.held.phase != HeldBody::Phase::kGivenBack; }
  Entry* find(std::size_t body) noexcept;
  void noteVelocities() noexcept;
  BodyMotion inDynamics(std::size_t body) const noexcept;
  BodyMotion shown(std::size_t body) noexcept;
  BodyMotion shownNow(std::size_t body) noexcept;
  bool isNear(std::size_t body, const Vec3& p_W) const noexcept;
  Vec3 velocityAt(std::size_t body, const Vec3& p_W) noexcept;
  bool meet(const BodyContact& contact) noexcept;
  void placeOthers() noexcept;
  void readBack() noexcept;
  void completeReturns() noexcept;
  void markTouched(const ContactExchange& fingers) noexcept;
  void touch(std::int32_t body) noexcept;
  std::size_t takeIsland(std::size_t body, const Joined& to) noexcept;
  void take(std::size_t body, const Joined& to) noexcept;
  static bool unite(Entry& a, Entry& b) noexcept;
  void findGroups() noexcept;
  void takeJoined() noexcept;
  bool takePartner(std::size_t one, std::size_t other) noexcept;
  void growGroups() noexcept;
  void leave(Entry& entry) noexcept;
  void giveBack(std::size_t group) noexcept;
  void wait(std::size_t body) noexcept;
  void endWaits() noexcept;
  void leaveUntouched() noexcept;
  void write() noexcept;
  void show() noexcept;

  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
  In<ContactExchange> fingers_{*this, "contact_exchange", In<ContactExchange>::OfLastTick{}};
  Out<HeldBodies> out_{*this, kHeldBodiesPort};
  Out<ObjectState> shown_objects_{*this, kShownObjectsPort};
  std::optional<In<EffectReactions>> reactions_;  // only if force effects act on free bodies
  std::optional<BodyEffects> body_effects_;       // only if they act on free bodies
  std::shared_ptr<const World> world_;
  const OdeOptions options_;
  std::unique_ptr<OdeWorld> bodies_;  // all that is not held is an obstacle
  std::vector<std::size_t> free_;     // bodies of the scene that are not fixed
  std::vector<char> is_free_;         // by body
  std::vector<Wait> waits_;           // by body
  std::vector<Reach> reaches_;        // by body
  std::vector<Velocity> at_begin_;    // by body: when the newest motion of the dynamics begins
  std::vector<Velocity> at_end_;      // and when it ends
  BoundedList<Entry> entries_;
  std::vector<Group> groups_;  // by least entry
  bool listens_ = false;       // somebody hears hits between bodies
  std::uint64_t noted_ = 0;    // version of the object state that at_end_ is of
  std::uint64_t copied_ = 0;   // version of the object state that shown_objects_ was copied from
  double now_ = 0;             // [s]
};

}  // namespace presa::ode
