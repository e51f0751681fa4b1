#include "framework/device/device_modules.h"

#include <utility>

#include <algorithm>

#include "framework/core/schedule/clock.h"

namespace presa {

DeviceInput::DeviceInput(DeviceList& devices, const RunControl& control)
    : Module("device_input", RateGroup::kHaptic), devices_(devices), control_(control), checks_(devices.size()) {
  state_.value = DeviceState(devices.size());
  if (std::any_of(devices.begin(), devices.end(), [](const auto& device) { return device->looks(); }))
    seen_.emplace(*this, "object_state", In<ObjectState>::Optional{});
  if (std::any_of(devices.begin(), devices.end(), [](const auto& device) { return device->points(); }))
    pointer_.emplace(*this, kPointerPort, In<PointerState>::Optional{});
}

void DeviceInput::step(const Tick& tick) noexcept {
  DeviceState& state = state_.value;
  state.time = tick.time;
  state.stop_requested = control_.stop_requested.load(std::memory_order_relaxed);
  if (seen_ && seen_->hasValue()) {
    for (const auto& device : devices_) device->see(seen_->value(), tick);
  }
  if (pointer_ && pointer_->hasValue()) {
    for (const auto& device : devices_) device->point(pointer_->value(), tick);
  }
  const std::uint32_t before = std::exchange(state.rearms, control_.rearms.load(std::memory_order_relaxed));
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    if (state.rearms != before) {
      checks_[f].rearm();
      devices_[f]->rearm();
    }
    state.fingers[f] = checks_[f].take(devices_[f]->read(tick), tick.period);
  }
}

std::vector<std::string> DeviceInput::stages() const {
  return {"read every device into the Device State, check each sample"};
}

namespace {

// The shortest watchdog, which `presa explain` shows; step() uses each finger's own.
double firstWatchdog(const std::vector<FingerSafety>& safety) {
  double first = In<ObjectState>::kNever;
  for (const FingerSafety& finger : safety) first = std::min(first, finger.watchdog);
  return first;
}

}  // namespace

DeviceOutput::DeviceOutput(DeviceList& devices, const std::vector<FingerSafety>& safety, const Rates& rates,
                           bool realtime)
    : Module("device_output", RateGroup::kHaptic),
      devices_(devices),
      reported_(safety.size(), 0),
      realtime_(realtime),
      neighbourhood_age_(ages::neighbourhoods(rates)),
      objects_(*this, "object_state", In<ObjectState>::Optional{}, WhenOld::kFadeToZero, firstWatchdog(safety)) {
  command_.value = ForceCommand(devices.size());
  for (const FingerSafety& finger : safety) {
    stages_.emplace_back(finger.limits);
    watchdog_.push_back(finger.watchdog);
  }
}

OutputStage::Trust DeviceOutput::trust(std::size_t finger, const Tick& tick) const noexcept {
  using Trust = OutputStage::Trust;
  if (!device_->fingers[finger].valid || contact_->time < tick.time) return Trust::kDropped;
  if (neighbourhoods_.connected() && neighbourhoods_.age(tick) > neighbourhood_age_) return Trust::kDropped;
  if (objects_.hasValue() && objects_->faults != 0) return Trust::kFading;
  return objects_.connected() && objects_.age(tick) > watchdog_[finger] ? Trust::kFading : Trust::kGood;
}

void DeviceOutput::step(const Tick& tick) noexcept {
  // tick.time does not count the time for which the machine was suspended
  const double elapsed = tick.resumed ? std::max(tick.time - last_tick_.time, Executor::kGap) : tick.period;
  last_tick_ = tick;
  ForceCommand& command = command_.value;
  command.time = tick.time;
  command.status = 0;
  int lost = 0;
  for (std::size_t f = 0; f < devices_.size(); ++f) lost += device_->fingers[f].lost ? 1 : 0;
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    const FingerInput& finger = device_->fingers[f];
    if (device_->rearms != rearms_) stages_[f].rearm();
    const OutputStage::Input input{.command = {contact_->fingers[f].f_H_W, contact_->fingers[f].t_H_W},
                                   .trust = trust(f, tick),
                                   .stop = device_->stop_requested,
                                   .catch_up = tick.catch_up,
                                   .lost = finger.lost,
                                   .other_lost = lost > (finger.lost ? 1 : 0),
                                   .resumed = tick.resumed,
                                   .p_WH = finger.p_WH,
                                   .v_WH = finger.v_WH,
                                   .w_WT = finger.w_WT,
                                   .q_WT = finger.q_WT};
    const Wrench& sent = stages_[f].step(input, elapsed);
    command.f_H_W[f] = sent.f;
    command.t_H_W[f] = sent.t;
    command.status |= stages_[f].status();
    report(f, reported_[f], stages_[f].status(), tick.time);
    reported_[f] = stages_[f].status();
    send(f, tick);
  }
  rearms_ = device_->rearms;
}

// Catch-up ticks are not written: the device would receive many forces at one instant, in effect one step past the slew
// limit.
void DeviceOutput::send(std::size_t finger, const Tick& tick) noexcept {
  if (!tick.catch_up) devices_[finger]->write(stages_[finger].last(), tick);
}

// One event when a bit is newly set, not one per tick.
void DeviceOutput::report(std::size_t finger, std::uint32_t before, std::uint32_t now, double time) noexcept {
  const std::uint32_t risen = now & ~before & (kOutputLatches | kOutputWatchdog | kOutputWarm | kOutputOverload);
  if (risen != 0) events_.push({time, static_cast<std::int32_t>(finger), risen});
}

void DeviceOutput::stop() {
  Tick tick = last_tick_;
  tick.catch_up = false;  // the ticks of this fade are written
  for (bool moving = true; moving;) {
    moving = false;
    ++tick.index;
    tick.time += tick.period;
    if (realtime_) sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(tick.period * 1e9));
    for (std::size_t f = 0; f < devices_.size(); ++f) {
      const Wrench& sent = stages_[f].step({.stop = true}, tick.period);
      devices_[f]->write(sent, tick);
      moving = moving || !(sent == Wrench());
    }
  }
}

std::vector<std::string> DeviceOutput::stages() const {
  return {"output stage: finite, magnitude, energy, thermal, fade (soft start, watchdog, stop), slew",
          "write to the device; nothing is written in a catch-up tick: the force is held"};
}

}  // namespace presa
