#include "modules/assembly/ordered_assembly.h"

#include <algorithm>
#include <utility>

#include "framework/assembly/goal_choice.h"

namespace presa::assembly {
namespace {

using Status = GoalState::Status;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

OrderedAssembly::OrderedAssembly(std::shared_ptr<const World> world)
    : Module("assembly", RateGroup::kCollision),
      world_(std::move(world)),
      assembly_(*world_->scene.assembly),
      pulls_(assembly_, world_->scene.bodies.size()),
      draws_(assembly_.goals.size()),
      chosen_(assembly_.goals.size()),
      busy_(world_->scene.bodies.size()) {
  snap_constraints_.value = pulls_.snapConstraints();
  state_.value = pulls_.state();
}

void OrderedAssembly::step(const Tick& tick) noexcept {
  if (!objects_.hasValue()) return;
  if (orders_.hasValue()) takeOrders(tick.index);
  choose(objects_.value());
  pulls_.step(objects_.value(), chosen_, tick.period);
  snap_constraints_.value = pulls_.snapConstraints();
  snap_constraints_.value.time = tick.time;
  state_.value = pulls_.state();
  state_.value.time = tick.time;
}

void OrderedAssembly::takeOrders(std::uint64_t tick) {
  const GuideOrders& orders = orders_.value();
  for (; undone_ < orders.undone; ++undone_) {
    pulls_.undo();  // the order that placed the body is over
    taken_.value.add({tick, TakenOrders::kUndo, kNoBody});
  }
  for (std::size_t g = 0; g < std::min(draws_.size(), orders.draws.size()); ++g) {
    if (draws_[g].ordered == orders.draws[g]) continue;
    // a goal that pulled another body rests for a step, so that the new pull begins at zero
    draws_[g] = {.ordered = orders.draws[g], .pulls = false, .over = false};
    chosen_[g] = {};
    taken_.value.add({tick, static_cast<std::int32_t>(g), orders.draws[g].body});
  }
}

bool OrderedAssembly::mayPull(std::size_t goal, const ObjectState& objects) const {
  const std::int32_t body = draws_[goal].ordered.body;
  const std::vector<std::size_t>& fits = assembly_.goals[goal].bodies;
  if (std::ranges::find(fits, at(body)) == fits.end() || busy_[at(body)] != 0) return false;
  return missingBefore(assembly_, goal, pulls_.state().goals) == kNoGoal &&
         withinReach(assembly_, assembly_.goals[goal], objects.bodies[at(body)].X_WB_end, GoalChoice::kLeave);
}

void OrderedAssembly::choose(const ObjectState& objects) {
  std::ranges::fill(busy_, 0);
  for (const GoalState& goal : pulls_.state().goals)
    if (goal.status == Status::kFilled) busy_[at(goal.body)] = 1;
  for (std::size_t g = 0; g < draws_.size(); ++g) {
    Draw& draw = draws_[g];
    const bool rests = !std::exchange(draw.pulls, true);
    chosen_[g] = {};
    if (draw.ordered.body == kNoBody || draw.over) continue;
    draw.over = pulls_.state().goals[g].status == Status::kFilled || !mayPull(g, objects);
    if (draw.over) continue;
    busy_[at(draw.ordered.body)] = 1;
    if (!rests) chosen_[g] = {Status::kDrawing, draw.ordered.body, kNoGoal};
  }
}

std::vector<std::string> OrderedAssembly::stages() const {
  std::vector<std::string> all{
      "take the orders of the guide in the viewer: bodies to be pulled, an undo",
      "pull those within reach of their goals and in their turn, and find the bodies that have arrived"};
  if (assembly_.workspace) all.emplace_back("bring back bodies that have left the workspace");
  return all;
}

}  // namespace presa::assembly
