#include "framework/device/device_modules.h"

#include <algorithm>

#include "framework/schedule/clock.h"

namespace presa {

DeviceInput::DeviceInput(DeviceList& devices, const RunControl& control)
    : Module("device_input", RateGroup::kHaptic), devices_(devices), control_(control) {
  if (std::any_of(devices.begin(), devices.end(), [](const auto& device) { return device->looks(); }))
    seen_.emplace(*this, "object_state", In<ObjectState>::Optional{});
}

void DeviceInput::step(const Tick& tick) noexcept {
  DeviceState& state = state_.value;
  state.time = tick.time;
  state.count = static_cast<std::int32_t>(devices_.size());
  state.stop_requested = control_.stop_requested.load(std::memory_order_relaxed);
  if (seen_ && seen_->hasValue()) {
    for (const auto& device : devices_) device->see(seen_->value(), tick);
  }
  for (std::size_t f = 0; f < devices_.size(); ++f) state.fingers[f] = devices_[f]->read(tick);
}

std::vector<std::string> DeviceInput::stages() const { return {"read every device into the Device State"}; }

DeviceOutput::DeviceOutput(DeviceList& devices, const std::vector<DeviceRole>& roles, bool realtime)
    : Module("device_output", RateGroup::kHaptic), devices_(devices), reported_(roles.size(), 0), realtime_(realtime) {
  for (const DeviceRole& role : roles) {
    stages_.emplace_back(OutputLimits{.force = role.limits.force, .force_rate = role.limits.force_rate});
    watchdog_.push_back(role.limits.watchdog_ms * 1e-3);
  }
}

bool DeviceOutput::informationOld(std::size_t finger, const Tick& tick) const noexcept {
  const FingerInput& input = device_->fingers[finger];
  if (!input.valid) return true;
  if (contact_->time < tick.time) return true;
  if (objects_.hasValue() && objects_->faults != 0) return true;
  if (objects_.connected() && objects_.age(tick) > watchdog_[finger]) return true;
  return patches_.connected() && patches_.age(tick) > kPatchAge;
}

void DeviceOutput::step(const Tick& tick) noexcept {
  NoStageWatch nobody;
  run(tick, nobody);
}

void DeviceOutput::stepWatched(const Tick& tick, StageWatch& watch) noexcept { run(tick, watch); }

template <class Watch>
void DeviceOutput::run(const Tick& tick, Watch& watch) noexcept {
  last_tick_ = tick;
  ForceCommand& command = command_.value;
  command.time = tick.time;
  command.count = static_cast<std::int32_t>(devices_.size());
  command.status = 0;
  for (std::size_t f = 0; f < devices_.size(); ++f) {
    const OutputStage::Input input{contact_->fingers[f].f_H_W, informationOld(f, tick), device_->stop_requested,
                                   tick.made_up};
    command.f_H_W[f] = stages_[f].step(input, tick.period);
    command.status |= stages_[f].status();
    report(f, reported_[f], stages_[f].status(), tick.time);
    reported_[f] = stages_[f].status();
    watch.done(0);
    send(f, tick);
    watch.done(1);
  }
}

// A device that gets many forces at one instant feels only the last: as one step, and past the slew limit.
void DeviceOutput::send(std::size_t finger, const Tick& tick) noexcept {
  if (!tick.made_up) devices_[finger]->write(command_.value.f_H_W[finger], tick);
}

// One event when a bit comes up, not one per tick.
void DeviceOutput::report(std::size_t finger, std::uint32_t before, std::uint32_t now, double time) noexcept {
  const std::uint32_t risen = now & ~before & (kOutputNotFinite | kOutputWatchdog);
  if (risen != 0) events_.push({time, static_cast<std::int32_t>(finger), risen});
}

void DeviceOutput::stop() {
  Tick tick = last_tick_;
  tick.made_up = false;  // these are written
  for (bool moving = true; moving;) {
    moving = false;
    ++tick.index;
    tick.time += tick.period;
    if (realtime_) sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(tick.period * 1e9));
    for (std::size_t f = 0; f < devices_.size(); ++f) {
      const Vec3 force = stages_[f].step({Vec3::Zero(), false, true}, tick.period);
      devices_[f]->write(force, tick);
      moving = moving || force.norm() > 0;
    }
  }
}

std::vector<std::string> DeviceOutput::stages() const {
  return {"output stage: finite, magnitude, fade (soft start, watchdog, stop), slew",
          "write to the device, but for ticks made up after a late wake-up: the force is held"};
}

std::vector<std::string> DeviceOutput::stageFunctions() const {
  const std::string step = "presa::DeviceOutput::step", write = "presa::DeviceOutput::send";
  return {step + " - " + write, write};
}

}  // namespace presa
