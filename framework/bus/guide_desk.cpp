#include "framework/bus/guide_desk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "framework/core/schedule/clock.h"

namespace presa::bus {
namespace {

using Status = GoalState::Status;

// pauses between two looks for an order, in lockstep: of a publication, and of a guide [ns]
constexpr std::int64_t kOrderLook = 50'000, kAwaitLook = 2'000'000;

bool isBelow(std::int32_t i, std::size_t count) { return i >= 0 && static_cast<std::size_t>(i) < count; }

bool isPlausible(const GuideEvent& event, std::size_t bodies, std::size_t goals) {
  using Kind = GuideEvent::Kind;
  const bool of_goal = event.kind == Kind::kPlaced || event.kind == Kind::kUndone || event.kind == Kind::kBlocked ||
                       event.kind == Kind::kHint;
  const bool of_body = event.kind != Kind::kFinished && event.kind != Kind::kHint;
  return event.kind <= Kind::kFinished && std::isfinite(event.time) && event.goal < static_cast<std::int32_t>(goals) &&
         event.body < static_cast<std::int32_t>(bodies) && event.goal >= (of_goal ? 0 : kNoGoal) &&
         event.body >= (of_body ? 0 : kNoBody);
}

/// Whether the event may be Guidance::news: all of these name a body, of which captions tell.
bool isShown(const GuideEvent& event, std::size_t bodies, std::size_t goals) {
  using Kind = GuideEvent::Kind;
  const bool kind = event.kind == Kind::kPlaced || event.kind == Kind::kUndone || event.kind == Kind::kDropped;
  return kind && isPlausible(event, bodies, goals);
}

/// Replaces indices that name nothing, and numbers that are none.
Guidance plausible(Guidance told, std::size_t bodies, std::size_t goals) {
  for (std::int32_t* body : {&told.body, &told.hint_body})
    if (!isBelow(*body, bodies)) *body = kNoBody;
  for (std::int32_t* goal : {&told.goal, &told.blocked, &told.missing, &told.hint_goal})
    if (!isBelow(*goal, goals)) *goal = kNoGoal;
  if (told.blocked == kNoGoal || told.missing == kNoGoal) told.blocked = told.missing = kNoGoal;
  if (told.hint_goal == kNoGoal || told.hint_body == kNoBody) told.hint_goal = kNoGoal, told.hint_body = kNoBody;
  told.all = static_cast<std::int32_t>(goals);
  told.placed = std::clamp(told.placed, 0, told.all);
  for (double* time : {&told.elapsed, &told.finished_at})
    if (!std::isfinite(*time) || *time < 0) *time = 0;
  if (told.news && !isShown(*told.news, bodies, goals)) told.news.reset();
  return told;
}

}  // namespace

const char* toString(OrderRefusal refusal) noexcept {
  switch (refusal) {
    case OrderRefusal::kOtherGuide:
      return "another guide leads the run";
    case OrderRefusal::kLate:
      return "it decides on states that are too old";
    case OrderRefusal::kOutOfOrder:
      return "its number is far ahead";
    case OrderRefusal::kWrongGoals:
      return "its scene has another number of goals";
    case OrderRefusal::kWrongBody:
      return "it names a body that does not fit the goal";
    case OrderRefusal::kTooMany:
      return "orders come too fast";
    case OrderRefusal::kNone:
      break;
  }
  return "nothing";
}

GuideDesk::GuideDesk(const Scene& scene, bool realtime, Open open)
    : scene_(scene), realtime_(realtime), open_(std::move(open)), begun_(scene.assembly->goals.size()) {
  orders_.draws.resize(scene.assembly->goals.size());
  report_.now.all = static_cast<std::int32_t>(scene.assembly->goals.size());
  report_.now.elapsed = scene.assembly->elapsed;
}

void GuideDesk::start(std::uint64_t run) {
  run_ = run;
  post_ = open_();
}

void GuideDesk::show(const Stamp& stamp, const AssemblyState& assembly) noexcept {
  if (!post_) return;
  sent_ns_[stamp.sequence % sent_ns_.size()] = monotonicNs();
  GuideStatus status{run_, stamp.sequence, lead_, number_, refusal_, refused_guide_, orders_.undone};
  status.elapsed = report_.now.elapsed;
  status.assembly = assembly;
  status.assembly.goals.resize(orders_.draws.size());  // before the assembly module's first step
  post_->show(status);
}

void GuideDesk::serve(const Stamp& stamp, const AssemblyState& assembly) noexcept {
  if (!post_) return;
  changes_ = 0;
  read(stamp, assembly);
  constexpr auto kSilenceNs = static_cast<std::int64_t>(kSilence * 1e9);
  bool behind = false;
  if (!realtime_) {
    if (const auto go_on = std::exchange(await_, {}))
      while (lead_ == 0 && go_on()) {
        sleepUntilNs(monotonicNs() + kAwaitLook);
        show(stamp, assembly);
        read(stamp, assembly);
      }
    // a guide that missed the publication repeats its last order and would hold the run for ever
    const std::int64_t until = monotonicNs() + kSilenceNs;
    while (lead_ != 0 && on_ < stamp.sequence && monotonicNs() - heard_ns_ < kSilenceNs && !behind) {
      sleepUntilNs(monotonicNs() + kOrderLook);
      read(stamp, assembly);
      behind = on_ < stamp.sequence && monotonicNs() >= until;
    }
  }
  noteSilence(stamp.time, behind);
}

void GuideDesk::read(const Stamp& stamp, const AssemblyState& assembly) {
  std::size_t read = 0;
  for (const GuideOrder& order : post_->take()) {
    if (order.run != run_ || order.guide == 0) continue;
    if (order.guide == led_ && order.number <= number_) continue;  // a repetition, or one that came late
    // a flood of others does not use up what the guide may send
    const bool other = lead_ != 0 && order.guide != lead_;
    const OrderRefusal refusal = other                  ? OrderRefusal::kOtherGuide
                                 : ++read > kMostAtOnce ? OrderRefusal::kTooMany
                                                        : judge(order, stamp);
    if (refusal == OrderRefusal::kNone)
      obey(order, stamp, assembly);
    else
      refuse(order, refusal, stamp.time);
  }
}

OrderRefusal GuideDesk::judge(const GuideOrder& order, const Stamp& stamp) const {
  const auto& goals = scene_.assembly->goals;
  // one that led before may have gone on counting, unheard
  if (order.guide == lead_ && order.number > number_ && order.number - number_ > kFarthest)
    return OrderRefusal::kOutOfOrder;
  if (order.on > stamp.sequence || order.undone > orders_.undone + 1) return OrderRefusal::kOutOfOrder;
  if (stamp.sequence - order.on > kOldest) return OrderRefusal::kLate;
  if (order.draws.size() != goals.size()) return OrderRefusal::kWrongGoals;
  for (std::size_t g = 0; g < goals.size(); ++g) {
    if (order.draws[g] == kNoBody) continue;
    if (!isBelow(order.draws[g], scene_.bodies.size()) ||
        std::ranges::find(goals[g].bodies, static_cast<std::size_t>(order.draws[g])) == goals[g].bodies.end())
      return OrderRefusal::kWrongBody;
  }
  return OrderRefusal::kNone;
}

void GuideDesk::obey(const GuideOrder& order, const Stamp& stamp, const AssemblyState& assembly) {
  if (lead_ == 0) follow(order, stamp);
  number_ = order.number;
  heard_ns_ = monotonicNs();
  if (order.on > on_) latency_.add(heard_ns_ - sent_ns_[order.on % sent_ns_.size()]);
  on_ = order.on;
  ++taken_;
  if (order.undone > orders_.undone && stamp.time - undone_at_ >= kUndoEvery) {  // else it is asked for again
    orders_.undone = order.undone;
    undone_at_ = stamp.time;
  }
  for (std::size_t g = 0; g < orders_.draws.size(); ++g) {
    GuideOrders::Draw& draw = orders_.draws[g];
    const bool pulls = g < assembly.goals.size() && assembly.goals[g].status != Status::kOpen;
    const bool again = order.draws[g] != kNoBody && !pulls && stamp.sequence - begun_[g] > kAgain;
    if ((order.draws[g] == draw.body && !again) || changes_ == kMostChanges) continue;
    ++changes_;
    draw = {order.draws[g], draw.since + 1};
    begun_[g] = stamp.sequence;
  }
  hear(order, stamp.time);
}

void GuideDesk::follow(const GuideOrder& order, const Stamp& stamp) {
  lead_ = order.guide;
  if (led_ != lead_) {
    told_ = 0;
    led_from_ = told_until_;
  }
  noted_ = {};
  led_ = lead_;
  note(stamp.time, takeovers_++ == 0 ? "a viewer guides the assembly" : "a viewer has taken over the guide");
}

// A guide that leads again after another one sends its last events once more, and one that has taken over may find all
// in place once more.
bool GuideDesk::isNews(const GuideEvent& event) const noexcept {
  return event.time > led_from_ && !(finish_told_ && event.kind == GuideEvent::Kind::kFinished);
}

void GuideDesk::hear(const GuideOrder& order, double time) {
  using Kind = GuideEvent::Kind;
  const std::size_t bodies = scene_.bodies.size(), goals = orders_.draws.size();
  report_.now = plausible(order.says, bodies, goals);
  const std::size_t count = std::min(order.events.size(), GuideOrder::kMaxEvents);
  if (order.told < count) return;
  for (std::size_t i = 0; i < count; ++i) {
    const GuideEvent& event = order.events[order.events.size() - count + i];
    if (order.told - count + i < told_ || !isPlausible(event, bodies, goals) || !isNews(event)) continue;
    report_.tell(event);
    told_until_ = std::max(told_until_, std::min(event.time, time));  // a time to come must not silence a later guide
    if (event.kind == Kind::kPlaced || event.kind == Kind::kUndone) finish_told_ = false;
    if (event.kind == Kind::kFinished) finish_told_ = true;
  }
  told_ = std::max(told_, order.told);
}

void GuideDesk::refuse(const GuideOrder& order, OrderRefusal refusal, double time) {
  ++refused_;
  refusal_ = refusal;
  refused_guide_ = order.guide;
  if (std::exchange(noted_[static_cast<std::size_t>(refusal)], true)) return;
  note(time, refusal == OrderRefusal::kOtherGuide
                 ? std::string("a second guide was refused")
                 : std::string("an order of a guide was refused: ") + toString(refusal));
}

void GuideDesk::noteSilence(double time, bool behind) {
  const bool silent = behind || monotonicNs() - heard_ns_ >= static_cast<std::int64_t>(kSilence * 1e9);
  if (lead_ == 0 || !silent) return;
  lead_ = 0;
  ++silences_;
  note(time, "the guide fell silent; the run goes on, no further body is pulled to its goal");
}

void GuideDesk::note(double time, const std::string& what) {
  constexpr std::size_t kMaxNotes = 100;  // nobody reads more, and a flood must not fill the memory
  std::array<char, 32> at{};
  std::snprintf(at.data(), at.size(), "%.3f s: ", time);
  const std::lock_guard lock(mutex_);
  if (notes_.size() < kMaxNotes) notes_.push_back(at.data() + what);
}

std::vector<std::string> GuideDesk::takeNotes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notes_, {});
}

std::string GuideDesk::summary() const {
  if (takeovers_ == 0) return "the guide was to be in a viewer, and none came";
  std::array<char, 80> age{};
  std::snprintf(age.data(), age.size(), ", %.1f ms after their states (99.9 %%: %.1f ms)",
                1e-6 * static_cast<double>(latency_.percentile(0.5)),
                1e-6 * static_cast<double>(latency_.percentile(0.999)));
  std::string text = "the guide was in a viewer: " + std::to_string(taken_) + " orders taken" + age.data();
  if (refused_ > 0) text += ", " + std::to_string(refused_) + " refused";
  if (silences_ > 0) text += ", " + std::to_string(silences_) + " times silent";
  return text;
}

}  // namespace presa::bus
