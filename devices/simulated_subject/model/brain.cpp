#include "devices/simulated_subject/model/brain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/device/minimum_jerk.h"

namespace presa::subject {
namespace {

// durations [s]
constexpr double kReachTime = 0.5, kPreloadTime = 0.25, kLiftTime = 0.8, kLoadTime = 1.6;
constexpr double kSettleTime = 0.8, kSettleLimit = 4, kWaitLimit = 4, kRegraspTime = 1, kAdjustTime = 0.5;
constexpr double kFallTime = 1, kSqueezeTime = 0.5;
constexpr double kBlindTime = 0.3;  // after a change of plan, without slip detection

constexpr double kFirstGrip = 1;                   // [N]
constexpr double kSafeRatio = 3.25;                // grip per load that is safe at friction 0.4: 1.3 / 0.4
constexpr double kSlightLoad = 0.05;               // [N]
constexpr double kFirmly = 1.2, kTouch = 0.5;      // share of the wanted grip for picking up; closing force [N]
constexpr double kSqueezeRate = 6;                 // [N/s] while the object is seen to slide
constexpr double kCouplingTime = 0.02;             // [s] time constant from lift force to grip
constexpr double kHarder = 1.25;                   // factor on the grip after a slip
constexpr double kPostureRate = 3, kLiftRate = 9;  // [1/s] correction rate of a height error

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

Brain::Brain(const SubjectParameters& parameters, const Task& task, RandomStream perception, double period)
    : parameters_(parameters),
      task_(task),
      period_(period),
      loosen_per_tick_(std::exp(-parameters.loosening * period)),
      adjust_per_tick_(std::exp(-2 * parameters.loosening * period)),
      perception_(period),
      reaction_(kNever) {
  misjudgement_ = 1 + parameters.force_weber * perception.normal();
  scatter_ = std::exp(parameters.trial_sd * perception.normal());
  slip_threshold_ = parameters.slip_threshold * std::exp(parameters.slip_threshold_sd * perception.normal());
  command_.height_rate = kPostureRate;
  if (task.reach > 0) {
    phase_ = Phase::kReach;
    command_.reaching = true;
    command_.reach = -task.reach;
  }
}

const MotorCommand& Brain::step(const Afferents& afferents) noexcept {
  perception_.step(afferents);
  effort_ = afferents.effort;
  time_ += period_;
  command_.take_up_again = false;
  switch (phase_) {
    case Phase::kReach:
      reach();
      break;
    case Phase::kPreload:
      preload();
      break;
    case Phase::kLoad:
      load();
      break;
    case Phase::kSettle:
      settle();
      break;
    case Phase::kLoosen:
      loosen();
      break;
    case Phase::kRegrasp:
      regrasp();
      break;
    case Phase::kAdjust:
      adjust();
      break;
    case Phase::kHold:
      hold();
      break;
    case Phase::kRelease:
      release();
      break;
    case Phase::kDone:
      break;
  }
  command_.grip = std::min(command_.grip, task_.max_grip);
  if (parameters_.muscle_time <= 0) command_.gain = 1 + parameters_.grip_stiffness / perception_.stiffness();
  return command_;
}

void Brain::enter(Phase phase) noexcept {
  phase_ = phase;
  time_ = 0;
  const bool loosening = phase == Phase::kLoosen || phase == Phase::kRelease;
  command_.height_rate = loosening ? 0 : phase == Phase::kLoad ? kLiftRate : kPostureRate;
}

void Brain::reach() noexcept {
  command_.reach = task_.reach * (minimumJerk(time_ / kReachTime) - 1);
  if (time_ < kReachTime) return;
  command_.reaching = false;
  enter(Phase::kPreload);
}

void Brain::preload() noexcept {
  command_.grip = std::min(kFirstGrip, time_ / kPreloadTime);
  if (time_ >= kPreloadTime) enter(Phase::kLoad);
}

void Brain::load() noexcept {
  command_.height = task_.height * minimumJerk(time_ / kLiftTime);
  // the grip leads, following the commanded lift force; the felt load would be too late at friction 0.4
  const double safe = kFirstGrip + kSafeRatio * std::max(effort_, 0.0);
  command_.grip += period_ * std::max(safe - command_.grip, 0.0) / kCouplingTime;
  if (squeezeWhenSliding() && waited_ < kWaitLimit) {
    waited_ += period_;
    time_ -= period_;  // pause the lift, or the fingers would leave the object on the table
  }
  if (time_ >= kLoadTime) enter(Phase::kSettle);
}

void Brain::settle() noexcept {
  squeezeWhenSliding();
  // wait for the hand to be still: a drift would be taken for a slip
  if (time_ < kSettleTime || (!perception_.still() && time_ <= kSettleLimit)) return;
  felt_weight_ = perception_.load();
  perception_.keepStiffness();
  perception_.rest();
  enter(Phase::kLoosen);
}

void Brain::loosen() noexcept {
  command_.grip *= loosen_per_tick_;
  if (!slipFelt() && !slipSeen() && !perception_.lost()) return;
  slip_grip_ = perception_.grip() * misjudgement_;
  wanted_ = gripFromMemory();
  takeUpAgain();
}

void Brain::regrasp() noexcept {
  if (task_.from_table) return regraspFromTable();
  if (time_ < kRegraspTime) return;
  perception_.rest();
  enter(Phase::kAdjust);
}

// Opens, waits until the object rests, moves to where it is seen, closes until both digits touch, squeezes, lifts and
// settles. If the object is still not held, repeats with more force.
void Brain::regraspFromTable() noexcept {
  const double open = time_ / kReachTime, down = (time_ - kFallTime) / kReachTime, close = down - 1;
  const double squeeze = (time_ - kFallTime - 2 * kReachTime) / kSqueezeTime;
  const double lift = (time_ - kFallTime - 2 * kReachTime - kSqueezeTime) / kLiftTime;
  command_.reaching = squeeze <= 0;
  command_.reach = task_.reach * (minimumJerk(close) - minimumJerk(open));
  if (down <= 0) {
    low_ = perception_.seenHeight().value_or(0);
    aside_ = perception_.seenAside().value_or(0);
  }
  command_.aside += (aside_ - command_.aside) * minimumJerk(down);
  command_.height = task_.height + (low_ - task_.height) * (minimumJerk(down) - minimumJerk(lift));
  command_.grip = firm_ * std::clamp(squeeze, 0.0, 1.0);
  if (squeeze > 0) command_.height_rate = lift < 1 ? kLiftRate : kPostureRate;
  const bool slides = lift > 0 && perception_.seenSliding() && perception_.load() > kSlightLoad;
  if (slides) firm_ += period_ * kSqueezeRate;
  if ((slides || (command_.grip > kTouch && lift < 0 && !perception_.touchesBoth())) && waited_ < kWaitLimit) {
    waited_ += period_;
    time_ -= period_;
  }
  if (lift < 1 + kLoadTime / kLiftTime || !(perception_.still() || lift > kSettleLimit / kLiftTime)) return;
  if (perception_.lost()) {
    firmness_ *= kHarder;
    return takeUpAgain();
  }
  perception_.rest();
  enter(Phase::kAdjust);
}

void Brain::adjust() noexcept {
  command_.grip = std::max(wanted_, command_.grip * adjust_per_tick_);
  if (keepHold()) return;
  if (command_.grip <= wanted_ && time_ > kAdjustTime) enter(Phase::kHold);
}

void Brain::hold() noexcept {
  if (keepHold()) return;
  if (time_ >= task_.hold) enter(Phase::kRelease);
}

void Brain::release() noexcept {
  command_.grip *= loosen_per_tick_;
  if (!perception_.lost()) return;
  command_.grip = 0;
  enter(Phase::kDone);
}

void Brain::open() noexcept {
  if (!task_.from_table) return;
  command_.reaching = true;
  command_.reach = -task_.reach * minimumJerk(time_ / kReachTime);
}

bool Brain::slipFelt() const noexcept { return perception_.kick() > slip_threshold_ && time_ > kBlindTime; }

bool Brain::slipSeen() const noexcept {
  return parameters_.seen_slip > 0 && perception_.fallen() > parameters_.seen_slip;
}

bool Brain::squeezeWhenSliding() noexcept {
  if (!perception_.seenSliding() || perception_.load() < kSlightLoad) return false;
  command_.grip += period_ * kSqueezeRate;
  return true;
}

double Brain::gripFromMemory() const noexcept {
  const double base = std::max(slip_grip_, 0.05) / (1 - parameters_.safety_margin);
  const double stiffness = perception_.stiffness();
  const double device = stiffness * task_.device_resolution, finger = stiffness * parameters_.finger_resolution;
  const double noise = parameters_.force_cv * base;
  const double uncertainty = std::sqrt(noise * noise + parameters_.force_noise * parameters_.force_noise +
                                       parameters_.counts_device * device * device / 12 + finger * finger);
  return (base + parameters_.clearance * uncertainty + parameters_.extra_grip) * scatter_;
}

void Brain::takeUpAgain() noexcept {
  firm_ = task_.from_table ? firmness_ * (kFirmly * wanted_ + kTouch)
                           : std::max(1.5 * wanted_, kSafeRatio * felt_weight_) + kFirstGrip;
  command_.grip = task_.from_table ? 0 : firm_;
  waited_ = 0;
  command_.take_up_again = true;
  if (task_.from_table) perception_.release();
  reaction_ = kNever;
  enter(Phase::kRegrasp);
}

bool Brain::keepHold() noexcept {
  if (perception_.lost()) {
    ++drops_;
    wanted_ *= kHarder;
    takeUpAgain();
    return true;
  }
  if (reaction_ == kNever && (slipFelt() || slipSeen()))
    reaction_ = slipFelt() ? parameters_.reaction : parameters_.seen_reaction;
  reaction_ -= period_;
  if (reaction_ > 0) return false;
  ++regrips_;
  wanted_ *= kHarder;
  command_.grip = std::max(command_.grip, wanted_);  // the grip may still be decreasing
  reaction_ = kNever;
  perception_.rest();
  return false;
}

}  // namespace presa::subject
