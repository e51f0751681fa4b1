#include "framework/bus/remote_guide.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/bus/publisher.h"
#include "framework/core/schedule/clock.h"

namespace presa::bus {
namespace {

using Status = GoalState::Status;

// the status of a publication is sent before its heartbeat, over another topic
constexpr std::int64_t kStatusWait = 20'000'000, kStatusLook = 100'000;  // [ns]
constexpr std::uint64_t kFarthestAhead = 1024;  // of a status over the newest heartbeat [publications]
constexpr std::int32_t kMostUndos = 1'000'000;

/// Whether every index names something and every number is one; the rest of a status cannot do harm.
bool isSound(const GuideStatus& status, std::size_t bodies) {
  const auto isIndex = [](std::int32_t i, std::int32_t lowest, std::size_t count) {
    return i >= lowest && i < static_cast<std::int32_t>(count);
  };
  if (!std::isfinite(status.elapsed) || status.elapsed < 0 || status.undone < 0 || status.undone > kMostUndos)
    return false;
  const std::vector<GoalState>& goals = status.assembly.goals;
  return std::ranges::all_of(goals, [&](const GoalState& goal) {
    return isIndex(goal.body, goal.status == Status::kOpen ? kNoBody : 0, bodies) &&
           isIndex(goal.missing, kNoGoal, goals.size());
  });
}

}  // namespace

RemoteGuide::RemoteGuide(std::shared_ptr<const World> world, std::unique_ptr<Reader> reader,
                         std::unique_ptr<OrderSender> sender)
    : world_(std::move(world)),
      reader_(std::move(reader)),
      sender_(std::move(sender)),
      id_(newRunId()),
      picture_(*world_),
      assembly_(*world_->scene.assembly) {
  begin(0);
}

void RemoteGuide::begin(std::uint64_t run) {
  run_ = run;
  decided_ = 0;
  assembly_.elapsed = world_->scene.assembly->elapsed;
  status_.reset();
  choice_.reset();
  guide_.reset();
  order_ = {.run = run, .guide = id_, .number = order_.number};
  undos_done_ = undos_.load(std::memory_order_relaxed);
  undo_asked_ = -1;
}

void RemoteGuide::step(double seconds) {
  reader_->wait(seconds);
  reader_->take(picture_);
  picture_.advance(monotonicNs());
  if (picture_.run() != run_) begin(picture_.run());
  hear();
  const std::uint64_t newest = picture_.sequence();
  const std::int64_t until = monotonicNs() + kStatusWait;
  while (status_ && newest > decided_ && status_->sequence < newest && monotonicNs() < until) {
    sleepUntilNs(monotonicNs() + kStatusLook);
    hear();
  }
  if (!status_ || picture_.wrongScene() || picture_.state() == RemotePicture::State::kEnded) return;
  if (status_->assembly.goals.size() != assembly_.goals.size()) return;  // another scene: the caller was told
  if (status_->lead != 0 && status_->lead != id_) {
    choice_.reset();  // whoever leads later begins with the state as it is then
    return;
  }
  if (!choice_) takeOver();
  const bool fresh = newest > decided_;
  if (fresh) decide();
  if (fresh || monotonicNs() - sent_ns_ > static_cast<std::int64_t>(kRepeat * 1e9)) send();
}

// A status far ahead would make all genuine ones look old. Before the first heartbeat nobody knows: it is judged then.
bool RemoteGuide::isFar(const GuideStatus& status) const noexcept {
  return picture_.sequence() != 0 && status.sequence > picture_.sequence() + kFarthestAhead;
}

void RemoteGuide::hear() {
  if (status_ && isFar(*status_)) {
    status_.reset();
    choice_.reset();
  }
  for (GuideStatus& status : sender_->take())
    if (status.run == run_ && run_ != 0 && (!status_ || status.sequence >= status_->sequence) && !isFar(status) &&
        isSound(status, world_->scene.bodies.size()))
      status_ = std::move(status);
  const std::lock_guard lock(mutex_);
  now_.standing = !status_ || status_->lead == 0 ? Standing::kWaits
                  : status_->lead == id_         ? Standing::kLeads
                                                 : Standing::kOtherLeads;
  if (status_ && status_->refused_guide == id_) now_.refusal = status_->refusal;
}

void RemoteGuide::takeOver() {
  assembly_.elapsed = std::max(assembly_.elapsed, status_->elapsed);
  choice_.emplace(assembly_, world_->scene.bodies.size());
  guide_.emplace(assembly_, world_->scene.bodies.size());
  guide_->resume(status_->assembly);
  order_.on = status_->sequence;
  order_.undone = status_->undone;
  order_.says = guide_->now();
  order_.draws.assign(assembly_.goals.size(), kNoBody);
  for (std::size_t g = 0; g < order_.draws.size(); ++g)
    if (status_->assembly.goals[g].status == Status::kDrawing) order_.draws[g] = status_->assembly.goals[g].body;
}

void RemoteGuide::decide() {
  decided_ = picture_.sequence();
  picture_.showAt(picture_.newest());
  picture_.fill(objects_, device_, contact_, force_);
  AssemblyState& assembly = status_->assembly;
  choice_->step(objects_, assembly.goals);
  for (std::size_t g = 0; g < assembly.goals.size(); ++g) {
    const GoalState& chosen = choice_->goals()[g];
    order_.draws[g] = chosen.status == Status::kDrawing ? chosen.body : kNoBody;
    assembly.goals[g] = chosen;
  }
  guide_->step(picture_.time(), objects_, assembly, contact_);
  order_.on = decided_;
  order_.says = guide_->now();
  order_.told += guide_->events().size();
  order_.events.insert(order_.events.end(), guide_->events().begin(), guide_->events().end());
  if (order_.events.size() > GuideOrder::kMaxEvents)
    order_.events.erase(order_.events.begin(), order_.events.end() - GuideOrder::kMaxEvents);
  const std::lock_guard lock(mutex_);
  now_.guidance = guide_->now();
  if (now_.events.size() > kMaxNews) now_.events.clear();  // nobody asks
  now_.events.insert(now_.events.end(), guide_->events().begin(), guide_->events().end());
}

// One undo after the other: the next one is asked for when the run has done the last.
void RemoteGuide::askForUndo() {
  if (undo_asked_ >= 0 && status_->undone >= undo_asked_) {
    ++undos_done_;
    undo_asked_ = -1;
  }
  if (undos_done_ < undos_.load(std::memory_order_relaxed)) undo_asked_ = status_->undone + 1;
  order_.undone = undo_asked_ >= 0 ? undo_asked_ : status_->undone;
}

void RemoteGuide::send() {
  askForUndo();
  ++order_.number;
  sender_->send(order_);
  sent_ns_ = monotonicNs();
}

RemoteGuide::Now RemoteGuide::now() {
  const std::lock_guard lock(mutex_);
  Now now = now_;
  now_.events.clear();
  return now;
}

}  // namespace presa::bus
