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
  using D = DynamicsSettings;
  const D& method = options_.method;
  std::vector<std::string> all{
      "extrapolate each finger to the start of the step; a finger not heard of for 20 ms fades"};
  if (method.sleeping) all.emplace_back("wake what a finger or a moving body touches; what lies still sleeps");
  all.emplace_back("collide the physics geometries (sort and sweep, at most 8 contacts per pair)");
  all.emplace_back(method.coupling == D::Coupling::kSoft
                       ? "fingers as implicit spring-dampers (soft contact joints) inside their friction cone"
                       : "fingers as forces that act for one step");
  if (method.friction == D::Friction::kIsotropic) {
    all.emplace_back("where something slides, solve once without friction, to point friction along the coming slip");
  }
  const std::string iterations =
      method.iterations > 0 ? std::to_string(method.iterations) : "up to " + std::to_string(options_.most_iterations);
  all.push_back(method.solver == D::Solver::kDirect ? "solve all islands directly"
                : method.solver == D::Solver::kIterative
                    ? "solve all islands with " + iterations + " iterations"
                    : "solve: islands up to " + std::to_string(options_.direct_limit) +
                          " contacts directly, larger ones with " + iterations + " iterations");
  if (method.rotation == D::Rotation::kExact) {
    all.emplace_back("rotate free bodies by one Runge-Kutta step of Euler's equations");
  }
  all.emplace_back("freeze a body whose state is not finite; publish poses at both ends of the step");
  return all;
}

}  // namespace presa::ode

PRESA_MODULE_PLUGIN(presa::ode::kPlugin)
