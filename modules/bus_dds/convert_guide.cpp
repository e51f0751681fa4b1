#include <algorithm>

#include "modules/bus_dds/convert.h"

namespace presa::bus_dds {
namespace {

presa_dds_GuideEvent toTopic(const GuideEvent& event) noexcept {
  return {static_cast<std::int32_t>(event.kind), event.time, event.goal, event.body};
}

GuideEvent fromTopic(const presa_dds_GuideEvent& event) noexcept {
  // the desk ignores an event of no kind that it knows
  const std::int32_t kind = std::clamp(event.kind, 0, static_cast<std::int32_t>(GuideEvent::Kind::kFinished) + 1);
  return {static_cast<GuideEvent::Kind>(kind), event.time, event.goal, event.body};
}

presa_dds_GuideAdvice toTopic(const Guidance& told) noexcept {
  return {told.placed,
          told.body,
          told.held,
          told.goal,
          told.blocked,
          told.missing,
          told.hint_goal,
          told.hint_body,
          told.news.has_value(),
          told.news ? toTopic(*told.news) : presa_dds_GuideEvent{},
          told.finished,
          told.finished_at,
          told.elapsed};
}

Guidance fromTopic(const presa_dds_GuideAdvice& told) noexcept {
  Guidance guidance;
  guidance.placed = told.placed;
  guidance.body = told.body;
  guidance.held = told.held;
  guidance.goal = told.goal;
  guidance.blocked = told.blocked;
  guidance.missing = told.missing;
  guidance.hint_goal = told.hint_goal;
  guidance.hint_body = told.hint_body;
  if (told.has_news) guidance.news = fromTopic(told.news);
  guidance.finished = told.finished;
  guidance.finished_at = told.finished_at;
  guidance.elapsed = told.elapsed;
  return guidance;
}

/// A DDS sequence that lends the elements of a vector, which must outlive it.
template <class Sequence, class Element>
void lend(std::vector<Element>& elements, Sequence& sequence) noexcept {
  sequence._buffer = elements.data();
  sequence._length = sequence._maximum = static_cast<std::uint32_t>(elements.size());
  sequence._release = false;
}

}  // namespace

GuideOrderTopic::GuideOrderTopic(const bus::GuideOrder& order) : draws(order.draws.begin(), order.draws.end()) {
  for (const GuideEvent& event : order.events) events.push_back(toTopic(event));
  topic.run = order.run;
  topic.guide = order.guide;
  topic.number = order.number;
  topic.on = order.on;
  topic.undone = order.undone;
  lend(draws, topic.draws);
  topic.says = toTopic(order.says);
  topic.told = order.told;
  lend(events, topic.events);
}

bus::GuideOrder fromTopic(const presa_dds_GuideOrder& order) {
  bus::GuideOrder out{order.run, order.guide, order.number, order.on, order.undone};
  out.draws.assign(order.draws._buffer, order.draws._buffer + order.draws._length);
  out.says = fromTopic(order.says);
  out.told = order.told;
  const std::uint32_t count = std::min<std::uint32_t>(order.events._length, bus::GuideOrder::kMaxEvents);
  for (std::uint32_t i = order.events._length - count; i < order.events._length; ++i)
    out.events.push_back(fromTopic(order.events._buffer[i]));
  return out;
}

GuideStatusTopic::GuideStatusTopic(const bus::GuideStatus& status) {
  for (const GoalState& goal : status.assembly.goals)
    goals.push_back({static_cast<std::int32_t>(goal.status), goal.body, goal.missing});
  topic.run = status.run;
  topic.sequence_number = status.sequence;
  topic.lead = status.lead;
  topic.number = status.number;
  topic.refusal = static_cast<std::int32_t>(status.refusal);
  topic.refused_guide = status.refused_guide;
  topic.undone = status.undone;
  topic.elapsed = status.elapsed;
  topic.time = status.assembly.time;
  topic.filled = status.assembly.filled;
  topic.last_filled = status.assembly.last_filled;
  topic.brought_back = status.assembly.brought_back;
  lend(goals, topic.goals);
}

bus::GuideStatus fromTopic(const presa_dds_GuideStatus& status) {
  bus::GuideStatus out{status.run, status.sequence_number, status.lead, status.number};
  out.refusal = static_cast<bus::OrderRefusal>(status.refusal);
  out.refused_guide = status.refused_guide;
  out.undone = status.undone;
  out.elapsed = status.elapsed;
  out.assembly.time = status.time;
  out.assembly.filled = status.filled;
  out.assembly.last_filled = status.last_filled;
  out.assembly.brought_back = status.brought_back;
  for (std::uint32_t g = 0; g < status.goals._length; ++g) {
    const presa_dds_GoalStanding& goal = status.goals._buffer[g];
    out.assembly.goals.push_back(
        {static_cast<GoalState::Status>(std::clamp(goal.status, 0, 3)), goal.body, goal.missing});
  }
  return out;
}

}  // namespace presa::bus_dds
