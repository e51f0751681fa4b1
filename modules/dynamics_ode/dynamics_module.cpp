#include "modules/dynamics_ode/dynamics_module.h"

#include "framework/scene/ages.h"
#include "modules/dynamics_ode/ode_runtime.h"
#include "modules/dynamics_ode/stages.h"

namespace presa::ode {
namespace {

static_assert(std::uint32_t{Faults::kBodyFrozen} == kFaultBodyFrozen &&
              std::uint32_t{Faults::kEngineFailed} == kFaultEngineFailed &&
              std::uint32_t{Faults::kBadFinger} == kFaultBadFinger);

OdeOptions optionsOf(const World& world, std::uint64_t seed) {
  OdeOptions options;
  options.method = world.scene.dynamics;
  options.seed = seed;
  return options;
}

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  return std::make_unique<DynamicsModule>(std::move(world), options.seed);
}

const ModulePlugin kPlugin{
    kPluginAbi, "dynamics_ode",
    "moves free bodies: gravity, collision, friction and the fingers' grip (Open Dynamics Engine)", create,
    [] { return std::string("ODE " PRESA_ODE_VERSION); }};

}  // namespace

DynamicsModule::DynamicsModule(std::shared_ptr<const World> world, std::uint64_t seed)
    : Module("dynamics_ode", RateGroup::kDynamics),
      fingers_(*this, "contact_exchange", In<ContactExchange>::Optional{}, WhenOld::kFadeToZero,
               ages::fingers(world->scene.rates)),
      objects_(*this, "object_state"),
      world_(std::move(world)),
      options_(optionsOf(*world_, seed)) {
  objects_.value.bodies.resize(world_->scene.bodies.size());
  if (world_->scene.assembly) snap_constraints_.emplace(*this, "attractions", In<SnapConstraints>::Optional{});
}

void DynamicsModule::start() {
  attachThread();
  bodies_ = std::make_unique<OdeWorld>(world_, options_);
  bodies_->write(0, objects_.value);
}

void DynamicsModule::setSnapConstraints() noexcept {
  if (!snap_constraints_ || snap_constraints_->version() == snap_constraints_seen_) return;
  snap_constraints_seen_ = snap_constraints_->version();
  bodies_->setSnapConstraints(snap_constraints_->value());
}

void DynamicsModule::step(const Tick& tick) noexcept {
  setSnapConstraints();
  bodies_->step(fingers_.value(), tick.time, tick.period, objects_.value);
}

void DynamicsModule::stop() {
  bodies_.reset();
  detachThread();
}

std::vector<std::string> DynamicsModule::stages() const { return listStages(options_); }

}  // namespace presa::ode

PRESA_MODULE_PLUGIN(presa::ode::kPlugin)
