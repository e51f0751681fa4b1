#include "tests/apps/temple/visitor/naive_visitor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "framework/scene/goal_pose.h"

namespace presa::temple::test {
namespace {

constexpr double kIgnore = 0.3;  // share of visitors who ignore what they are shown
constexpr double kDepthGuessed = 0.03, kDepthSeen = 0.008, kAcross = 0.002;  // [m]
const double kSeenFrom = std::sin(26 * std::numbers::pi / 180);     // these depths are guessed from 26 degrees above
constexpr double kDepthPractised = 0.003, kTherePractised = 0.007;  // [m]
constexpr double kReaction = 0.5, kLongPause = 0.1;                 // median of a pause [s]; share of long ones
constexpr int kMaxTries = 6;                                        // of one aim, before it starts again

double yawOff(const Pose& X_WB, const AssemblyGoal& goal) {
  return poseDifference(nearestTurn(goal.X_WB, goal.fold, X_WB.q), X_WB).angle;
}

}  // namespace

NaiveVisitor::NaiveVisitor(std::shared_ptr<const World> world, std::uint64_t seed, const Cues& cues, bool practised)
    : Module("naive_visitor", RateGroup::kView),
      world_(std::move(world)),
      random_(seed, "naive visitor"),
      hand_(practised ? HandTraits{.overshoot = 0, .scatter = 0.03, .tremor = 0.0005} : drawHand(random_), random_),
      waits_(world_->scene.bodies.size()) {
  drawKnowledge(cues);
  practised_ = practised;
  if (!practised) return;
  ignores_ = false;
  known_ = {};
  depth_ = kDepthPractised;
  there_ = kTherePractised;
}

// Shown, each is found within seconds of the other. By oneself: everybody drags, many try the wheel, few try Shift.
void NaiveVisitor::drawKnowledge(const Cues& cues) {
  ignores_ = random_.uniform() < kIgnore;
  const auto found = [&](double mean) { return -mean * std::log(1 - random_.uniform()); };
  if (cues.shown_how && !ignores_) {
    known_.drag = random_.uniform(2, 8);
    known_.pinch = known_.drag + random_.uniform(2, 10);
    known_.lift = known_.pinch + random_.uniform(2, 10);
    known_.turn = known_.lift + random_.uniform(4, 15);
  } else {
    known_ = {.drag = 2 + found(4), .pinch = 3 + found(25), .lift = 5 + found(120), .turn = 5 + found(120)};
  }
  depth_ = cues.drop_lines ? kDepthSeen : kDepthGuessed;
  until_ = random_.uniform(1, 4);
}

void NaiveVisitor::write(const std::string& what) {
  std::array<char, 160> line;
  std::snprintf(line.data(), line.size(), "%6.1f s: %s\n", now_, what.c_str());
  diary_ += line.data();
}

void NaiveVisitor::step(const Tick& tick) noexcept {
  const double dt = tick.time - now_;
  now_ = tick.time;
  if (!objects_.hasValue()) return;
  look();
  pointer_.begin(device_.value());
  pointer_.heed(device_.value());
  placed_ = guide_->now.placed;
  if (!finished_at_ && placed_ == guide_->now.all) finished_at_ = now_;
  hand_.step(dt, pointer_, camera_);
  if (!hand_.busy() && now_ >= until_) {
    decide();
    const bool rests = random_.uniform() < kLongPause;
    if (!hand_.busy()) until_ = std::max(until_, now_ + (rests ? random_.uniform(2, 6) : 0.1));
  } else if (hand_.busy()) {
    // a look at the result after each action
    until_ = now_ + random_.logNormal(kReaction, 0.4);
  }
  pointer_out_.value = pointer_.state();
}

// The window's camera: it keeps all blocks, their places and the fingertips in the picture.
void NaiveVisitor::look() {
  std::vector<view::Ball> subject;
  for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i)
    if (!world_->scene.bodies[i].fixed) subject.push_back({poseOf(i).p, radiusOf(*world_->meshes[i].haptic)});
  for (const AssemblyGoal& goal : world_->scene.assembly->goals)
    subject.push_back({goal.X_WB.p, radiusOf(*world_->meshes[goal.bodies.front()].haptic)});
  for (std::size_t f = 0; f < 2; ++f)
    if (device_->fingers[f].valid) subject.push_back({device_->fingers[f].p_WH, 0.008});
  camera_.set(follow_.at(now_, subject, 16.0 / 9, view::kWholeWidth, false));
}

Vec3 NaiveVisitor::fingers() const { return (device_->fingers[0].p_WH + device_->fingers[1].p_WH) / 2; }

double NaiveVisitor::opening() const { return (device_->fingers[0].p_WH - device_->fingers[1].p_WH).norm(); }

/// Where a point seems to be: right across the line of sight, a guess along it, which gets worse the more the ground is
/// seen from its edge; the practised look from two sides first.
Vec3 NaiveVisitor::guess(const Vec3& p_W) {
  const view::CameraAxes axes = camera_.axes();
  const Vec3 level = Vec3::UnitZ().cross(axes.right);
  const double down = std::max(0.1, -(p_W - camera_.pose().eye).normalized().z());
  return p_W + kAcross * random_.normal() * axes.right +
         depth_ * (practised_ ? 1 : kSeenFrom / down) * random_.normal() * level +
         kAcross * random_.normal() * Vec3::UnitZ();
}

bool NaiveVisitor::isPlaced(std::size_t body) const {
  return std::ranges::any_of(assembly_->goals, [&](const GoalState& goal) {
    return goal.status == GoalState::Status::kFilled && goal.body == static_cast<std::int32_t>(body);
  });
}

void NaiveVisitor::next(Aim aim) {
  if (aim != aim_) tries_ = 0;
  aim_ = aim;
}

void NaiveVisitor::decide() {
  if (finished_at_ || now_ < known_.drag) {
    until_ = now_ + random_.uniform(0.5, 2);
    return;
  }
  if (++tries_ > kMaxTries) {
    write("gives this up");
    if (block_) waits_[*block_] = now_ + 5;
    next(Aim::kOpen);
  }
  // it stands: let go
  if (block_ && isPlaced(*block_) && aim_ != Aim::kLook && aim_ != Aim::kOpen && aim_ != Aim::kAway) next(Aim::kOpen);
  switch (aim_) {
    case Aim::kLook:
      return chooseBlock();
    case Aim::kOver:
      return over();
    case Aim::kDown:
      return down();
    case Aim::kPinch:
      return pinch();
    case Aim::kUp:
      return up();
    case Aim::kCarry:
      return carry();
    case Aim::kTurn:
      return turnIt();
    case Aim::kLower:
      return lower();
    case Aim::kOpen:
      return open();
    case Aim::kAway:
      next(Aim::kLook);
      if (now_ >= known_.lift) hand_.drag({0, 0, random_.uniform(0.06, 0.12)}, true, pointer_, camera_);
  }
}

// Any block; with the hint, the one that it points to.
void NaiveVisitor::chooseBlock() {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i)
    if (!world_->scene.bodies[i].fixed && !isPlaced(i) && waits_[i] <= now_) open.push_back(i);
  if (open.empty()) {
    tries_ = 0;
    return;
  }
  block_ = open[random_.below(open.size())];
  if (const std::int32_t hint = guide_->now.hint_body; hint != kNoBody && !ignores_)
    block_ = static_cast<std::size_t>(hint);
  taken_z_ = poseOf(*block_).p.z();
  write("wants " + world_->scene.bodies[*block_].name);
  next(Aim::kOver);
}

void NaiveVisitor::over() {
  Vec3 way = guess(poseOf(*block_).p) - fingers();
  way.z() = 0;
  if (way.norm() < there_) return next(Aim::kDown);
  hand_.drag(way, false, pointer_, camera_);
}

void NaiveVisitor::down() {
  const double high = fingers().z() - guess(poseOf(*block_).p).z();
  if (now_ < known_.lift || std::abs(high) < there_) return next(Aim::kPinch);
  hand_.drag({0, 0, -high}, true, pointer_, camera_);
}

// Notches until the fingertips seem to touch, and some more.
void NaiveVisitor::pinch() {
  if (now_ < known_.pinch) {
    // does not know how: waits, tries to push the block with a drag
    hand_.drag({random_.uniform(-0.05, 0.05), random_.uniform(-0.05, 0.05), 0}, false, pointer_, camera_);
    tries_ = 0;
    return next(Aim::kOver);
  }
  const double thick = 2 * 0.024 + 0.016;
  const bool touches = opening() < thick + random_.uniform(0, 0.012);
  hand_.scroll(static_cast<int>(touches ? 2 + random_.below(4) : 3 + random_.below(5)));
  write(touches ? "pinches harder" : "pinches");
  if (touches) next(Aim::kUp);
}

void NaiveVisitor::up() {
  if (now_ >= known_.lift && tries_ <= 1) {
    hand_.drag({0, 0, random_.uniform(0.06, 0.11)}, true, pointer_, camera_);
    return;
  }
  if (now_ < known_.lift && tries_ <= 1) return;  // looks what happened
  const bool lifted = poseOf(*block_).p.z() > taken_z_ + 0.01;
  const bool between = (poseOf(*block_).p - fingers()).head<2>().norm() < 0.03;
  if (lifted || (now_ < known_.lift && between)) return next(Aim::kCarry);
  write("did not get it");
  next(Aim::kOpen);
}

void NaiveVisitor::carry() {
  const Guidance& told = guide_->now;
  const auto body = static_cast<std::int32_t>(*block_);
  if ((poseOf(*block_).p - fingers()).norm() > 0.06) {
    write("lost it");
    return next(Aim::kOpen);
  }
  if (told.body == body && told.goal == kNoGoal && told.blocked != kNoGoal) {
    write("is told that it has to wait");
    waits_[*block_] = now_ + 25;
    return next(Aim::kLower);
  }
  if (told.body != body || told.goal == kNoGoal) return;
  const AssemblyGoal& goal = world_->scene.assembly->goals[static_cast<std::size_t>(told.goal)];
  Vec3 way = guess(goal.X_WB.p) - poseOf(*block_).p;
  way.z() = 0;
  if (way.norm() < there_) return next(Aim::kTurn);
  hand_.drag(way, false, pointer_, camera_);
}

void NaiveVisitor::turnIt() {
  const std::int32_t g = guide_->now.goal;
  if (g != kNoGoal && now_ >= known_.turn && tries_ <= 3) {
    const double off = yawOff(poseOf(*block_), world_->scene.assembly->goals[static_cast<std::size_t>(g)]);
    if (off > 0.25) return hand_.turn(random_.uniform() < 0.5 ? 3 : -3);  // which way it turns is tried out
  }
  next(Aim::kLower);
}

void NaiveVisitor::lower() {
  double to = taken_z_;
  if (waits_[*block_] <= now_ && guide_->now.goal != kNoGoal)
    to = world_->scene.assembly->goals[static_cast<std::size_t>(guide_->now.goal)].X_WB.p.z();
  const double high = poseOf(*block_).p.z() - to;
  if (now_ < known_.lift || high < 0.008) return next(Aim::kOpen);
  hand_.drag({0, 0, -high}, true, pointer_, camera_);
}

void NaiveVisitor::open() {
  const bool looks_open = opening() > 2 * 0.024 + 0.016 + 0.03;
  if (looks_open || now_ < known_.pinch) {
    if (block_ && isPlaced(*block_)) write("placed " + world_->scene.bodies[*block_].name);
    return next(Aim::kAway);
  }
  hand_.scroll(-static_cast<int>(4 + random_.below(6)));
  tries_ = std::min(tries_, 3);
}

}  // namespace presa::temple::test
