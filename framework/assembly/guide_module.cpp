#include "framework/assembly/guide_module.h"

#include "framework/assembly/standing.h"

namespace presa {

GuideModule::GuideModule(std::shared_ptr<const World> world)
    : Module("assembly_guide", RateGroup::kView),
      world_(std::move(world)),
      guide_(*world_->scene.assembly, world_->scene.bodies.size()) {
  guidance_.value = {guide_.now(), nullptr};
}

void GuideModule::step(const Tick& tick) noexcept {
  guidance_.value.events = nullptr;
  if (!objects_.hasValue() || (assembly_.connected() && !assembly_.hasValue())) return;
  const ObjectState& objects = objects_.value();
  // in every step, drawn or not, because the guide measures hesitation
  guide_.step(tick.time, objects,
              assembly_.connected() ? assembly_.value() : standing(*world_->scene.assembly, objects), contact_.value());
  guidance_.value = {guide_.now(), &guide_.events()};
}

}  // namespace presa
