#include "framework/assembly/assembly_guide.h"

#include <algorithm>

namespace presa {
namespace {

using Kind = GuideEvent::Kind;
using Status = GoalState::Status;

constexpr double kNotTaken = -1e9;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

bool filled(const AssemblyState& assembly, std::size_t goal) { return assembly.goals[goal].status == Status::kFilled; }

}  // namespace

AssemblyGuide::AssemblyGuide(const Assembly& assembly, std::size_t bodies)
    : assembly_(assembly),
      stood_(assembly.goals.size()),
      stands_(assembly.goals.size(), kNoBody),
      touched_(bodies),
      touching_(bodies),
      taken_at_(bodies, kNotTaken) {
  now_.all = static_cast<std::int32_t>(assembly.goals.size());
  now_.elapsed = assembly.elapsed;
}

void AssemblyGuide::resume(const AssemblyState& assembly) {
  for (std::size_t g = 0; g < stood_.size(); ++g) {
    if (!filled(assembly, g)) continue;
    stood_[g] = 1;
    stands_[g] = assembly.goals[g].body;
  }
  now_.placed = static_cast<std::int32_t>(std::ranges::count(stood_, 1));
  progress_at_ = assembly.time;
}

void AssemblyGuide::step(double time, const ObjectState& objects, const AssemblyState& assembly,
                         const ContactExchange& contacts) {
  time_ = time;
  events_.clear();
  noteFingers(objects, contacts);
  noteGoals(assembly);
  choosePlace(objects, assembly);
  chooseHint(objects, assembly);
  if (now_.news && time_ - now_.news->time > kNews) now_.news.reset();
  if (begun_ && !now_.finished) now_.elapsed = assembly_.elapsed + time_ - *begun_;
}

void AssemblyGuide::tell(Kind kind, std::int32_t goal, std::int32_t body) {
  events_.push_back({kind, time_, goal, body});
  if (kind == Kind::kPlaced || kind == Kind::kUndone || kind == Kind::kDropped) now_.news = events_.back();
}

void AssemblyGuide::noteFingers(const ObjectState& objects, const ContactExchange& contacts) {
  std::ranges::fill(touching_, 0);
  std::int32_t grasped = kNoBody;
  for (std::size_t f = 0; f < index(contacts.count()); ++f) {
    const FingerContact& finger = contacts.fingers[f];
    if (finger.mode == ContactMode::kNone || finger.body < 0 || index(finger.body) >= touching_.size()) continue;
    if (finger.normal_force < kTouchForce) continue;
    char& fingers = touching_[index(finger.body)];
    touched_[index(finger.body)] = 1;
    ++fingers;
    if (grasped == kNoBody || fingers > touching_[index(grasped)]) grasped = finger.body;
  }
  if (grasped != kNoBody) {
    if (!begun_) begun_ = time_;
    now_.body = grasped;
    now_.held = touching_[index(grasped)] >= std::min(2, contacts.count());
    let_go_ = time_;
  } else {
    now_.held = false;
    if (time_ - let_go_ > kLinger) now_.body = last_held_ = kNoBody;
  }
  if (now_.held && last_held_ != now_.body) {
    last_held_ = now_.body;
    taken_at_[index(now_.body)] = objects.bodies[index(now_.body)].X_WB_end.p.z();
    if (std::ranges::find(stands_, now_.body) == stands_.end()) tell(Kind::kTaken, kNoGoal, now_.body);
  }
  for (std::size_t body = 0; body < taken_at_.size(); ++body) noteFall(body, objects);
}

// Dropped: a lifted body that no finger touches falls fast.
void AssemblyGuide::noteFall(std::size_t body, const ObjectState& objects) {
  if (taken_at_[body] == kNotTaken || touching_[body] != 0) return;
  const BodyMotion& motion = objects.bodies[body];
  if (motion.v_WB.z() > -kFalls || motion.X_WB_end.p.z() < taken_at_[body] + kLifted) return;
  taken_at_[body] = kNotTaken;
  tell(Kind::kDropped, kNoGoal, static_cast<std::int32_t>(body));
}

// A body that no finger has touched since the start was in place before and does not count as placed.
void AssemblyGuide::noteGoals(const AssemblyState& assembly) {
  for (std::size_t g = 0; g < stood_.size(); ++g) {
    const char stands = filled(assembly, g) ? 1 : 0;
    if (stands == stood_[g]) continue;
    stood_[g] = stands;
    progress_at_ = time_;
    if (stands == 0) {
      tell(Kind::kUndone, static_cast<std::int32_t>(g), stands_[g]);
      stands_[g] = kNoBody;
      continue;
    }
    stands_[g] = assembly.goals[g].body;
    taken_at_[index(stands_[g])] = kNotTaken;
    if (touched_[index(stands_[g])] != 0) tell(Kind::kPlaced, static_cast<std::int32_t>(g), stands_[g]);
  }
  now_.placed = static_cast<std::int32_t>(std::ranges::count(stood_, 1));
  const bool all = now_.placed == now_.all && begun_.has_value();
  if (all && !now_.finished) {
    now_.finished_at = time_;
    now_.elapsed = assembly_.elapsed + time_ - *begun_;
    tell(Kind::kFinished, kNoGoal, kNoBody);
  }
  now_.finished = all;
}

std::int32_t AssemblyGuide::missing(std::size_t goal, const AssemblyState& assembly) const {
  for (const std::size_t before : assembly_.goals[goal].after) {
    if (!filled(assembly, before)) return static_cast<std::int32_t>(before);
  }
  return kNoGoal;
}

/// The nearest unfilled goal for a body; `free`: only goals whose predecessors are filled.
std::int32_t AssemblyGuide::nearestPlace(std::int32_t body, bool free, const ObjectState& objects,
                                         const AssemblyState& assembly) const {
  std::int32_t nearest = kNoGoal;
  double min = 1e300;
  for (std::size_t g = 0; g < assembly_.goals.size(); ++g) {
    const AssemblyGoal& goal = assembly_.goals[g];
    if (filled(assembly, g) || std::ranges::find(goal.bodies, index(body)) == goal.bodies.end()) continue;
    if (free && missing(g, assembly) != kNoGoal) continue;
    const double distance = (goal.X_WB.p - objects.bodies[index(body)].X_WB_end.p).norm();
    if (distance >= min) continue;
    min = distance;
    nearest = static_cast<std::int32_t>(g);
  }
  return nearest;
}

void AssemblyGuide::choosePlace(const ObjectState& objects, const AssemblyState& assembly) {
  now_.goal = now_.blocked = now_.missing = kNoGoal;
  std::int32_t attempt = kNoGoal;
  if (now_.body != kNoBody && std::ranges::find(stands_, now_.body) == stands_.end()) {
    for (std::size_t g = 0; g < stood_.size(); ++g) {
      if (assembly.goals[g].status == Status::kBlocked && assembly.goals[g].body == now_.body)
        attempt = static_cast<std::int32_t>(g);
    }
    now_.goal = nearestPlace(now_.body, true, objects, assembly);
    now_.blocked = attempt;
    if (now_.goal == kNoGoal && attempt == kNoGoal) now_.blocked = nearestPlace(now_.body, false, objects, assembly);
    if (now_.blocked != kNoGoal) now_.missing = missing(index(now_.blocked), assembly);
  }
  if (attempt != kNoGoal && attempt != attempted_) tell(Kind::kBlocked, attempt, now_.body);
  attempted_ = attempt;
}

void AssemblyGuide::chooseHint(const ObjectState& objects, const AssemblyState& assembly) {
  if (time_ - progress_at_ < kHesitation || now_.placed == now_.all) {
    now_.hint_goal = kNoGoal;
    now_.hint_body = kNoBody;
    return;
  }
  const bool first = now_.hint_goal == kNoGoal;
  // prefer the held body if it has a free goal
  if (now_.held && now_.goal != kNoGoal) {
    now_.hint_goal = now_.goal;
    now_.hint_body = now_.body;
  } else if (first) {
    for (std::size_t g = 0; g < stood_.size() && now_.hint_goal == kNoGoal; ++g) {
      if (!filled(assembly, g) && missing(g, assembly) == kNoGoal) now_.hint_goal = static_cast<std::int32_t>(g);
    }
    if (now_.hint_goal == kNoGoal) return;
    const AssemblyGoal& goal = assembly_.goals[index(now_.hint_goal)];
    double min = 1e300;
    for (const std::size_t body : goal.bodies) {
      if (std::ranges::find(stands_, static_cast<std::int32_t>(body)) != stands_.end()) continue;
      const double distance = (goal.X_WB.p - objects.bodies[body].X_WB_end.p).norm();
      if (distance >= min) continue;
      min = distance;
      now_.hint_body = static_cast<std::int32_t>(body);
    }
  }
  if (first && now_.hint_goal != kNoGoal) tell(Kind::kHint, now_.hint_goal, now_.hint_body);
}

}  // namespace presa
