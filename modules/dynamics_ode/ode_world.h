#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/scene/world.h"
#include "framework/state/contact_exchange.h"
#include "framework/state/object_state.h"
#include "modules/dynamics_ode/body_contact.h"

namespace presa::ode {

struct OdeOptions {
  /// How a finger's force reaches a body. kExplicitForce adds the rendered penalty force for one step: the
  /// baseline, unstable below about h^2 K / 2 per axis; never the default.
  enum class Coupling { kSoftContact, kExplicitForce };
  Coupling coupling = Coupling::kSoftContact;
  /// Contacts of an island up to which it is solved directly. Cubic: 80 contacts take 2 to 3 ms, 150 take 20.
  std::uint32_t direct_limit = 80;
  /// Iterations for larger islands: `quick_iterations`, fewer when contacts * iterations would exceed the budget
  /// (2 ms), never below `min_quick_iterations`.
  int quick_iterations = 200;
  int quick_budget = 40000;
  int min_quick_iterations = 50;
  /// Contact between bodies: part of the penetration removed per step, and compliance cfm = h * softness / reduced
  /// mass, at most max_contact_cfm [m/(N s)]. A body on a table sinks g h^2 softness / (contacts * erp), below 1 um,
  /// whatever its mass; less softness and the iterative solver does not come to rest.
  double contact_erp = 0.2;
  double contact_softness = 2e-3;
  double max_contact_cfm = 1e-4;
  std::uint64_t seed = 1;  ///< order in which the iterative solver visits its rows
};

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
/// Body-body contacts are all but rigid (erp, softness above); fingers are implicit spring-dampers (finger_row.h). Semi-implicit
/// Euler for translation, kick-drift for rotation (rotation.h). Islands of bodies up to `direct_limit` contacts are
/// solved by ODE's direct solver, larger ones iteratively. When the direct solver reports trouble the step of its
/// islands is undone and repeated iteratively. The same calls give the same bits.
class OdeWorld {
 public:
  explicit OdeWorld(std::shared_ptr<const World> world, const OdeOptions& options = {});
  ~OdeWorld();

  /// Advances all bodies from `time` to time + period. `fingers` is what the haptic thread found last, with its time;
  /// it is extrapolated to `time`, and fades when it is older than kFingerOldAfter. Never throws.
  void step(const ContactExchange& fingers, double time, double period, ObjectState& out) noexcept;
  /// The poses now, as a state valid from `time` on.
  void write(double time, ObjectState& out) noexcept;

  /// Gives moving body `i` the velocity of its origin and its angular velocity [m/s, rad/s, in W].
  void setVelocity(std::size_t i, const Vec3& v_WB, const Vec3& w_WB) noexcept;

  /// Mean force of finger `i` on its body over the last step, as the solver found it [N]; zero without contact.
  Vec3 fingerForce(std::size_t i) const noexcept;
  /// Contacts between bodies found in the last step.
  const std::vector<BodyContact>& contacts() const noexcept;
  const Faults& faults() const noexcept;
  /// Steps in which the direct solver reported trouble and the iterative one took over.
  std::uint64_t fallbackSteps() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace presa::ode
