#include "apps/studies/cost/metrics.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "apps/studies/cost/comparison.h"
#include "apps/studies/cost/felt_metrics.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/manifest.h"

namespace presa::cost {
namespace {

Eigen::Vector3d vectorOf(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

double distance(const double (&a)[3], const double (&b)[3]) {
  return (Eigen::Vector3d::Map(a) - Eigen::Vector3d::Map(b)).norm();
}

Value difference(const Value& a, const Value& b, double unit = 1) {
  return a && b ? Value(unit * std::abs(*a - *b)) : std::nullopt;
}
Value scaled(const Value& a, double unit) { return a ? Value(unit * *a) : std::nullopt; }

/// RMS difference of the forces that the devices hold, at every tick of the reference, of the worst finger. A setting
/// with a slow rate holds old forces. A study asks this of each tick of its reference for each setting: no square root.
template <bool kInSteps>
Value held(const Evidence& s, const Evidence& r) {
  const Trace &a = s.trace, &b = r.trace;
  if (a.fingers != b.fingers || a.held_from_ns.empty()) return std::nullopt;
  const std::int64_t from = std::llround(1e9 * s.compared_from), to = std::llround(1e9 * s.compared_to);
  const std::size_t n = a.fingers;
  const auto first = static_cast<std::size_t>(std::ranges::lower_bound(b.held_from_ns, from) - b.held_from_ns.begin());
  std::vector<Sum> sums(n);
  for (std::size_t f = 0; f < n; ++f) {
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0, j = first; i < a.held_from_ns.size(); ++i) {
      const bool last = i + 1 == a.held_from_ns.size();
      const std::int64_t until = last ? to : std::min(to, a.held_from_ns[i + 1]);
      const Eigen::Vector3d force = vectorOf(a.held[i * n + f]);
      for (; j < b.held_from_ns.size() && b.held_from_ns[j] < until; ++j) {
        const Eigen::Vector3d right = vectorOf(b.held[j * n + f]);
        const double difference = (force - right).squaredNorm(), square = right.squaredNorm();
        count += difference + square > 0 ? 1 : 0;  // 0: no contact in either run
        squares +=
            kInSteps ? difference / (kForceStep * kForceStep * std::max(square, kMinForce * kMinForce)) : difference;
      }
    }
    sums[f] = {squares, 0, count};
  }
  return worstOf(sums, &Sum::rms);
}

/// RMS over all free bodies and the instants at the end of a dynamics step of the setting; poses between them are
/// interpolated.
template <class Error>
Value bodies(const Evidence& s, const Evidence& r, const Error& error) {
  Sum sum;
  const std::size_t n = s.trace.bodies;
  if (n != r.trace.bodies) return std::nullopt;
  atCommonTimes(s, r, [&](std::size_t i, std::size_t j) {
    if (s.trace.stepped[i] == 0) return;
    for (std::size_t k = 0; k < n; ++k) sum.add(error(s.trace.body[i * n + k], r.trace.body[j * n + k]));
  });
  return sum.rms();
}

// while one of the two touches
Value forceError(const FingerSample& a, const FingerSample& b) {
  return a.touching > 0 || b.touching > 0 ? Value(distance(a.force, b.force)) : std::nullopt;
}
Value forceSteps(const FingerSample& a, const FingerSample& b) {
  const double force = std::hypot(b.force[0], b.force[1], b.force[2]);
  return scaled(forceError(a, b), 1 / (kForceStep * std::max(force, kMinForce)));
}
Value proxyError(const FingerSample& a, const FingerSample& b) {
  return a.touching > 0 && b.touching > 0 ? Value(1e3 * distance(a.proxy, b.proxy)) : std::nullopt;
}
double positionError(const BodySample& a, const BodySample& b) { return 1e3 * distance(a.p, b.p); }
double angleError(const BodySample& a, const BodySample& b) {
  // |q_a - (± q_b)| = 2 sin(angle / 4): accurate for small angles, which the scalar product would lose to rounding
  double minus = 0, plus = 0;
  for (int k = 0; k < 4; ++k) {
    minus += (a.q[k] - b.q[k]) * (a.q[k] - b.q[k]);
    plus += (a.q[k] + b.q[k]) * (a.q[k] + b.q[k]);
  }
  return 4 * std::asin(std::min(1.0, 0.5 * std::sqrt(std::min(minus, plus)))) * 180 / M_PI;
}

/// Mean normal force [N] of each finger in the steady window while in contact; -1: no contact.
std::vector<double> grips(const Evidence& e) {
  std::vector<double> sum(e.trace.fingers, 0), count(e.trace.fingers, 0);
  for (std::size_t i = 0; i < e.trace.time_ns.size(); ++i) {
    const double time = static_cast<double>(e.trace.time_ns[i]) * 1e-9;
    if (time < e.steady_from || time >= e.steady_to) continue;
    for (std::size_t f = 0; f < e.trace.fingers; ++f) {
      const FingerSample& sample = e.trace.finger[i * e.trace.fingers + f];
      sum[f] += sample.touching * sample.normal_force;
      count[f] += sample.touching;
    }
  }
  for (std::size_t f = 0; f < sum.size(); ++f) sum[f] = count[f] > 0 ? sum[f] / count[f] : -1;
  return sum;
}

Value gripError(const Evidence& s, const Evidence& r) {
  const std::vector<double> a = grips(s), b = grips(r);
  Value worst;
  for (std::size_t f = 0; f < a.size() && f < b.size(); ++f) {
    if (a[f] >= 0 && b[f] >= 0) worst = std::max(worst.value_or(0), std::abs(a[f] - b[f]));
  }
  return worst;
}

/// Just-noticeable difference [N]: a tenth of the reference's force, RMS over contact.
Value forceNoticeable(const Evidence& r) {
  Sum worst;
  for (const FingerSample& sample : r.trace.finger) {
    if (sample.touching > 0) worst.add(std::hypot(sample.force[0], sample.force[1], sample.force[2]));
  }
  return scaled(worst.rms(), kForceStep);
}
Value gripNoticeable(const Evidence& r) {
  double min = -1;
  for (const double grip : grips(r)) {
    if (grip > 0) min = min < 0 ? grip : std::min(min, grip);
  }
  return min > 0 ? Value(kForceStep * std::max(min, kMinForce)) : std::nullopt;
}
Value slipNoticeable(const Evidence& r) {
  return r.slip_force ? Value(kForceStep * std::max(*r.slip_force, kMinForce)) : std::nullopt;
}
Value oneStep(const Evidence&) { return 1; }
// just-noticeable difference of pinch aperture without vision [mm] [Ho1996]
Value apertureNoticeable(const Evidence&) { return 0.4; }
Value none(const Evidence&) { return std::nullopt; }

}  // namespace

const std::vector<Metric>& ownMetrics() {
  static const std::vector<Metric> metrics{
      {"force_rms", "Force, RMS error", "N",
       "root of the mean square of |force − reference| of the worst finger, while one of the two touches",
       [](const Evidence& s, const Evidence& r) {
         return worstFinger(
             s, r, [](const auto& a, const auto& b) { return forceError(a, b); }, &Sum::rms);
       },
       false, forceNoticeable},
      {"force_peak", "Force, largest error", "N", "largest |force − reference| of any finger",
       [](const Evidence& s, const Evidence& r) {
         return worstFinger(
             s, r, [](const auto& a, const auto& b) { return forceError(a, b); }, &Sum::peak);
       },
       false, forceNoticeable},
      {"force_rms_jnd", "Force, RMS error in just-noticeable steps", "steps",
       "as force_rms, each difference in tenths of the reference's force at that moment (of 0.5 N below that)",
       [](const Evidence& s, const Evidence& r) {
         return worstFinger(
             s, r, [](const auto& a, const auto& b) { return forceSteps(a, b); }, &Sum::rms);
       },
       false, oneStep},
      {"force_peak_jnd", "Force, largest error in just-noticeable steps", "steps",
       "as force_peak, in tenths of the reference's force at that moment (of 0.5 N below that)",
       [](const Evidence& s, const Evidence& r) {
         return worstFinger(
             s, r, [](const auto& a, const auto& b) { return forceSteps(a, b); }, &Sum::peak);
       },
       false, oneStep},
      {"force_held", "Force as held, RMS error", "N",
       "root of the mean square of |force that the device holds − reference| over all time, between the ticks too; "
       "worst "
       "finger",
       held<false>, false, forceNoticeable},
      {"force_held_jnd", "Force as held, RMS error in just-noticeable steps", "steps",
       "as force_held, in tenths of the reference's force at that moment (of 0.5 N below that)", held<true>, false,
       oneStep},
      {"torque", "Torque, RMS error", "mN m",
       "root of the mean square of |torque − reference| of the worst finger, while one of the two touches; for "
       "oriented "
       "tools",
       torqueError, false, none},
      {"stiffness", "Stiffness as felt, RMS error", "%",
       "felt force over the distance from finger to proxy, against the reference's, while both are pressed in by 0.05 "
       "mm "
       "or "
       "more; worst finger",
       stiffnessError, false, [](const Evidence&) -> Value { return kStiffnessStep; }},
      {"friction", "Friction as felt, RMS error", "%",
       "tangential over normal force, against the reference's, while the reference slips and both touch; worst finger",
       frictionError, false, [](const Evidence&) -> Value { return kFrictionStep; }},
      {"texture", "Texture, error of its vibration", "N",
       "the held force from 40 to 400 Hz: its RMS, less the reference's; worst finger", textureError, false,
       textureNoticeable},
      {"proxy", "Proxy, RMS error", "mm", "distance of the proxy from the reference's, while both touch; worst finger",
       [](const Evidence& s, const Evidence& r) {
         return worstFinger(
             s, r, [](const auto& a, const auto& b) { return proxyError(a, b); }, &Sum::rms);
       },
       false, apertureNoticeable},
      {"position", "Object position, RMS error", "mm", "distance of the free bodies' origins from the reference's",
       [](const Evidence& s, const Evidence& r) { return bodies(s, r, positionError); }, false, apertureNoticeable},
      {"angle", "Object orientation, RMS error", "deg", "angle between the free bodies and the reference's",
       [](const Evidence& s, const Evidence& r) { return bodies(s, r, angleError); }, false, none},
      {"grip", "Grip force, error of the mean", "N", "mean normal force in the steady window; worst finger", gripError,
       false, gripNoticeable},
      {"slip_force", "Slip onset, force error", "N",
       "grip force at the first slip after letting go began; mean of the fingers",
       [](const Evidence& s, const Evidence& r) { return difference(s.slip_force, r.slip_force); }, false,
       slipNoticeable},
      {"slip_time", "Slip onset, time error", "ms",
       "time of the first slip after letting go began; mean of the fingers",
       [](const Evidence& s, const Evidence& r) { return difference(s.slip_time, r.slip_time, 1e3); }, false, none},
      {"energy_created", "Energy created", "mJ",
       "largest rise of (energy − work of the hands) from any earlier moment; a passive simulation has 0",
       [](const Evidence& s, const Evidence&) { return scaled(s.energy_created, 1e3); }, true, none},
      {"energy_drift", "Energy drift", "mJ",
       "largest |energy − work of the hands − energy at the start|; for scenes without fingers",
       [](const Evidence& s, const Evidence&) { return scaled(s.energy_drift, 1e3); }, true, none},
      {"penetration", "Overlap of boxes at rest", "mm",
       "mean overlap of the pairs of boxes that overlap, in the steady window; from poses and sizes, whatever the "
       "engine",
       [](const Evidence& s, const Evidence&) { return scaled(s.penetration, 1e3); }, true, none},
      {"penetration_max", "Deepest overlap of boxes", "mm", "of any pair of boxes in the whole compared window",
       [](const Evidence& s, const Evidence&) { return scaled(s.penetration_max, 1e3); }, true, none},
      {"rest_energy", "Kinetic energy at rest", "mJ",
       "of all free bodies, mean over the steady window, from the change of their poses; for scenes without fingers",
       [](const Evidence& s, const Evidence&) { return scaled(s.rest_energy, 1e3); }, true, none},
      {"rest_drift", "Drift at rest", "mm",
       "largest displacement of any body during the steady window; for scenes without fingers",
       [](const Evidence& s, const Evidence&) { return scaled(s.rest_drift, 1e3); }, true, none},
      {"joint_gap", "Opening of joints, distance", "mm",
       "largest distance by which any joint is open in the directions that it locks; for scenes with joints",
       [](const Evidence& s, const Evidence&) { return scaled(s.joint_gap, 1e3); }, true, none},
      {"joint_tilt", "Opening of joints, angle", "deg",
       "largest angle by which any joint is open in the directions that it locks; for scenes with joints",
       [](const Evidence& s, const Evidence&) { return scaled(s.joint_tilt, 180 / M_PI); }, true, none},
      {"force_step", "Force step at dynamics boundaries", "N",
       "bend of the normal force (second difference) at ticks that bring a new object state; RMS in the steady window, "
       "worst finger",
       [](const Evidence& s, const Evidence&) { return s.force_step; }, true, none},
      {"hum", "Hum at the dynamics rate", "N",
       "amplitude of the force at the dynamics rate while touching, worst finger; none where the haptic rate is too "
       "low "
       "to carry it",
       [](const Evidence& s, const Evidence&) { return s.hum; }, true, none},
  };
  return metrics;
}

const Metric* findMetric(const std::string& name) {
  const auto own = std::ranges::find(ownMetrics(), name, &Metric::name);
  if (own != ownMetrics().end()) return &*own;
  const Manifest* manifest = findManifest(name);
  if (manifest == nullptr || manifest->kind != PluginKind::kMetric) return nullptr;
  static std::map<std::string, Metric> loaded;
  const auto known = loaded.find(name);
  if (known != loaded.end()) return &known->second;
  Metric metric = pluginTable<MetricPlugin>(name, "presaMetricPlugin").metric;
  if (metric.error == nullptr)
    refuse(596, manifest->file, "metric '" + name + "' computes no error", "report this to the author of the plug-in");
  metric.name = name;
  if (metric.noticeable == nullptr) metric.noticeable = none;
  return &loaded.emplace(name, std::move(metric)).first->second;
}

std::vector<std::string> metricNames() {
  std::vector<std::string> names;
  for (const Metric& metric : ownMetrics()) names.push_back(metric.name);
  for (const Manifest& manifest : manifests())
    if (manifest.kind == PluginKind::kMetric) names.push_back(manifest.name);
  return names;
}

}  // namespace presa::cost
