#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/studies/cost/felt_metrics.h"
#include "apps/studies/cost/joint_watch.h"
#include "apps/studies/cost/measure.h"
#include "apps/studies/cost/rest_watch.h"
#include "apps/studies/cost/ripple.h"
#include "experiments/study/energy_ledger.h"
#include "experiments/study/free_motion.h"
#include "framework/scene/pose_of.h"

namespace presa::cost {
namespace {

constexpr std::int64_t kGridNs = 1'000'000;

/// Time of a window's bound [s]: a number, or the start of a scripted phase (its intent, or its name), or `fallback`.
double edge(StudyRun& run, const std::string& text, double fallback) {
  if (text.empty()) return fallback;
  double value = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc{} && rest == text.data() + text.size()) return std::min(value, run.duration());
  const double start = run.session().phaseStart(text);
  return std::isfinite(start) ? std::min(start, run.duration()) : fallback;
}

void keep(const Vec3& v, double (&out)[3]) { std::copy_n(v.data(), 3, out); }

BodySample sampleOf(const Pose& X_WB) {
  return {{X_WB.p.x(), X_WB.p.y(), X_WB.p.z()}, {X_WB.q.w(), X_WB.q.x(), X_WB.q.y(), X_WB.q.z()}};
}

class Watcher {
 public:
  Watcher(StudyRun& run, const Study& study) : run_(run), world_(run.world()), rates_(world_.scene.rates) {
    evidence_.compared_from = edge(run, study.compared.from, 0);
    evidence_.compared_to = edge(run, study.compared.to, run.duration());
    evidence_.steady_from = edge(run, study.steady.from, evidence_.compared_from);
    evidence_.steady_to = edge(run, study.steady.to, evidence_.compared_to);
    for (std::size_t i = 0; i < world_.scene.bodies.size(); ++i) {
      if (!world_.scene.bodies[i].fixed) free_.push_back(i);
    }
    evidence_.trace.fingers = world_.scene.devices.size();
    evidence_.trace.bodies = free_.size();
    rest_.emplace(world_, evidence_);
    joints_.emplace(world_.scene, evidence_);
    ripples_.assign(world_.scene.devices.size(),
                    Ripple(evidence_.compared_from, evidence_.compared_to, rates_.rate(RateGroup::kDynamics)));
  }

  void observe(const HapticSample& sample) {
    ledger_.observe(sample);
    const bool boundary = sample.objects != nullptr && sample.objects_version != version_;
    version_ = sample.objects_version;
    if (boundary) rest_->observe(*sample.objects);
    if (boundary) joints_->observe(*sample.objects);
    for (std::size_t f = 0; f < ripples_.size(); ++f) {
      const FingerContact& contact = sample.contact.fingers[f];
      ripples_[f].add(sample.tick.time, contact.f_H_W, contact.mode != ContactMode::kNone, boundary);
    }
    const std::int64_t ns = static_cast<std::int64_t>(sample.tick.index) * rates_.periodNs(RateGroup::kHaptic);
    hold(sample, ns);
    if (ns % kGridNs == 0) store(sample, ns);
  }

  Evidence finish() {
    evidence_.failure = failure();
    evidence_.hash = run_.monitor().hash();
    addSlip();
    if (!free_.empty()) {
      evidence_.energy_created = ledger_.created();
      if (ripples_.empty()) evidence_.energy_drift = ledger_.drift();  // with fingers, friction dissipates their work
    }
    const bool hears = rates_.divisor(RateGroup::kDynamics) > 2;  // otherwise the haptic rate is too low for the hum
    rest_->finish(evidence_);
    joints_->finish(evidence_);
    for (const Ripple& ripple : ripples_) {
      if (const auto step = ripple.step()) evidence_.force_step = std::max(evidence_.force_step.value_or(0), *step);
      const auto hum = ripple.hum();
      if (hum && hears && !free_.empty()) evidence_.hum = std::max(evidence_.hum.value_or(0), *hum);
    }
    return std::move(evidence_);
  }

 private:
  void hold(const HapticSample& sample, std::int64_t ns) {
    Trace& trace = evidence_.trace;
    trace.held_from_ns.push_back(ns);
    for (std::size_t f = 0; f < trace.fingers; ++f) {
      const Eigen::Vector3f force = sample.command.f_H_W[f].cast<float>();
      trace.held.push_back({force.x(), force.y(), force.z()});
    }
  }

  void store(const HapticSample& sample, std::int64_t ns) {
    Trace& trace = evidence_.trace;
    trace.time_ns.push_back(ns);
    const bool stepped =
        sample.objects == nullptr || std::abs(sample.objects->time_begin - sample.tick.time) < 0.5 * sample.tick.period;
    trace.stepped.push_back(stepped ? 1 : 0);
    for (std::size_t f = 0; f < trace.fingers; ++f) {
      const FingerContact& contact = sample.contact.fingers[f];
      FingerSample& out = trace.finger.emplace_back();
      out.touching = contact.mode != ContactMode::kNone ? 1 : 0;
      out.normal_force = contact.normal_force;
      keep(sample.command.f_H_W[f], out.force);
      keep(contact.p_WP, out.proxy);
      keep(sample.command.t_H_W[f], out.torque);
      out.stretch = (contact.p_WP - contact.p_WH).norm();
      if (contact.normal_force > 0) out.traction = contact.tangential_force_W.norm() / contact.normal_force;
      out.slipping = contact.mode == ContactMode::kSlip ? 1 : 0;
      finite_ = finite_ && sample.command.f_H_W[f].allFinite() && contact.p_WP.allFinite();
    }
    for (const std::size_t i : free_) {
      const Pose X_WB = poseOf(world_.scene, sample.objects, static_cast<std::int32_t>(i), sample.tick.time);
      trace.body.push_back(sampleOf(X_WB));
      finite_ = finite_ && X_WB.p.allFinite() && X_WB.q.coeffs().allFinite();
    }
  }

  std::string failure() const {
    const Monitor& monitor = run_.monitor();
    if ((monitor.objectFaults() & kFaultBodyFrozen) != 0) return "a body's motion became implausible";
    if ((monitor.objectFaults() & kFaultEngineFailed) != 0) return "the dynamics engine failed";
    if (monitor.objectFaults() != 0) return "the dynamics received an invalid finger contact";
    if (!finite_) return "a value was not finite";
    for (const std::size_t i : free_) {
      if (monitor.objects()[i].dropped) return world_.scene.bodies[i].name + " was dropped";
    }
    if (const std::string lost = rest_->lost(); !lost.empty()) return lost + " fell out of the scene";
    if (monitor.popThrough() > 0) return "a finger got past a surface";
    return {};
  }

  void addSlip() {
    double force = 0, time = 0;
    int count = 0;
    for (std::size_t f = 0; f < ripples_.size(); ++f) {
      const SlipOnset& slip = run_.monitor().fingers()[f].release_slip;
      if (slip.time < 0) continue;
      force += slip.normal_force;
      time += slip.time;
      ++count;
    }
    if (count == 0) return;
    evidence_.slip_force = force / count;
    evidence_.slip_time = time / count;
  }

  StudyRun& run_;
  const World& world_;
  RateTable rates_;
  EnergyLedger ledger_{std::make_shared<const World>(world_)};
  std::vector<std::size_t> free_;
  std::optional<RestWatch> rest_;
  std::optional<JointWatch> joints_;
  std::vector<Ripple> ripples_;
  std::uint64_t version_ = 0;
  bool finite_ = true;
  Evidence evidence_;
};

}  // namespace

Evidence watch(const StudySpec& spec, const Study& study) {
  StudyRun run(spec);
  Watcher watcher(run, study);
  run.observe([&](const HapticSample& sample) { watcher.observe(sample); });
  run.run();
  Evidence evidence = watcher.finish();
  evidence.vibration = vibrationOf(evidence);
  return evidence;
}

Evidence analyticAnswer(const StudySpec& spec) {
  StudyRun run(spec);  // loaded only for its world and duration
  const auto world = std::make_shared<const World>(run.world());
  FreeMotion motion(world);
  Evidence evidence;
  evidence.compared_to = evidence.steady_to = run.duration();
  Trace& trace = evidence.trace;
  for (const Body& body : world->scene.bodies) trace.bodies += body.fixed ? 0 : 1;
  const auto end = static_cast<std::int64_t>(run.duration() * 1e9);
  for (std::int64_t ns = 0; ns < end; ns += kGridNs) {
    trace.time_ns.push_back(ns);
    trace.stepped.push_back(1);
    for (std::size_t i = 0; i < world->scene.bodies.size(); ++i) {
      if (!world->scene.bodies[i].fixed) trace.body.push_back(sampleOf(motion.at(i, static_cast<double>(ns) * 1e-9)));
    }
  }
  return evidence;
}

}  // namespace presa::cost
