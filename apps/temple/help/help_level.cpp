#include "apps/temple/help/help_level.h"

#include <algorithm>
#include <utility>

namespace presa::temple {

HelpLevel::HelpLevel(std::shared_ptr<const World> world, std::shared_ptr<GraspHelp> help)
    : Module("help_level", RateGroup::kView), world_(std::move(world)), help_(std::move(help)) {}

void HelpLevel::step(const Tick&) noexcept {
  for (std::size_t body = 0; body < world_->scene.bodies.size(); ++body)
    help_->setPlaced(body, std::ranges::any_of(assembly_->goals, [&](const GoalState& goal) {
                       return goal.status == GoalState::Status::kFilled && goal.body == static_cast<std::int32_t>(body);
                     }));
  if (!guide_.hasValue() || guide_->events == nullptr) return;
  help_->setGoal(guide_->now.body, guide_->now.goal);
  for (const GuideEvent& event : *guide_->events) {
    if (event.kind == GuideEvent::Kind::kPlaced) note(event.time, true);
    if (event.kind == GuideEvent::Kind::kDropped) note(event.time, false);
  }
}

void HelpLevel::note(double time, bool placed) {
  HelpNote note{time, 0, help_->needed()};
  note.own = placed && std::max(note.need.grasp, note.need.place) < GraspHelp::kOwn;
  strength_ = std::clamp(strength_ - (!placed ? -kEach : note.own ? kOwn : kEach), 0.0, 1.0);
  help_->setStrength(strength_);
  if (!placed) return;
  note.strength = strength_;
  const std::lock_guard lock(mutex_);
  notes_.push_back(note);
}

std::vector<HelpNote> HelpLevel::takeNotes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notes_, {});
}

}  // namespace presa::temple
