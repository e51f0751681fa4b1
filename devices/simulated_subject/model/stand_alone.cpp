#include "devices/simulated_subject/model/stand_alone.h"

#include <algorithm>
#include <cmath>

namespace presa::subject {
namespace {

Task taskOf(const Trial& trial) {
  return {.reach = trial.reach, .hold = trial.hold, .device_resolution = trial.resolution};
}

}  // namespace

void DigitContact::step(const Cube& cube, double force_limit, double depth, double height) noexcept {
  slip_began_ = false;
  if (!(depth > 0)) {
    state_ = State::kFree;
    normal_ = load_ = 0;
    return;
  }
  if (state_ == State::kFree) stick(height);
  normal_ = std::min(cube.stiffness * depth, force_limit);
  load_ = cube.stiffness * (height - proxy_);
  const double sliding = cube.mu_d * normal_;
  const double bound = state_ == State::kSlip ? sliding : cube.mu_s * normal_;
  if (std::abs(load_) > bound) {
    slip_began_ = state_ == State::kStick;
    state_ = State::kSlip;
    load_ = std::copysign(std::min(sliding, std::abs(load_)), load_);
    proxy_ = height - load_ / cube.stiffness;
  } else if (std::abs(load_) <= sliding) {
    state_ = State::kStick;
  }
}

void StandAlone::Hold::add(double normal, double load_now) noexcept {
  count += 1;
  const double beside = normal - mean;
  mean += beside / count;
  squares += beside * (normal - mean);
  load += (load_now - load) / count;
}

StandAlone::StandAlone(const SubjectParameters& parameters, const Trial& trial)
    : trial_(trial),
      hand_(parameters, RandomStream(trial.seed, "motor noise", itemOf(trial.subject, trial.trial)), kPeriod,
            -trial.reach),
      brain_(parameters, taskOf(trial), RandomStream(trial.seed, "perception", itemOf(trial.subject, trial.trial)),
             kPeriod) {}

bool StandAlone::step() noexcept {
  if (brain_.phase() == Phase::kDone || time_ >= trial_.time_limit) return false;
  time_ += kPeriod;
  render();
  const Afferents felt = sense();
  moveCube();
  hand_.step(brain_.command(), felt.digits);
  const Phase before = brain_.phase();
  brain_.step(sense());
  measure(before);
  if (brain_.command().take_up_again) handBack();
  return true;
}

TrialResult StandAlone::run() noexcept {
  while (step()) {
  }
  return result();
}

void StandAlone::render() noexcept {
  for (int i = 0; i < kDigits; ++i) {
    const double face = i == 0 ? x_ : -x_;
    contacts_[i].step(trial_.cube, trial_.force_limit, quantised(hand_.q(i), trial_.resolution) - face,
                      quantised(hand_.y(i), trial_.resolution) - y_);
  }
}

void StandAlone::moveCube() noexcept {
  const DigitContact &thumb = contacts_[0], &index = contacts_[1];
  v_y_ += kPeriod * ((thumb.load() + index.load()) / trial_.cube.mass - Cube::kGravity);
  v_x_ += kPeriod * (thumb.normal() - index.normal()) / trial_.cube.mass;
  y_ += kPeriod * v_y_;
  x_ += kPeriod * v_x_;
  if (brain_.phase() <= Phase::kLoad && y_ < 0) y_ = v_y_ = 0;
}

Afferents StandAlone::sense() const noexcept {
  Afferents afferents;
  for (int i = 0; i < kDigits; ++i) {
    afferents.digits[i] = {hand_.q(i), hand_.y(i), hand_.vY(i), contacts_[i].normal(), contacts_[i].load()};
    afferents.sight.sliding |= contacts_[i].state() == DigitContact::State::kSlip;
  }
  afferents.effort = hand_.effort(brain_.command());
  afferents.sight.object = true;
  afferents.sight.height = y_ - hand_.meanHeight();
  return afferents;
}

void StandAlone::handBack() noexcept {
  const double stretch = trial_.cube.mass * Cube::kGravity / (2 * trial_.cube.stiffness);
  x_ = hand_.sway();
  y_ = hand_.meanHeight() - stretch;
  v_x_ = v_y_ = 0;
  hand_.place(brain_.command().grip / trial_.cube.stiffness);
  for (int i = 0; i < kDigits; ++i) contacts_[i].stick(hand_.y(i) - stretch - y_);
}

void StandAlone::measure(Phase before) noexcept {
  const Phase phase = brain_.phase();
  const double normal = meanNormal();
  const double largest = std::max(contacts_[0].normal(), contacts_[1].normal());
  result_.peak = std::max(result_.peak, largest);
  if (largest > kContinuousForce) result_.time_over_rating += kPeriod;

  const bool loosening = before == Phase::kLoosen || before == Phase::kRelease;
  if (loosening && std::isnan(slip_began_at_) && (contacts_[0].slipBegan() || contacts_[1].slipBegan())) {
    slip_began_at_ = time_;
    slip_began_with_ = normal;
  }
  if (phase == Phase::kHold) hold_.add(normal, 0.5 * (contacts_[0].load() + contacts_[1].load()));
  if (phase == before) return;
  if (before == Phase::kLoosen) result_.notice_delay = time_ - slip_began_at_;
  if (before == Phase::kRelease) result_.slip_force = slip_began_with_;
  if (phase == Phase::kRegrasp) hold_ = {};
  if (loosening) slip_began_at_ = slip_began_with_ = kNotMeasured;
}

TrialResult StandAlone::result() const noexcept {
  TrialResult result = result_;
  if (hold_.count > 1) {
    result.grip = hold_.mean;
    result.grip_sd = std::sqrt(hold_.squares / hold_.count);
    result.load = hold_.load;
  }
  result.slip_grip = brain_.slipGrip();
  result.wanted = brain_.wanted();
  result.drops = brain_.drops();
  result.regrips = brain_.regrips();
  result.duration = time_;
  result.completed = brain_.phase() == Phase::kDone;
  return result;
}

}  // namespace presa::subject
