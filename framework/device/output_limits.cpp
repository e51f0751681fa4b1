#include "framework/device/output_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "framework/device/device_modules.h"

namespace presa {
namespace {

enum OutputLimitsCode {
  kScenePastRating = 650,
  kRigPastRating = 651,
  kTooSlow = 652,
  kWatchdogTooLong = 653,
  kOverloadLimited = 654
};

template <class... Numbers>
std::string text(const char* pattern, const std::string& role, Numbers... numbers) {
  std::array<char, 320> line;
  std::snprintf(line.data(), line.size(), pattern, role.c_str(), numbers...);
  return line.data();
}

/// Clamps each limit of scene and rig to the rating and to the slowest allowed decay, and reports every change.
class Lowering {
 public:
  Lowering(const DeviceRole& wanted, const DeviceBinding& bound, const DeviceRating& rating,
           std::vector<std::string>& notes, Diagnostics& findings)
      : wanted_(wanted), bound_(bound), rating_(rating), notes_(notes), findings_(findings) {}

  FingerSafety safety() {
    FingerSafety safety;
    OutputLimits& limits = safety.limits;
    const DeviceBinding::Limits& allowed = bound_.limits;
    limits.force = force();
    limits.force_rate = forceRate(limits.force);
    limits.soft_start = std::max(allowed.soft_start.value_or(rating_.soft_start), rating_.soft_start);
    limits.continuous = allowedUpTo("continuous", allowed.continuous, rating_.continuous, "N");
    limits.heating_time = rating_.heating_time;
    limits.records_overload = recordsOverload();
    limits.speed = allowedUpTo("speed", allowed.speed, rating_.speed, "m/s");
    limits.passivity = allowed.passivity;
    if (rating_.torque > 0) boundTorque(limits);
    safety.watchdog = watchdog();
    noteWayDown(limits);
    return safety;
  }

 private:
  bool imagined() const { return rating_.behind == DeviceRating::Behind::kNothing; }

  double force() {
    const std::optional<double>& allowed = bound_.limits.force;
    const double usual = imagined() ? rating_.force : 0.5 * rating_.force;
    const double room = allowed ? allowedUpTo("force", allowed, rating_.force, "N") : usual;
    const double asked = wanted_.limits.force, force = std::min(asked, room);
    if (force < asked) {
      notes_.push_back(text("%s: forces up to %.3g N (the scene asks for %.3g, the device's nominal force is %.3g N)",
                            wanted_.role, force, asked, rating_.force));
      if (!allowed && room < rating_.force) notes_.back() += ": half of it unless the rig says <limits force=\"…\"/>";
    }
    return force;
  }

  double forceRate(double force) {
    const double asked = wanted_.limits.force_rate;
    if (asked > rating_.force_rate)
      findings_.warning(kScenePastRating, wanted_.where,
                        text("role '%s': force_rate is %.6g N/s, the device is rated for %.6g N/s; the rating is used",
                             wanted_.role, asked, rating_.force_rate));
    const double room = allowedUpTo("force_rate", bound_.limits.force_rate, rating_.force_rate, "N/s");
    const double rate = std::min(asked, room), slowest = force / DeviceRating::kSlowestDecay;
    if (room < std::min(asked, rating_.force_rate))
      notes_.push_back(text("%s: the force changes by up to %.4g N/s (the scene asks for %.4g, the rig allows %.4g)",
                            wanted_.role, std::max(rate, slowest), asked, room));
    if (rate >= slowest) return rate;
    const bool rigs = room < asked;
    findings_.warning(kTooSlow, rigs ? bound_.where : wanted_.where,
                      text("role '%s': force_rate %.6g N/s takes %.3g N to zero in %.4g ms, at most %.3g ms are "
                           "allowed; the force rate is raised to %.4g N/s",
                           wanted_.role, rate, force, 1e3 * force / rate, 1e3 * DeviceRating::kSlowestDecay, slowest),
                      "a lower force limit allows a lower force rate");
    return slowest;
  }

  /// As for the force, with the same rules and findings.
  void boundTorque(OutputLimits& limits) {
    const DeviceBinding::Limits& allowed = bound_.limits;
    const double usual = imagined() ? rating_.torque : 0.5 * rating_.torque;
    const double room = allowed.torque ? allowedUpTo("torque", allowed.torque, rating_.torque, "N m") : usual;
    const double asked = wanted_.limits.torque;
    limits.torque = std::min(asked, room);
    if (limits.torque < asked)
      notes_.push_back(text("%s: torques up to %.3g N m (the scene asks for %.3g, the device's nominal torque is %.3g)",
                            wanted_.role, limits.torque, asked, rating_.torque));
    const double slowest = limits.torque / DeviceRating::kSlowestDecay;
    const double rate = allowedUpTo("torque_rate", allowed.torque_rate, rating_.torque_rate, "N m/s");
    limits.torque_rate = std::max(std::min(rate, wanted_.limits.torque_rate), slowest);
    if (limits.torque_rate < wanted_.limits.torque_rate)
      notes_.push_back(text("%s: the torque changes by up to %.4g N m/s (the scene asks for %.4g)", wanted_.role,
                            limits.torque_rate, wanted_.limits.torque_rate));
    if (rate < slowest)
      findings_.warning(kTooSlow, bound_.where,
                        text("role '%s': torque_rate %.6g N m/s takes %.3g N m to zero in %.4g ms, at most %.3g ms are "
                             "allowed; the torque rate is raised to %.4g N m/s",
                             wanted_.role, rate, limits.torque, 1e3 * limits.torque / rate,
                             1e3 * DeviceRating::kSlowestDecay, slowest),
                        "a lower torque limit allows a lower torque rate");
    limits.continuous_torque =
        allowedUpTo("continuous_torque", allowed.continuous_torque, rating_.continuous_torque, "N m");
    limits.angular_speed = allowedUpTo("angular_speed", allowed.angular_speed, rating_.angular_speed, "rad/s");
  }

  double watchdog() {
    const double asked = wanted_.limits.watchdog_ms * 1e-3;
    if (asked <= rating_.watchdog) return asked;
    findings_.warning(kWatchdogTooLong, wanted_.where,
                      text("role '%s': watchdog_ms is %.6g, the device is rated for %.6g; the rating is used",
                           wanted_.role, wanted_.limits.watchdog_ms, 1e3 * rating_.watchdog));
    return rating_.watchdog;
  }

  /// The rig may tighten the rating but not widen it (W651).
  double allowedUpTo(const char* name, const std::optional<double>& allowed, double rated, const char* unit) {
    if (!allowed || *allowed <= rated) return allowed.value_or(rated);
    findings_.warning(kRigPastRating, bound_.where,
                      text("role '%s': the rig allows %s=\"%.6g\", the device is rated for %.6g %s; the rating is used",
                           wanted_.role, name, *allowed, rated, unit));
    return rated;
  }

  bool recordsOverload() {
    if (!bound_.limits.records_overload || rating_.behind != DeviceRating::Behind::kMotors)
      return bound_.limits.records_overload;
    findings_.warning(
        kOverloadLimited, bound_.where,
        text("role '%s': past_continuous=\"record\" is for models; real motors are limited", wanted_.role));
    return false;
  }

  void noteWayDown(const OutputLimits& limits) {
    const double down = limits.force / limits.force_rate;
    if (imagined() || down <= DeviceOutput::kSilentZero) return;
    notes_.push_back(
        text("%s: a change from %.3g N to zero takes %.1f ms at %.3g N/s, also when the device stops answering",
             wanted_.role, limits.force, 1e3 * down, limits.force_rate));
  }

  const DeviceRole& wanted_;
  const DeviceBinding& bound_;
  const DeviceRating& rating_;
  std::vector<std::string>& notes_;
  Diagnostics& findings_;
};

}  // namespace

OutputLimits limitsOf(const DeviceRating& rating) noexcept {
  OutputLimits limits;
  limits.force = rating.force;
  limits.force_rate = rating.force_rate;
  limits.soft_start = rating.soft_start;
  limits.continuous = rating.continuous;
  limits.heating_time = rating.heating_time;
  limits.speed = rating.speed;
  limits.torque = rating.torque;
  limits.torque_rate = rating.torque_rate;
  limits.continuous_torque = rating.continuous_torque;
  limits.angular_speed = rating.angular_speed;
  return limits;
}

FingerSafety safetyFor(const DeviceRole& wanted, const DeviceBinding& bound, const DeviceRating& rating,
                       std::vector<std::string>& notes, Diagnostics& findings) {
  return Lowering(wanted, bound, rating, notes, findings).safety();
}

}  // namespace presa
