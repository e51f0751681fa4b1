#include "devices/simulated_subject/shared_subject.h"

#include <cmath>

namespace presa {
namespace {

using subject::kDigits;

constexpr double kSeenSliding = 0.02;  // [m/s]: above the speed at which the object yields under its weight
constexpr double kSeeingTime = 0.02;   // [s]
/// A worn device rubs and has mass: a force below this is no object. GUESS: above the bearings of a PERCRO arm, 0.2 N.
constexpr double kUnnoticed = 0.3;  // [N]

RandomStream streamOf(const SubjectSettings& settings, const char* name) {
  return {settings.seed, name, subject::itemOf(settings.subject, settings.trial)};
}

}  // namespace

SharedSubject::SharedSubject(const Grasp& grasp, const SubjectSettings& settings, double period)
    : grasp_(grasp),
      settings_(settings),
      hand_(settings.parameters, streamOf(settings, "motor noise"), period, -settings.reach),
      brain_(settings.parameters,
             {.reach = settings.reach,
              .from_table = true,
              .hold = settings.hold,
              .max_grip = settings.max_grip,
              .device_resolution = settings.resolution},
             streamOf(settings, "perception"), period) {}

void SharedSubject::see(const ObjectState& objects, const Tick& tick) noexcept {
  if (grasp_.body >= objects.count()) return;
  const Vec3 moved = objects.poseAt(grasp_.body, tick.time).p - grasp_.p_WB;
  seen_height_ = moved.z();
  afferents_.sight.aside = moved.dot(grasp_.inward_W);
  afferents_.sight.object = !(settings_.eyes_closed && brain_.phase() == subject::Phase::kHold);
}

Vec3 SharedSubject::faceOf(int digit) const noexcept {
  return grasp_.p_WB - (grasp_.width / 2 + grasp_.radius[static_cast<std::size_t>(digit)]) * inwardOf(digit);
}

Vec3 SharedSubject::start(int digit) const noexcept { return faceOf(digit) - settings_.reach * inwardOf(digit); }

FingerInput SharedSubject::read(int digit, const Tick& tick) noexcept {
  advance(tick);
  const Vec3 inward = inwardOf(digit);
  FingerInput input;
  input.p_WH = faceOf(digit) + subject::quantised(hand_.q(digit), settings_.resolution) * inward +
               subject::quantised(hand_.y(digit), settings_.resolution) * Vec3::UnitZ();
  input.v_WH = hand_.vQ(digit) * inward + hand_.vY(digit) * Vec3::UnitZ();
  input.phase = static_cast<std::int32_t>(brain_.phase());
  input.valid = true;
  input.buttons = pressed();
  return input;
}

void SharedSubject::feelForce(int digit, const Vec3& f_H_W, double unnoticed) noexcept {
  subject::DigitAfferents& felt = afferents_.digits[static_cast<std::size_t>(digit)];
  const double normal = -f_H_W.dot(inwardOf(digit));
  felt.normal = normal > unnoticed ? normal : 0;
  felt.load = -f_H_W.z();
}

void SharedSubject::write(int digit, const Vec3& f_H_W, const Tick& tick) noexcept {
  advance(tick);
  feelForce(digit, f_H_W, 0);
}

void SharedSubject::advance(const Tick& tick) noexcept {
  for (; at_.index < tick.index; ++at_.index) live(tick.period);
  at_ = tick;
}

void SharedSubject::live(double period) noexcept {
  hand_.step(brain_.command(), afferents_.digits);
  think(period);
}

/// The brain's turn, with the present state of the hand.
void SharedSubject::think(double period) noexcept {
  for (int i = 0; i < kDigits; ++i) {
    subject::DigitAfferents& digit = afferents_.digits[static_cast<std::size_t>(i)];
    digit.q = hand_.q(i);
    digit.y = hand_.y(i);
    digit.v_y = hand_.vY(i);
  }
  afferents_.effort = hand_.effort(brain_.command());
  afferents_.sight.height = seen_height_ - hand_.meanHeight();
  const double rate = (afferents_.sight.height - seen_before_) / period;
  seen_before_ = afferents_.sight.height;
  staying_behind_ += period * (rate - staying_behind_) / kSeeingTime;
  afferents_.sight.sliding = std::abs(staying_behind_) > kSeenSliding;
  brain_.step(afferents_);
}

void SharedSubject::feel(int digit, const Fingertip& tip) noexcept {
  const auto i = static_cast<std::size_t>(digit);
  const Vec3 inward = inwardOf(digit), across = inward.cross(Vec3::UnitZ()), at = tip.p_WH - faceOf(digit);
  places_[i] = {at.dot(inward), tip.v_WH.dot(inward), at.z(), tip.v_WH.z()};
  astray_[i] = at.dot(across);
  v_astray_[i] = tip.v_WH.dot(across);
  feelForce(digit, tip.f_H_W, kUnnoticed);
}

void SharedSubject::plan(double period) noexcept {
  pushes_ = hand_.push(brain_.command(), places_);
  think(period);
}

HandPush SharedSubject::push(int digit, const Tick& tick) noexcept {
  for (; planned_ <= tick.index; ++planned_) plan(tick.period);
  const auto i = static_cast<std::size_t>(digit);
  const Vec3 inward = inwardOf(digit), across = inward.cross(Vec3::UnitZ());
  const subject::SubjectParameters& body = settings_.parameters;
  HandPush push;
  push.force_W = -(body.posture_stiffness * astray_[i] + body.posture_damping * v_astray_[i]) * across;
  push.carry_W = pushes_[i].up * Vec3::UnitZ();
  push.grip_W = pushes_[i].along * inward;
  return push;
}

}  // namespace presa
