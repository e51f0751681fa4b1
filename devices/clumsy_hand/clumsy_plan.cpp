#include "devices/clumsy_hand/clumsy_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/physics_shapes.h"

namespace presa::clumsy {
namespace {

constexpr double kHalfField = 0.45, kHighest = 0.5;  // bounds of the random positions [m]
constexpr double kOver = 0.06;                       // height above a body before going down [m]

/// Distance from a body's origin to its farthest point [m].
double sizeOf(const Body& body, const BodyMeshes& meshes) {
  double size = 0;
  for (const PhysicsShape& shape : physicsShapes(body, meshes)) {
    const double radius = shape.mesh != nullptr ? radiusOf(*shape.mesh) : boundingRadius(*shape.shape);
    size = std::max(size, shape.X_BG.p.norm() + radius);
  }
  return size;
}

}  // namespace

const std::vector<std::string>& ClumsyPlan::phaseNames() {
  static const std::vector<std::string> names{"stray", "reach", "grab",  "lift", "shake",
                                              "throw", "drag",  "press", "push", "open"};
  return names;
}

ClumsyPlan::ClumsyPlan(std::shared_ptr<const World> world, double fingertip, std::uint64_t seed)
    : PairPlan({.centre = {0, 0, kHighest}, .gap = 0.05}),
      world_(std::move(world)),
      fingertip_(fingertip),
      random_(seed, "clumsy hand") {
  for (std::size_t i = 0; i < world_->scene.bodies.size(); ++i) {
    const Body& body = world_->scene.bodies[i];
    size_.push_back(sizeOf(body, world_->meshes[i]));
    if (body.physics && !body.fixed) movable_.push_back(i);
  }
}

void ClumsyPlan::add(Phase phase, const PairTarget& to, double speed) noexcept {
  if (count_ < steps_.size()) steps_[count_++] = {phase, to, std::min(speed, kFastest)};
}

void ClumsyPlan::next(const ObjectState& objects) noexcept {
  if (done_ == count_) choose(objects);
  const Step& step = steps_[done_++];
  goAt(step.phase, step.to, step.speed);
}

/// A random horizontal vector of length `min` to `max` [m].
Vec3 ClumsyPlan::across(double min, double max) noexcept {
  const double angle = uniform(0, 2 * std::numbers::pi), length = uniform(min, max);
  return {length * std::cos(angle), length * std::sin(angle), 0};
}

void ClumsyPlan::choose(const ObjectState& objects) noexcept {
  count_ = done_ = 0;
  const double act = uniform(0, 1);
  if (act < 0.6)
    grab(objects);
  else if (act < 0.75)
    press(objects);
  else if (act < 0.9)
    push(objects);
  else
    stray();
}

void ClumsyPlan::stray() noexcept {
  PairTarget to = target();
  to.grip = 0;
  to.gap = uniform(fingertip_, 0.1);
  to.centre = {uniform(-kHalfField, kHalfField), uniform(-kHalfField, kHalfField), uniform(0, kHighest)};
  add(kStray, to, uniform(0.2, kFastest));
}

// Grabs a body somewhere, even at its goal, with a random force.
void ClumsyPlan::grab(const ObjectState& objects) noexcept {
  const std::size_t body = anyBody();
  const double size = size_[body];
  PairTarget to = target();
  to.grip = 0;
  to.gap = size + fingertip_ + uniform(0, 0.02);
  to.yaw = uniform(-std::numbers::pi, std::numbers::pi);
  to.centre = objects.bodies[body].X_WB_end.p + across(0, 0.5 * size);
  const double there = std::max(fingertip_, to.centre.z() + uniform(-0.5, 0.5) * size);
  to.centre.z() += size + kOver;
  add(kReach, to, uniform(0.3, kFastest));
  to.centre.z() = there;
  add(kReach, to, uniform(0.1, 0.8));
  to.gap = uniform(0.1, 1) * size + fingertip_;
  to.grip = uniform(0.3, kMaxGrip);
  add(kGrab, to, 0.5);
  withWhatIsHeld(to);
}

void ClumsyPlan::withWhatIsHeld(PairTarget to) noexcept {
  const PairTarget taken = to;
  const double what = uniform(0, 1);
  if (what < 0.25) {  // drag along the ground, possibly out of the workspace
    to.centre += across(0.05, 0.6);
    add(kDrag, to, uniform(0.1, 0.6));
  } else {
    to.centre.z() += uniform(0.02, 0.35);
    add(kLift, to, uniform(0.1, 0.8));
  }
  if (what > 0.4 && what < 0.65) {
    for (auto times = 2 + random_.below(6); times > 0; --times) {
      PairTarget there = to;
      there.centre += across(0.02, 0.1);
      there.yaw += uniform(-0.5, 0.5);
      add(kShake, there, kFastest);
    }
  }
  if (what > 0.65 && what < 0.9) {  // throw: release during the movement
    to.centre += across(0.1, 0.5);
    to.grip = 0;
    to.gap = taken.gap + 0.08;
    add(kThrow, to, kFastest);
  }
  if (what > 0.9) {  // down again, onto anything below
    to.centre += across(0, 0.2);
    to.centre.z() = uniform(-0.02, 0.1);
    add(kPress, to, uniform(0.1, 0.6));
  }
  to.grip = 0;
  to.gap = taken.gap + uniform(0.01, 0.08);
  add(kOpen, to, 0.5);
  to.centre.z() += 0.1;
  add(kOpen, to, 0.6);
}

// Presses from above with both fingers side by side.
void ClumsyPlan::press(const ObjectState& objects) noexcept {
  const std::size_t body = anyBody();
  PairTarget to = target();
  to.grip = 0;
  to.gap = fingertip_ * uniform(1, 2);
  to.yaw = uniform(-std::numbers::pi, std::numbers::pi);
  to.centre = objects.bodies[body].X_WB_end.p + across(0, size_[body]);
  const double deep = to.centre.z() - uniform(0, 1) * size_[body];
  to.centre.z() += size_[body] + kOver;
  add(kReach, to, uniform(0.3, kFastest));
  to.centre.z() = deep;
  add(kPress, to, uniform(0.05, 0.8));
  add(kPress, to, 1);
  to.centre.z() += 0.15;
  add(kOpen, to, uniform(0.2, kFastest));
}

// Pushes through a body, from one side to the other.
void ClumsyPlan::push(const ObjectState& objects) noexcept {
  const std::size_t body = anyBody();
  const Vec3 way = across(0.05, 0.2) + size_[body] * across(1, 1);
  PairTarget to = target();
  to.grip = 0;
  to.gap = uniform(fingertip_, size_[body] + fingertip_);
  to.yaw = uniform(-std::numbers::pi, std::numbers::pi);
  to.centre = objects.bodies[body].X_WB_end.p - way;
  to.centre.z() = std::max(fingertip_, to.centre.z() + uniform(-0.3, 0.3) * size_[body]);
  add(kReach, to, uniform(0.3, kFastest));
  to.centre += 2 * way;
  add(kPush, to, uniform(0.1, kFastest));
  to.centre.z() += 0.15;
  add(kOpen, to, uniform(0.2, kFastest));
}

}  // namespace presa::clumsy
