#include "apps/temple/visit_observer.h"

#include <utility>

namespace presa::temple {

VisitObserver::VisitObserver(const World& world) : Module("visit", RateGroup::kView) {
  for (const Body& body : world.scene.bodies) snapshot_.X_WB.push_back(body.X_WB);
  snapshot_.now.all = static_cast<std::int32_t>(world.scene.assembly->goals.size());
}

void VisitObserver::step(const Tick& tick) noexcept {
  View* const view = view_.load(std::memory_order_relaxed);
  std::optional<std::string> banner;
  {
    const std::lock_guard lock(mutex_);
    if (view != nullptr && std::exchange(banner_changed_, false)) banner = banner_;
  }
  if (banner) view->setBanner(*banner, false);
  if (!objects_.hasValue() || guidance_->events == nullptr) return;
  const std::lock_guard lock(mutex_);
  snapshot_.time = tick.time;
  snapshot_.now = guidance_->now;
  for (std::int32_t f = 0; f < contact_->count(); ++f) {
    if (contact_->fingers[static_cast<std::size_t>(f)].mode != ContactMode::kNone) snapshot_.touched = tick.time;
  }
  for (std::size_t i = 0; i < snapshot_.X_WB.size(); ++i) snapshot_.X_WB[i] = objects_->bodies[i].X_WB_end;
  events_.insert(events_.end(), guidance_->events->begin(), guidance_->events->end());
}

VisitObserver::Snapshot VisitObserver::snapshot() const {
  const std::lock_guard lock(mutex_);
  return snapshot_;
}

std::vector<GuideEvent> VisitObserver::takeEvents() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

void VisitObserver::setBanner(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (text == banner_) return;
  banner_ = text;
  banner_changed_ = true;
}

}  // namespace presa::temple
