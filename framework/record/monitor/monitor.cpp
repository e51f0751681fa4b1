#include "framework/record/monitor/monitor.h"
#include "framework/scene/joints/joint_motion.h"

#include <algorithm>
#include <cmath>

#include "framework/record/monitor/state_hash.h"
#include "framework/scene/pose_of.h"

namespace presa {
namespace {

// Limits the trace of a run of any length and any number of fingers to about 100 MB.
double maxTraceSamples(const World& world) {
  constexpr double kBytes = 100e6, kSamples = 40'000;
  const std::size_t finger = sizeof(FingerContact) + sizeof(Vec3) + sizeof(TraceRanges);
  return std::min(kSamples, kBytes / static_cast<double>(sizeof(TraceSample) + world.scene.devices.size() * finger));
}

std::uint64_t traceStride(const World& world, double duration, double trace_rate) {
  const double haptic = world.scene.rates.haptic;
  const double wanted = std::round(haptic / trace_rate);
  const double fitting = std::ceil(duration * haptic / maxTraceSamples(world));
  const double stride = std::max({1.0, wanted, std::isfinite(fitting) ? fitting : wanted});
  return static_cast<std::uint64_t>(stride);
}

bool touches(const FingerContact& finger) noexcept { return finger.mode != ContactMode::kNone; }

std::int32_t scriptedPhase(const DeviceState& device) noexcept {
  for (std::size_t f = 0; f < device.fingers.size(); ++f) {
    if (device.fingers[f].phase >= 0) return device.fingers[f].phase;
  }
  return -1;
}

}  // namespace

ForceParts partsOf(const Vec3& f_H_W, const FingerContact& contact) noexcept {
  if (!touches(contact)) return {f_H_W.norm(), 0};
  const double normal = f_H_W.dot(contact.nhat_W);
  return {normal, (f_H_W - normal * contact.nhat_W).norm()};
}

struct Monitor::Impl {
  Impl(std::shared_ptr<const World> shared_world, double duration, double release, double trace_rate)
      : world(std::move(shared_world)), release_time(release), reaction(world->scene) {
    const std::vector<Body>& bodies = world->scene.bodies;
    const std::size_t finger_count = world->scene.devices.size();
    fingers.resize(finger_count);
    force_sum.resize(finger_count);
    ticks_in_contact.resize(finger_count);
    previous.resize(finger_count);
    slip_onsets.resize(finger_count);
    objects.resize(bodies.size());
    fingers_on.resize(bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      objects[i].start = objects[i].highest = objects[i].final = bodies[i].X_WB.p;
      if (bodies[i].fixed) continue;
      free.push_back(i);
    }
    traceWhatIsLoose();
    moving.reserve(free.size());
    grasped.reserve(free.size());
    for (auto& list : slip_onsets) list.reserve(kMaxSlipOnsets);
    if (!(trace_rate > 0)) return;
    stride = traceStride(*world, duration, trace_rate);
    const double samples = duration * world->scene.rates.haptic / static_cast<double>(stride) + 2;
    // every page is touched now, so that the haptic loop pays for no page fault
    trace = BoundedList<TraceSample>(static_cast<std::size_t>(std::clamp(samples, 1.0, maxTraceSamples(*world))));
    while (TraceSample* sample = trace.add()) {
      sample->fingers.resize(finger_count);
      sample->f_command.resize(finger_count);
      sample->ranges.resize(finger_count);
    }
    trace.clear();
  }

  /// A trace has room for few bodies: first those that no joint holds, which people pick up.
  void traceWhatIsLoose() {
    std::vector<std::size_t> wanted = free;
    std::stable_partition(wanted.begin(), wanted.end(),
                          [&](std::size_t i) { return !isJoined(world->scene.joints, i); });
    wanted.resize(std::min(wanted.size(), TraceSample{}.bodies.size()));
    traced.assign(wanted.begin(), wanted.end());
  }

  /// Processes one tick, in the stages that Monitor::stages() lists.
  void observe(const HapticSample& sample) noexcept;
  void addToHash(const DeviceState& device, const ContactExchange& contact, const ObjectState* fresh) noexcept;
  void sumFingers(const Tick& tick, const ContactExchange& contact, const ObjectState* state, bool fresh) noexcept;
  void sumFinger(std::size_t f, const FingerContact& now, const Tick& tick) noexcept;
  void noteSlip(std::size_t f, const FingerContact& now, double time) noexcept;
  void sumObjects(const Tick& tick, const ContactExchange& contact, const ObjectState* state, bool fresh) noexcept;
  void follow(std::size_t i, const ObjectState& state, double time) noexcept;
  void noteGrasp(std::size_t i, double time) noexcept;
  void keep(const Tick& tick, const DeviceState& device, const ContactExchange& contact, const ForceCommand& command,
            const ObjectState* state) noexcept;
  /// Extends the ranges of the last trace sample by this tick; `first`: the sample's own tick.
  void extendRanges(const ContactExchange& contact, const ForceCommand& command, bool first) noexcept;

  std::shared_ptr<const World> world;
  double release_time;
  ActionReaction reaction;
  std::uint64_t solver_fallbacks = 0;
  EnergyCreated energy_created;
  std::uint64_t stopped_short = 0, too_many_held = 0;
  double far_lag = 0;
  std::uint64_t stride = 0;  ///< haptic ticks per trace sample; 0: no trace
  std::uint64_t objects_version = 0;
  double simulated_time = 0, stopped_at = -1;
  std::uint32_t object_faults = 0;
  double object_fault_time = -1;
  std::uint32_t pop_through = 0, coverage_lost = 0;
  double first_coverage_lost = -1;
  StateHash hash;
  std::vector<FingerSummary> fingers;
  std::vector<double> force_sum;
  std::vector<std::uint64_t> ticks_in_contact;
  std::vector<FingerContact> previous;
  std::vector<std::vector<SlipOnset>> slip_onsets;
  std::vector<ObjectSummary> objects;
  std::vector<std::int32_t> fingers_on;  ///< number of fingers by body, in this tick
  // few of thousands of bodies move or are held: each tick visits only those
  std::vector<std::size_t> free, moving, grasped;
  std::vector<std::int32_t> traced;
  BoundedList<TraceSample> trace;
};

void Monitor::Impl::sumFinger(std::size_t f, const FingerContact& now, const Tick& tick) noexcept {
  FingerSummary& sum = fingers[f];
  sum.seconds[static_cast<std::size_t>(now.mode)] += tick.period;
  if (touches(now) && stopped_at < 0) {
    sum.max_normal_force = std::max(sum.max_normal_force, now.normal_force);
    force_sum[f] += now.normal_force;
    sum.mean_normal_force = force_sum[f] / static_cast<double>(++ticks_in_contact[f]);
  }
  if (touches(now)) {
    if (now.body >= 0 && static_cast<std::size_t>(now.body) < fingers_on.size()) {
      ++fingers_on[static_cast<std::size_t>(now.body)];
    }
  }
  const FingerContact& before = previous[f];
  if (now.mode == ContactMode::kSlip && before.mode == ContactMode::kStick && now.body == before.body &&
      stopped_at < 0) {
    noteSlip(f, now, tick.time);
  }
  previous[f] = now;
}

void Monitor::Impl::noteSlip(std::size_t f, const FingerContact& now, double time) noexcept {
  const FingerContact& before = previous[f];
  const SlipOnset onset{time,
                        now.body,
                        now.normal_force,
                        now.tangential_force_W.norm(),
                        before.normal_force,
                        before.tangential_force_W.norm()};
  FingerSummary& sum = fingers[f];
  ++sum.slip_onsets;
  if (slip_onsets[f].size() < kMaxSlipOnsets) slip_onsets[f].push_back(onset);
  if (time >= release_time && sum.release_slip.time < 0) sum.release_slip = onset;
}

void Monitor::Impl::follow(std::size_t i, const ObjectState& state, double time) noexcept {
  ObjectSummary& object = objects[i];
  object.final = poseOf(world->scene, &state, static_cast<std::int32_t>(i), time).p;
  if (object.final.z() > object.highest.z()) object.highest = object.final;
}

void Monitor::Impl::noteGrasp(std::size_t i, double time) noexcept {
  ObjectSummary& object = objects[i];
  // a stiff contact may bounce once before it holds: a short interruption is no loss
  if (fingers_on[i] >= 2 && object.lost_at >= 0 && time - object.lost_at < kBounceTime) {
    object.lost_at = -1;
    object.dropped = false;
  }
  if (object.lost_at < 0 && fingers_on[i] == 0) {
    object.lost_at = time;
    object.dropped = time < release_time;  // false for NaN
  }
}

void Monitor::Impl::sumObjects(const Tick& tick, const ContactExchange& contact, const ObjectState* state,
                               bool fresh) noexcept {
  if (!fresh && state != nullptr) {
    for (const std::size_t i : moving) follow(i, *state, tick.time);
  } else if (fresh) {
    moving.clear();
    for (const std::size_t i : free) {
      follow(i, *state, tick.time);
      if (i >= state->bodies.size()) continue;
      const BodyMotion& motion = state->bodies[i];
      objects[i].peak_speed = std::max(objects[i].peak_speed, motion.v_WB.norm());
      if (motion.X_WB_begin.p != motion.X_WB_end.p || !motion.v_WB.isZero(0)) moving.push_back(i);
    }
  }
  for (std::size_t f = 0; f < contact.fingers.size(); ++f) {
    const auto i = static_cast<std::size_t>(contact.fingers[f].body);
    if (i >= objects.size() || fingers_on[i] < 2 || objects[i].grasped || world->scene.bodies[i].fixed) continue;
    objects[i].grasped = true;
    grasped.push_back(i);
  }
  if (stopped_at >= 0) return;
  for (const std::size_t i : grasped) noteGrasp(i, tick.time);
}

void Monitor::Impl::keep(const Tick& tick, const DeviceState& device, const ContactExchange& contact,
                         const ForceCommand& command, const ObjectState* state) noexcept {
  if (tick.index % stride != 0) {
    if (!trace.empty() && tick.time - trace[trace.size() - 1].time < static_cast<double>(stride) * tick.period)
      extendRanges(contact, command, false);
    return;
  }
  if (trace.size() == trace.capacity()) return;
  TraceSample& now = *trace.add();
  now.time = tick.time;
  now.phase = scriptedPhase(device);
  now.fingers = contact.fingers;
  now.f_command = command.f_H_W;
  for (std::size_t slot = 0; slot < traced.size(); ++slot)
    now.bodies[slot] = poseOf(world->scene, state, traced[slot], tick.time);
  extendRanges(contact, command, true);
}

void Monitor::Impl::extendRanges(const ContactExchange& contact, const ForceCommand& command, bool first) noexcept {
  TraceSample& sample = trace[trace.size() - 1];
  const std::size_t count = std::min({contact.fingers.size(), command.f_H_W.size(), sample.ranges.size()});
  for (std::size_t f = 0; f < count; ++f) {
    const FingerContact& finger = contact.fingers[f];
    const ForceParts commanded = partsOf(command.f_H_W[f], finger);
    TraceRanges& ranges = sample.ranges[f];
    const auto extend = [first](TraceRange& range, double value) { first ? range.begin(value) : range.add(value); };
    extend(ranges.height, finger.p_WH.z());
    extend(ranges.proxy_height, finger.p_WP.z());
    extend(ranges.rendered_normal, finger.normal_force);
    extend(ranges.rendered_tangential, finger.tangential_force_W.norm());
    extend(ranges.commanded_normal, commanded.normal);
    extend(ranges.commanded_tangential, commanded.tangential);
  }
}

Monitor::Monitor(std::shared_ptr<const World> world, double duration, double release_time, double trace_rate)
    : HapticObserver("monitor"), impl_(std::make_unique<Impl>(std::move(world), duration, release_time, trace_rate)) {}

Monitor::~Monitor() = default;

void Monitor::Impl::addToHash(const DeviceState& device, const ContactExchange& contact,
                              const ObjectState* fresh) noexcept {
  hash.add(device);
  hash.add(contact);
  if (fresh != nullptr) hash.add(*fresh);
}

void Monitor::Impl::sumFingers(const Tick& tick, const ContactExchange& contact, const ObjectState* state,
                               bool fresh) noexcept {
  if (state != nullptr) reaction.add(tick, contact, *state, fresh);
  std::fill(fingers_on.begin(), fingers_on.end(), 0);
  for (std::size_t f = 0; f < contact.fingers.size(); ++f) {
    sumFinger(f, contact.fingers[f], tick);
    if (fingers[f].pop_through == 0 && contact.pop_through_by_finger[f] > 0) fingers[f].first_pop_through = tick.time;
    fingers[f].pop_through = contact.pop_through_by_finger[f];
    fingers[f].leaps = contact.leaps_by_finger[f];
    fingers[f].reaction = reaction.of(f);
  }
  pop_through = contact.pop_through;
  if (coverage_lost == 0 && contact.coverage_lost > 0) first_coverage_lost = tick.time;
  coverage_lost = contact.coverage_lost;
}

void Monitor::Impl::observe(const HapticSample& sample) noexcept {
  const auto& [tick, device, contact, command, state, version] = sample;
  const bool fresh = state != nullptr && version != objects_version;
  objects_version = version;
  if (device.stop_requested && stopped_at < 0) stopped_at = tick.time;
  for (std::size_t f = 0; f < std::min(fingers.size(), command.f_H_W.size()); ++f)
    fingers[f].max_commanded_force = std::max(fingers[f].max_commanded_force, command.f_H_W[f].norm());
  addToHash(device, contact, fresh ? state : nullptr);
  sumFingers(tick, contact, state, fresh);
  if (fresh && state->faults != 0) {
    if (object_faults == 0) object_fault_time = tick.time;
    object_faults |= state->faults;
  }
  if (fresh) {
    solver_fallbacks = state->fallback_steps;
    energy_created = state->energy;
    stopped_short = state->stopped_short;
    too_many_held = state->too_many_held;
    far_lag = state->far_lag;
  }
  sumObjects(tick, contact, state, fresh);
  simulated_time = static_cast<double>(tick.index + 1) * tick.period;
  if (stride > 0) keep(tick, device, contact, command, state);
}

void Monitor::observe(const HapticSample& sample) noexcept { impl_->observe(sample); }

std::vector<std::string> Monitor::stages() const {
  std::vector<std::string> stages{"hash of Device, contact and Object State",
                                  "time in each contact mode, normal force, slip onsets, impulse given and rendered",
                                  "object path, grasp and loss"};
  if (impl_->stride > 0) stages.push_back("trace sample every " + std::to_string(impl_->stride) + " ticks");
  return stages;
}

const std::vector<FingerSummary>& Monitor::fingers() const noexcept { return impl_->fingers; }
const std::vector<ObjectSummary>& Monitor::objects() const noexcept { return impl_->objects; }
const std::vector<SlipOnset>& Monitor::slipOnsets(std::size_t finger) const noexcept {
  return impl_->slip_onsets[finger];
}
std::uint64_t Monitor::hash() const noexcept { return impl_->hash.value(); }
const BoundedList<TraceSample>& Monitor::trace() const noexcept { return impl_->trace; }
const std::vector<std::int32_t>& Monitor::tracedBodies() const noexcept { return impl_->traced; }
std::uint32_t Monitor::popThrough() const noexcept { return impl_->pop_through; }
std::uint32_t Monitor::coverageLost() const noexcept { return impl_->coverage_lost; }
double Monitor::firstCoverageLost() const noexcept { return impl_->first_coverage_lost; }
std::uint32_t Monitor::objectFaults() const noexcept { return impl_->object_faults; }
double Monitor::objectFaultTime() const noexcept { return impl_->object_fault_time; }
std::uint64_t Monitor::solverFallbacks() const noexcept { return impl_->solver_fallbacks; }
const EnergyCreated& Monitor::energyCreated() const noexcept { return impl_->energy_created; }
std::uint64_t Monitor::stoppedShort() const noexcept { return impl_->stopped_short; }
std::uint64_t Monitor::tooManyHeld() const noexcept { return impl_->too_many_held; }
double Monitor::farLag() const noexcept { return impl_->far_lag; }
double Monitor::stoppedAt() const noexcept { return impl_->stopped_at; }
double Monitor::simulatedTime() const noexcept { return impl_->simulated_time; }

}  // namespace presa
