#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/haptics/body_effects.h"
#include "framework/haptics/body_hits.h"
#include "framework/haptics/effect_reactions.h"
#include "framework/haptics/plugin_host.h"
#include "framework/session/module_plugin.h"
#include "modules/dynamics_ode/haptic_rate/held_bodies.h"
#include "modules/dynamics_ode/ode_world.h"

namespace presa::ode {

/// Module of the free bodies: contact exchange in, object state out. Thread: dynamics.
class DynamicsModule final : public Module, public PluginHost {
 public:
  /// `seed`: of the order in which ODE's iterative solver visits the constraints.
  DynamicsModule(std::shared_ptr<const World> world, std::uint64_t seed);

  void start() override;
  void step(const Tick& tick) noexcept override;
  void stop() override;
  std::vector<std::string> stages() const override;
  std::vector<std::string> notes() const override;
  std::optional<std::string> brokenPlugin() const override;

  const Faults& faults() const noexcept { return bodies_->faults(); }  ///< valid between start and stop

 private:
  void setSnapConstraints() noexcept;
  void follow(const HeldBodies& held, const Tick& tick) noexcept;
  void leaveFingersTo(const HeldBodies& held) noexcept;
  void writeHits() noexcept;

  In<ContactExchange> fingers_;
  Out<ObjectState> objects_;
  std::optional<In<SnapConstraints>> snap_constraints_;  // only in scenes with an assembly
  std::optional<In<EffectReactions>> reactions_;         // only if force effects act on free bodies
  std::optional<In<HeldBodies>> held_;                   // only if the haptic thread moves what fingers hold
  std::vector<double> released_;                         // by body: HeldBody::since when it was taken back
  BoundedList<std::int32_t> reached_;                    // bodies on which fingers act in this step, with `held_`
  std::optional<BodyEffects> body_effects_;              // only if they act on free bodies
  std::optional<Out<BodyHits>> hits_;                    // only if somebody listens
  std::uint64_t hits_read_ = 0, held_hits_read_ = 0, hits_lost_ = 0;  // of this world, of the bodies that are held
  std::uint64_t snap_constraints_seen_ = 0;
  std::shared_ptr<const World> world_;
  const OdeOptions options_;
  std::unique_ptr<OdeWorld> bodies_;
};

}  // namespace presa::ode
