#include "modules/dynamics_ode/dynamics_module.h"

#include "modules/dynamics_ode/finger_row.h"
#include "modules/dynamics_ode/ode_runtime.h"

namespace presa::ode {
namespace {

static_assert(std::uint32_t{Faults::kBodyFrozen} == kFaultBodyFrozen &&
              std::uint32_t{Faults::kEngineFailed} == kFaultEngineFailed &&
              std::uint32_t{Faults::kBadFinger} == kFaultBadFinger);

OdeOptions optionsOf(const World& world) {
  OdeOptions options;
  options.method = world.scene.dynamics;
  options.seed = world.options.seed;
  return options;
}

std::unique_ptr<Module> create(std::shared_ptr<const World> world) {
  return std::make_unique<DynamicsModule>(std::move(world));
}

const ModulePlugin kPlugin{
    kPluginAbi, "dynamics_ode",
    "moves free bodies: gravity, collision, friction and the fingers' grip (Open Dynamics Engine)", create};

}  // namespace

DynamicsModule::DynamicsModule(std::shared_ptr<const World> world)
    : Module("dynamics_ode", RateGroup::kDynamics),
      fingers_(*this, "contact_exchange", In<ContactExchange>::Optional{}, WhenOld::kFadeToZero, kFingerOldAfter),
      objects_(*this, "object_state"),
      world_(std::move(world)),
      options_(optionsOf(*world_)) {}

void DynamicsModule::start() {
  attachThread();
  bodies_ = std::make_unique<OdeWorld>(world_, options_);
  bodies_->write(0, objects_.value);
}

void DynamicsModule::step(const Tick& tick) noexcept {
  bodies_->step(fingers_.value(), tick.time, tick.period, objects_.value);
}

void DynamicsModule::stop() {
  bodies_.reset();
  detachThread();
}

std::vector<std::string> DynamicsModule::stages() const {
  return {
      "extrapolate each finger to the start of the step; a finger not heard of for 20 ms fades",
      "collide the physics geometries (hash space, at most 8 contacts per pair)",
      "solve once without friction between bodies, to point friction along the coming slip",
      "fingers as implicit spring-dampers (soft contact joints) inside their friction cone",
      "solve: islands up to " + std::to_string(options_.direct_limit) + " contacts directly, larger ones with up to " +
          std::to_string(options_.most_iterations) + " iterations",
      "rotate free bodies by one Runge-Kutta step of Euler's equations",
      "freeze a body whose state is not finite; publish poses at both ends of the step",
  };
}

}  // namespace presa::ode

PRESA_MODULE_PLUGIN(presa::ode::kPlugin)
