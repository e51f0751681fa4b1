#include "apps/temple/visit_tap.h"

#include <utility>

namespace presa::temple {

VisitTap::VisitTap(std::shared_ptr<const World> world)
    : Module("visit", RateGroup::kView),
      world_(std::move(world)),
      guide_(*world_->scene.assembly, world_->scene.bodies.size()) {
  for (const Body& body : world_->scene.bodies) look_.X_WB.push_back(body.X_WB);
  look_.now = guide_.now();
}

void VisitTap::step(const Tick& tick) noexcept {
  View* const view = view_.load(std::memory_order_relaxed);
  std::optional<std::string> banner;
  {
    const std::lock_guard lock(mutex_);
    if (view != nullptr && std::exchange(banner_changed_, false)) banner = banner_;
  }
  if (banner) view->setBanner(*banner, false);
  if (!objects_.hasValue() || !assembly_.hasValue()) return;
  guide_.step(tick.time, objects_.value(), assembly_.value(), contact_.value());
  const std::lock_guard lock(mutex_);
  look_.time = tick.time;
  look_.now = guide_.now();
  for (std::int32_t f = 0; f < contact_->count; ++f) {
    if (contact_->fingers[static_cast<std::size_t>(f)].mode != ContactMode::kNone) look_.touched = tick.time;
  }
  for (std::size_t i = 0; i < look_.X_WB.size(); ++i) look_.X_WB[i] = objects_->bodies[i].X_WB_end;
  events_.insert(events_.end(), guide_.events().begin(), guide_.events().end());
}

VisitTap::Look VisitTap::look() const {
  const std::lock_guard lock(mutex_);
  return look_;
}

std::vector<GuideEvent> VisitTap::takeEvents() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

void VisitTap::setBanner(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (text == banner_) return;
  banner_ = text;
  banner_changed_ = true;
}

}  // namespace presa::temple
