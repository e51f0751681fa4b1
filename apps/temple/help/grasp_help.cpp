#include "apps/temple/help/grasp_help.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/assembly/assembly_state.h"
#include "framework/scene/goal_pose.h"

namespace presa::temple {
namespace {

constexpr double kThere = 0.008, kTurned = 0.12;     // the pair is over a block [m, rad]
constexpr double kLeaves = 1.4;                      // of the reach, beyond which a block is left again
constexpr double kFewNotches = 0.07;                 // closing or opening that is meant: two notches of the wheel
constexpr double kFirm = 0.85;                       // closing of a firm grip
constexpr double kSure = 0.25, kInVain = 2;          // time of contact that counts as held, of a grip without any [s]
constexpr double kLost = 0.4;                        // without contact [s]
constexpr double kRoom = 0.012;                      // of a carried block, or open fingertips, over what stands [m]
constexpr double kLift = 0.02;                       // least height over where it was taken [m]
constexpr double kClearedAround = 0.14;              // level distance within which blocks are cleared [m]
constexpr double kAligned = 0.006, kStraight = 0.1;  // before a block is lowered to its place [m, rad]
constexpr double kAbove = 0.001;                     // over its place, where it is let go [m]
constexpr double kPutsDown = 0.03;                   // drag downwards that is meant to put a block down [m]
constexpr double kPutDown = 1.5, kOpens = 0.6;       // longest time of either [s]
constexpr double kForgets = 0.05;                    // drag over which the offset of the pair fades [m]

Vec3 level(const Vec3& v) noexcept { return {v.x(), v.y(), 0}; }

double wrapped(double angle) noexcept { return std::remainder(angle, 2 * std::numbers::pi); }

double yawOf(const Quat& from, const Quat& to) noexcept {
  const Vec3 x = (to * from.conjugate()) * Vec3::UnitX();
  return std::atan2(x.y(), x.x());
}

}  // namespace

GraspHelp::GraspHelp(std::shared_ptr<const World> world)
    : world_(std::move(world)), shapes_(blockShapes(*world_)), placed_(world_->scene.bodies.size()) {
  for (const DeviceRole& role : world_->scene.devices) fingertip_ = std::max(fingertip_, role.fingertip_radius);
  for (const Body& body : world_->scene.bodies) X_WB_.push_back(body.X_WB);
}

void GraspHelp::see(const ObjectState& objects) noexcept {
  for (std::size_t i = 0; i < X_WB_.size() && i < objects.bodies.size(); ++i) X_WB_[i] = objects.bodies[i].X_WB_end;
}

const Pose& GraspHelp::poseOf(std::int32_t body) const noexcept { return X_WB_[static_cast<std::size_t>(body)]; }

const PointerState& GraspHelp::target(const PointerState& wanted, const Tick& tick) noexcept {
  if (wanted.sequence == 0) return wanted;
  if (tick.index == tick_ && out_.sequence != 0) return out_;
  tick_ = tick.index;
  now_ = tick.time;
  if (out_.sequence == 0) last_ = wanted.p_WT;
  out_ = wanted;
  if (active_.load(std::memory_order_relaxed))
    step(wanted);
  else
    stage_ = Stage::kFree;
  last_ = wanted.p_WT;
  return out_;
}

void GraspHelp::go(Stage stage) noexcept {
  stage_ = stage;
  stage_at_ = touched_at_ = opens_at_ = now_;
}

void GraspHelp::step(const PointerState& wanted) noexcept {
  closing_ = wanted.wheel;
  open_from_ = std::min(open_from_, closing_);
  closed_from_ = std::max(closed_from_, closing_);
  base_ = std::clamp(base_, closing_ - 1, closing_);
  if (stage_ == Stage::kFree) look(wanted);
  switch (stage_) {
    case Stage::kFree:
      return free(wanted);
    case Stage::kOver:
    case Stage::kAt:
      return over(wanted);
    case Stage::kGrip:
      return grip(wanted);
    case Stage::kHeld:
      return carry(wanted);
    case Stage::kPlace:
    case Stage::kDown:
      return place(wanted);
    case Stage::kOpen:
    case Stage::kLeave:
      return open(wanted);
  }
}

/// The nearest block that may be taken, by level distance.
std::int32_t GraspHelp::nearest(const Vec3& p, double reach) const noexcept {
  std::int32_t found = kNoBody;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (shapes_[i].half.isZero() || placed_[i].load(std::memory_order_relaxed)) continue;
    const double distance = level(X_WB_[i].p - p).norm();
    if (distance >= reach) continue;
    reach = distance;
    found = static_cast<std::int32_t>(i);
  }
  return found;
}

/// Height of the highest block near p, or 0.
double GraspHelp::clearHeight(const Vec3& p, double reach, std::int32_t but) const noexcept {
  double top = 0;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    if (shapes_[i].half.isZero() || static_cast<std::int32_t>(i) == but) continue;
    if (level(X_WB_[i].p - p).norm() > reach) continue;
    top = std::max(top, X_WB_[i].p.z() + (X_WB_[i].q.toRotationMatrix().row(2).cwiseAbs() * shapes_[i].half)(0));
  }
  return top;
}

bool GraspHelp::wantsClosed() const noexcept { return closing_ > open_from_ + kFewNotches; }
bool GraspHelp::wantsOpen() const noexcept { return closing_ < closed_from_ - kFewNotches; }

void GraspHelp::look(const PointerState& wanted) noexcept {
  help_ = strength_.load(std::memory_order_relaxed);
  if (help_ < kNone) return;
  const double reach = help_ * kReach;
  const std::int32_t body = nearest(wanted.p_WT + offset_, reach);
  if (left_ != kNoBody && level(poseOf(left_).p - wanted.p_WT - offset_).norm() > kLeaves * reach) left_ = kNoBody;
  highest_ = std::max(highest_, wanted.p_WT.z());
  const bool again = wantsClosed() || wanted.p_WT.z() < highest_ - kPutsDown;
  if (body == kNoBody || (body == left_ && !again)) return;
  body_ = body;
  open_from_ = closing_;
  go(Stage::kOver);
}

// The pair follows the visitor. What is left of the last help fades with the visitor's own movements.
void GraspHelp::free(const PointerState& wanted) noexcept {
  const double left = std::max(0.0, 1 - level(wanted.p_WT - last_).norm() / kForgets);
  offset_ *= left;
  yaw_offset_ *= left;
  out_.p_WT += offset_;
  out_.yaw += yaw_offset_;
  out_.closing = closing_ - base_;
  if (help_ < kHighHelp) return;
  const double top = clearHeight(middle(), kClearedAround, kNoBody);
  if (top > 0) out_.p_WT.z() = std::max(out_.p_WT.z(), top + fingertip_ + kRoom);
}

void GraspHelp::aim(const PointerState& wanted) noexcept {
  aim_ = aimAt(shapes_[static_cast<std::size_t>(body_)], poseOf(body_), wanted.yaw + yaw_offset_, fingertip_);
  out_.p_WT.head<2>() = aim_.p_W.head<2>();
  out_.yaw = aim_.yaw;
  out_.closing = 0;
}

// Over the block: first level, then down.
void GraspHelp::over(const PointerState& wanted) noexcept {
  const Vec3 own = wanted.p_WT + offset_;
  if (level(own - poseOf(body_).p).norm() > kLeaves * help_ * kReach) {
    base_ = closing_;
    left_ = kNoBody;
    aim_.p_W = middle();
    return go(stage_ == Stage::kAt ? Stage::kLeave : Stage::kFree);
  }
  aim(wanted);
  const bool turned = std::abs(wrapped(pairYaw() - aim_.yaw)) < kTurned;
  const bool there = turned && level(middle() - aim_.p_W).norm() < kThere;
  if (stage_ == Stage::kOver && there) go(Stage::kAt);
  if (help_ >= kHighHelp)
    out_.p_WT.z() = stage_ == Stage::kAt ? aim_.p_W.z() : std::max(wanted.p_WT.z(), aim_.top + fingertip_ + kRoom);
  if (stage_ != Stage::kAt || !wantsClosed() || std::abs(middle().z() - out_.p_WT.z()) > kThere) return;
  grasp_need_.store(level(own - aim_.p_W).norm() + std::max(0.0, wanted.p_WT.z() - aim_.top));
  taken_z_ = poseOf(body_).p.z();
  closed_from_ = closing_;
  offset_ = level(aim_.p_W - wanted.p_WT);
  yaw_offset_ = aim_.yaw - wanted.yaw;
  go(Stage::kGrip);
}

/// The pair as the visitor moves it, closed firmly.
void GraspHelp::hold() noexcept {
  out_.p_WT += offset_;
  out_.yaw += yaw_offset_;
  out_.closing = std::max(closing_ - base_, kFirm);
}

void GraspHelp::grip(const PointerState& wanted) noexcept {
  const bool opens = wantsOpen();
  hold();
  if (help_ >= kHighHelp) out_.p_WT.z() = aim_.p_W.z();
  if (!pressed_[0] || !pressed_[1]) touched_at_ = now_;
  if (opens || since() > kInVain) return release(wanted);
  highest_ = wanted.p_WT.z();
  if (now_ - touched_at_ > kSure) go(Stage::kHeld);
}

bool GraspHelp::loses() noexcept {
  if (pressed_[0] || pressed_[1]) touched_at_ = now_;
  return now_ - touched_at_ > kLost;
}

void GraspHelp::takeGoal(const PointerState& wanted) noexcept {
  const std::int64_t both = goal_.load(std::memory_order_relaxed);
  const bool mine = both >= 0 && static_cast<std::int32_t>(both >> 32) == body_;
  place_ = mine ? static_cast<std::int32_t>(both & 0xffffffff) : kNoGoal;
  if (place_ == kNoGoal) return;
  // where the block would be if the hand were where the visitor wants it
  const Vec3 own = poseOf(body_).p - middle() + wanted.p_WT + offset_;
  way_ = level(world_->scene.assembly->goals[static_cast<std::size_t>(place_)].X_WB.p - own);
}

double GraspHelp::snapDistance() const noexcept {
  const Assembly& assembly = *world_->scene.assembly;
  return place_ == kNoGoal ? assembly.snap_distance
                           : assembly.snapDistanceOf(assembly.goals[static_cast<std::size_t>(place_)]);
}

void GraspHelp::notePlace() noexcept { place_need_.store(std::max(0.0, way_.norm() - snapDistance() / 2)); }

void GraspHelp::carry(const PointerState& wanted) noexcept {
  const bool opens = wantsOpen();
  takeGoal(wanted);
  hold();
  if (loses()) return release(wanted);
  highest_ = std::max(highest_, wanted.p_WT.z());
  if (opens && help_ < kHighHelp) return release(wanted);
  if (opens || (help_ >= kHighHelp && wanted.p_WT.z() < highest_ - kPutsDown)) return go(Stage::kDown);
  if (place_ != kNoGoal && way_.norm() < help_ * kReach) return go(Stage::kPlace);
  if (help_ < kHighHelp) return;
  // clear of what stands around, and of where the block belongs
  const double hangs = middle().z() - poseOf(body_).p.z();
  const GraspAim now = aimAt(shapes_[static_cast<std::size_t>(body_)], poseOf(body_), 0, fingertip_);
  const double below = poseOf(body_).p.z() - now.bottom;
  double low = taken_z_ + kLift;
  if (const double top = clearHeight(middle(), kClearedAround, body_); top > 0)
    low = std::max(low, top + kRoom + below);
  out_.p_WT.z() = std::max(wanted.p_WT.z(), low + hangs);
}

void GraspHelp::place(const PointerState& wanted) noexcept {
  const bool opens = wantsOpen();
  if (!opens) opens_at_ = now_;
  hold();
  takeGoal(wanted);
  if (loses() || now_ - opens_at_ > kPutDown || (opens && help_ < kHighHelp)) return release(wanted);
  const bool stands = placed_[static_cast<std::size_t>(body_)].load(std::memory_order_relaxed);
  if (stage_ == Stage::kDown) return putDown(wanted, stands);
  if (stands) {
    if (help_ < kHighHelp) return;
    notePlace();
    return release(wanted);
  }
  if (place_ == kNoGoal || way_.norm() > kLeaves * help_ * kReach) return go(Stage::kHeld);
  overPlace(opens);
  const Vec3& goal = world_->scene.assembly->goals[static_cast<std::size_t>(place_)].X_WB.p;
  if (!opens || (poseOf(body_).p - goal).norm() > snapDistance() / 2) return;
  notePlace();
  release(wanted);
}

// Where it is, as low as it was taken.
void GraspHelp::putDown(const PointerState& wanted, bool stands) noexcept {
  const double high = poseOf(body_).p.z() - taken_z_;
  out_.p_WT.z() = middle().z() - std::min(kRoom, high);
  if (stands || high < 2 * kAbove) release(wanted);
}

// The block is turned to the nearest orientation that fits, and lowered once it is over its place.
void GraspHelp::overPlace(bool opens) noexcept {
  const Pose& X_WB = poseOf(body_);
  const AssemblyGoal& goal = world_->scene.assembly->goals[static_cast<std::size_t>(place_)];
  const Pose X_WG = nearestTurn(goal.X_WB, goal.fold, X_WB.q);
  const double turn = yawOf(X_WB.q, X_WG.q);
  const Vec3 in_hand = middle() - X_WB.p;
  const Vec3 turned = Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())) * in_hand;
  out_.yaw += wrapped(pairYaw() + turn - out_.yaw);
  out_.p_WT.head<2>() = (X_WG.p + turned).head<2>();
  if (help_ < kHighHelp) return;
  const bool over = level(X_WB.p - X_WG.p).norm() < kAligned && std::abs(turn) < kStraight;
  out_.p_WT.z() = X_WG.p.z() + in_hand.z() + (over || opens ? kAbove : kRoom);
}

double GraspHelp::pairYaw() const noexcept {
  const Vec3 line = p_WH_[1] - p_WH_[0];
  return std::atan2(line.y(), line.x());
}

/// From here on the hand opens where it is.
void GraspHelp::release(const PointerState& wanted) noexcept {
  offset_ = level(middle() - wanted.p_WT);
  yaw_offset_ = wrapped(pairYaw() - wanted.yaw);
  base_ = open_from_ = closing_;
  highest_ = wanted.p_WT.z();
  left_ = body_;
  aim_.p_W = middle();
  go(Stage::kOpen);
}

// Opens where the hand is, then goes up.
void GraspHelp::open(const PointerState& wanted) noexcept {
  const double floor = aimAt(shapes_[static_cast<std::size_t>(body_)], poseOf(body_), 0, fingertip_).top;
  out_.p_WT.head<2>() = aim_.p_W.head<2>();
  out_.yaw += yaw_offset_;
  out_.closing = 0;
  const bool high = help_ >= kHighHelp;
  if (stage_ == Stage::kOpen) {
    if (high) out_.p_WT.z() = aim_.p_W.z();
    if (halfOpening() > aim_.half + 2 * fingertip_ || since() > kOpens) go(Stage::kLeave);
    return;
  }
  const double clear = floor + fingertip_ + kRoom;
  if (high) out_.p_WT.z() = std::max(wanted.p_WT.z(), clear);
  if (high && middle().z() < clear - kRoom && since() < kPutDown) return;
  body_ = kNoBody;
  go(Stage::kFree);
}

}  // namespace presa::temple
