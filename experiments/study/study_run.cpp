#include "experiments/study/study_run.h"

#include <cmath>

namespace presa {

/// Passes every sample to the observer.
class StudyRun::Probe final : public HapticObserver {
 public:
  Probe() : HapticObserver("study_probe") {}
  void observe(const HapticSample& sample) noexcept override {
    if (!observer) return;
    if (!line) return observer(sample);
    for (; passed < sample.tick.index; ++passed) line->pass(last);  // skipped ticks
    last = sample.command;
    const ForceCommand& felt = line->pass(last);
    ++passed;
    observer({sample.tick, sample.device, sample.contact, felt, sample.objects, sample.objects_version});
  }
  Observer observer;
  std::optional<DelayLine<ForceCommand>> line;  // with a latency
  ForceCommand last;
  std::uint64_t passed = 0;  // ticks whose command is on the line
};

StudyRun::StudyRun(const StudySpec& spec, DeviceList devices, const MakeModule& more) {
  Diagnostics diagnostics;
  RunOptions options;
  options.seed = spec.seed;
  options.duration = spec.duration > 0 || devices.empty() ? spec.duration : kDefaultDuration;
  options.force_share = spec.force_share;
  options.bus = BusSettings{.network = "none"};  // one of many runs; no viewer
  Loaded loaded = loadWorld({spec.scene, spec.rig, spec.sets}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);

  engines_ = engineVersions(loaded.plan);
  const double period = RateTable(loaded.world->scene.rates).period(RateGroup::kHaptic);
  const auto latency = static_cast<std::size_t>(std::lround(spec.conditions.latency / period));
  for (DeviceList* list : {&devices, &loaded.devices})
    for (std::unique_ptr<Device>& device : *list) device = behindLine(std::move(device), latency);
  Session::Options session_options;
  session_options.trace_rate = spec.trace_rate;
  session_options.devices = std::move(devices);
  if (more) session_options.more.push_back(more(loaded.world));
  auto probe = std::make_unique<Probe>();
  probe_ = probe.get();
  probe_->last = ForceCommand(loaded.world->scene.devices.size());
  if (latency > 0) probe_->line.emplace(latency, probe_->last);
  session_options.more.push_back(std::move(probe));
  run_.emplace(std::move(loaded), control_, std::move(session_options));
  if (LateTicks late(spec.conditions, spec.seed); late.any())
    delay([late](RateGroup group, double) mutable { return late(group); });
}

StudyRun::~StudyRun() = default;

void StudyRun::observe(Observer observer) { probe_->observer = std::move(observer); }

void StudyRun::delay(std::function<bool(RateGroup, double)> held_up) { run_->lockstep().delay(std::move(held_up)); }

}  // namespace presa
