#include "modules/assembly/assembly_module.h"

#include "modules/assembly/ordered_assembly.h"

namespace presa::assembly {

AssemblyModule::AssemblyModule(std::shared_ptr<const World> world)
    : Module("assembly", RateGroup::kCollision),
      objects_(*this, "object_state"),
      snap_constraints_(*this, "attractions"),
      state_(*this, "assembly_state"),
      world_(std::move(world)),
      regions_(*world_->scene.assembly, world_->scene.bodies.size()) {
  snap_constraints_.value = regions_.snapConstraints();
  state_.value = regions_.state();
}

void AssemblyModule::step(const Tick& tick) noexcept {
  if (!objects_.hasValue()) return;
  for (const std::uint32_t undos = undos_.load(std::memory_order_relaxed); undone_ != undos; ++undone_) regions_.undo();
  regions_.step(objects_.value(), tick.period);
  snap_constraints_.value = regions_.snapConstraints();
  snap_constraints_.value.time = tick.time;
  state_.value = regions_.state();
  state_.value.time = tick.time;
}

std::vector<std::string> AssemblyModule::stages() const {
  std::vector<std::string> all{
      "find the bodies near their goals, the goals that have to wait, and the bodies that have arrived"};
  if (world_->scene.assembly->workspace) all.emplace_back("bring back bodies that have left the workspace");
  return all;
}

namespace {

std::unique_ptr<Module> create(std::shared_ptr<const World> world, const RunOptions& options) {
  if (options.guide == RunOptions::Guide::kViewer) return std::make_unique<OrderedAssembly>(std::move(world));
  return std::make_unique<AssemblyModule>(std::move(world));
}

const ModulePlugin kPlugin{.name = "assembly", .create = create};

}  // namespace
}  // namespace presa::assembly

PRESA_MODULE_PLUGIN(presa::assembly::kPlugin)
