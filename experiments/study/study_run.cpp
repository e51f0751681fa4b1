#include "experiments/study/study_run.h"

#include <algorithm>

#include "framework/session/load_world.h"

namespace presa {
namespace {

constexpr double kDefaultDuration = 10;  // [s], for scenes without a script

double scriptEnd(const DeviceList& devices) {
  double end = 0;
  for (const auto& device : devices) {
    const std::vector<double> times = device->phaseTimes();
    if (!times.empty()) end = std::max(end, times.back());
  }
  return end > 0 ? end : kDefaultDuration;
}

}  // namespace

/// Last module of the haptic group: passes its inputs to the observer.
class StudyRun::Probe final : public Module {
 public:
  Probe() : Module("study_probe", RateGroup::kHaptic) {}
  void step(const Tick& tick) noexcept override {
    if (!observer) return;
    observer({tick, device_.value(), contact_.value(), command_.value(),
              objects_.hasValue() ? &objects_.value() : nullptr, objects_.version()});
  }
  Observer observer;

 private:
  In<DeviceState> device_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> command_{*this, "force_command", In<ForceCommand>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
};

StudyRun::StudyRun(const StudySpec& spec, DeviceList devices, const MakeModule& more) {
  Diagnostics diagnostics;
  RunOptions options;
  options.seed = spec.seed;
  options.duration = spec.duration;
  options.force_share = spec.force_share;
  options.bus = BusSettings{.network = "none"};  // one of many runs; no viewer
  Loaded loaded = loadWorld({spec.scene, spec.rig, spec.sets}, options, diagnostics);
  if (!diagnostics.hasErrors() && devices.empty() && spec.duration <= 0) {
    // the monitor needs the duration to size its trace, and only the devices know it
    options.duration = scriptEnd(createDevices(*loaded.world, loaded.plan, diagnostics));
    loaded = loadWorld({spec.scene, spec.rig, spec.sets}, options, diagnostics);
  }
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  world_ = loaded.world;
  duration_ = world_->options.duration > 0 ? world_->options.duration : kDefaultDuration;

  engines_ = engineVersions(loaded.plan);
  Session::Options session_options;
  session_options.trace_rate = spec.trace_rate;
  session_options.devices = std::move(devices);
  if (more) session_options.more.push_back(more(world_));
  auto probe = std::make_unique<Probe>();
  probe_ = probe.get();
  session_options.more.push_back(std::move(probe));
  session_ = std::make_unique<Session>(world_, loaded.plan, control_, std::move(session_options));
  executor_ = std::make_unique<LockstepExecutor>(session_->graph(), RateTable(world_->scene.rates), control_);
}

StudyRun::~StudyRun() = default;

void StudyRun::observe(Observer observer) { probe_->observer = std::move(observer); }

void StudyRun::delay(std::function<bool(RateGroup, double)> held_up) { executor_->delay(std::move(held_up)); }

void StudyRun::run() { executor_->run(duration_); }

}  // namespace presa
