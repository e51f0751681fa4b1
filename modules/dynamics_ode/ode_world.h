#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "framework/core/graph/stage_watch.h"
#include "framework/scene/world.h"
#include "framework/assembly/attraction.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/object_state.h"
#include "modules/dynamics_ode/body_contact.h"
#include "modules/dynamics_ode/ode_options.h"

namespace presa::ode {

/// What went wrong so far, and what was done about it. Bodies keep their last good pose.
struct Faults {
  enum Bit : std::uint32_t {
    kBodyFrozen = 1,    ///< a state was not finite or beyond reason: that body is a fixed obstacle now
    kEngineFailed = 2,  ///< an assertion inside ODE failed: all bodies are frozen
    kBadFinger = 4,     ///< a finger contact named no body or was not finite: ignored
  };
  std::uint32_t bits = 0;
  std::uint64_t count = 0;
};

/// The rigid bodies of a scene, stepped by ODE. One thread creates, steps and destroys it.
///
/// Body-body contacts are all but rigid (ode_options.h); fingers are implicit spring-dampers (finger_row.h). Semi-implicit
/// Euler for translation, kick-drift for rotation (rotation.h), each island with the solver that suits it
/// (island_solver.h), friction as Coulomb's (step_solver.h). The same calls give the same bits.
class OdeWorld {
 public:
  explicit OdeWorld(std::shared_ptr<const World> world, const OdeOptions& options = {});
  ~OdeWorld();

  /// Advances all bodies from `time` to time + period. `fingers` is what the haptic thread found last, with its time;
  /// it is extrapolated to `time`, and fades when it is older than ages::fingers says. Never throws.
  void step(const ContactExchange& fingers, double time, double period, ObjectState& out) noexcept;
  /// The same, telling `watch` after each part of it, by its number in Stage.
  void step(const ContactExchange& fingers, double time, double period, ObjectState& out, StageWatch& watch) noexcept;
  /// What is drawn and fixed from the next step on. A world to which this is never said has none of it.
  void attract(const Attractions& attractions);
  /// The poses now, as a state valid from `time` on.
  void write(double time, ObjectState& out) noexcept;

  /// Gives moving body `i` the velocity of its origin and its angular velocity [m/s, rad/s, in W].
  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) noexcept;

  /// Mean force of finger `i` on its body over the last step, as the solver found it [N]; zero without contact.
  Vec3 fingerForce(std::size_t i) const noexcept;
  /// Contacts between bodies found in the last step.
  const std::vector<BodyContact>& contacts() const noexcept;
  const Faults& faults() const noexcept;
  /// Steps in which the direct solver reported trouble in an island and the iterative one took it over.
  std::uint64_t fallbackSteps() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace presa::ode
