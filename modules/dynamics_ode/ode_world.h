#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/assembly/snap_constraint.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "framework/haptics/body_effects.h"
#include "framework/haptics/body_hits.h"
#include "framework/haptics/effect_reactions.h"
#include "framework/scene/world.h"
#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// Faults so far. Affected bodies keep their last good pose.
struct Faults {
  enum Bit : std::uint32_t {
    kBodyFrozen = 1,    ///< a state was not finite or not plausible: the body is now a fixed obstacle
    kEngineFailed = 2,  ///< an assertion inside ODE failed: all bodies are frozen
    kBadFinger = 4,     ///< a finger contact named no body or was not finite: ignored
    kBadEffect = 8,     ///< a body effect broke its contract: all of them are off
  };
  std::uint32_t bits = 0;
  std::uint64_t count = 0;
};

/// The rigid bodies of a scene, stepped by ODE. Must be created, stepped and destroyed on one thread.
///
/// Body-body contacts are nearly rigid (ode_options.h); fingers are implicit spring-dampers (finger_constraint.h).
/// Semi-implicit Euler for translation, Runge-Kutta at constant angular momentum for rotation (rotation.h), a solver
/// per island (island_solver.h), Coulomb friction (step_solver.h). Deterministic: the same calls give the same bits.
class OdeWorld {
 public:
  explicit OdeWorld(std::shared_ptr<const World> world, const OdeOptions& options = {});
  ~OdeWorld();

  /// Advances all bodies from `time` to time + period [s]. `fingers` is the last contact exchange with its time; it is
  /// extrapolated to `time` and fades when older than ages::fingers. In a `late` step islands that no finger touches
  /// stand still. Never throws.
  void step(const ContactExchange& fingers, double time, double period, ObjectState& out, bool late = false) noexcept;
  /// The same, written nowhere.
  void step(const ContactExchange& fingers, double time, double period, bool late = false) noexcept;
  /// Makes free body `i` an obstacle at this pose until release(); velocities are only reported.
  void hold(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) noexcept;
  /// Lets body `i` move on from this pose with these velocities.
  void release(std::size_t i, const Pose& X_WB, const Vec3& v_WB, const Vec3& w_WB) noexcept;
  /// Whether fingers act on body `i` from the next step on (default: yes).
  void setReached(std::size_t i, bool reached) noexcept;
  /// Pose and velocities of free body `i`.
  BodyMotion motion(std::size_t i) const noexcept;
  /// Allocates for the fingers and contacts that this exchange has room for. Not called: the first step allocates.
  void makeRoom(const ContactExchange& fingers);
  /// The same for the bodies that force effects act on.
  void makeRoom(const EffectReactions& reactions);
  /// Sets the snap constraints from the next step on. Never called: none.
  void setSnapConstraints(const SnapConstraints& snap_constraints);
  /// Sets the mean forces of force effects in the next step: what was added to their impulses since the last call.
  void addReactions(const EffectReactions& reactions, double period) noexcept;
  /// Applies body effects from the next step on; they must outlive this. Never called: none.
  void use(BodyEffects& effects);
  /// Looks for hits between bodies from the next step on, and keeps the newest `room`. Never called: hits() stays empty.
  void listen(std::size_t room);
  /// Hits between bodies so far.
  const BodyHits& hits() const noexcept;
  /// Writes the current poses as a state valid from `time` on [s].
  void write(double time, ObjectState& out) noexcept;
  /// Writes the islands of the last step to the bodies; the other functions leave them out.
  void writeIslands(ObjectState& out) const noexcept;
  /// Writes everything but bodies and times.
  void writeCounts(ObjectState& out) const noexcept;

  /// Sets the velocity of moving body `i` at its origin and its angular velocity [m/s, rad/s, in W].
  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) noexcept;

  /// Mean force of finger `i` on its bodies over the last step, as given [N]; zero without contact.
  Vec3 fingerForce(std::size_t i) const noexcept;
  /// Contacts between bodies in the last step.
  const std::vector<BodyContact>& contacts() const noexcept;
  const Faults& faults() const noexcept;
  /// Steps in which the direct solver failed on an island and the iterative solver replaced it.
  std::uint64_t fallbackSteps() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace presa::ode
