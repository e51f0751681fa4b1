#include "apps/experiment/export/motion.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "apps/experiment/export/cells.h"

namespace presa::experiment {
namespace {

constexpr const char* kAxes = "xyz";

/// Appends the shortest text that reads back as the same float.
void append(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += kNothing;
    return;
  }
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(value));
  text.append(digits.data(), end.ptr);
}

std::vector<double> lengths(const RecordedTable& table, const std::string& vector) {
  const auto &x = table.values(vector + "_x"), &y = table.values(vector + "_y"), &z = table.values(vector + "_z");
  std::vector<double> all(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) all[i] = std::hypot(x[i], y[i], z[i]);
  return all;
}

/// Replaces the values of ticks without a device sample by NaN.
std::vector<double> whereValid(std::vector<double> values, const std::vector<double>& valid) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (valid[i] != 1) values[i] = NAN;
  }
  return values;
}

}  // namespace

Motion::Motion(const RecordedSamples& samples) : samples_(samples) {
  std::vector<double> latency = samples.time;
  for (double& time : latency) time -= begin();
  add({"latency", kNothing, "LATENCY", kNothing, "s", "time since the first row"}, std::move(latency));
  for (const RecordedTable& finger : samples.fingers) addFinger(finger);
  for (const RecordedTable& body : samples.bodies) addBody(body);
}

void Motion::add(Channel channel, std::vector<double> values) {
  channels_.push_back(std::move(channel));
  values_.push_back(std::move(values));
}

void Motion::addFinger(const RecordedTable& finger) {
  const std::string& who = finger.name;
  const auto& valid = finger.values("valid");
  for (const char* axis = kAxes; *axis != '\0'; ++axis) {
    const std::string a(1, *axis);
    add({who + "_pos_" + a, a, "POS", who, "m", "haptic interface point: the fingertip"},
        whereValid(finger.values("p_WH_" + a), valid));
  }
  for (const char* axis = kAxes; *axis != '\0'; ++axis) {
    const std::string a(1, *axis);
    add({who + "_force_" + a, a, "MISC", who, "N", "force on the finger that was sent to the device"},
        finger.values("f_command_W_" + a));
  }
  add({who + "_fn", kNothing, "MISC", who, "N", "contact force along the surface normal, positive into the finger"},
      finger.values("normal_force"));
  add({who + "_ft", kNothing, "MISC", who, "N", "contact force across the normal, its magnitude"},
      lengths(finger, "tangential_force_W"));
  add({who + "_depth", kNothing, "MISC", who, "m", "penetration into the surface"}, finger.values("depth"));
  add({who + "_contact", kNothing, "MISC", who, kNothing, "0 none, 1 sticking, 2 slipping"}, finger.values("mode"));
  ++tracked_points_;
}

void Motion::addBody(const RecordedTable& body) {
  for (const char* axis = kAxes; *axis != '\0'; ++axis) {
    const std::string a(1, *axis);
    add({body.name + "_pos_" + a, a, "POS", body.name, "m", "origin of the body's frame"}, body.values("p_WB_" + a));
  }
  for (const char* part : {"w", "x", "y", "z"}) {
    const std::string p(part);
    add({body.name + "_quat_" + p, "quat_" + p, "ORNT", body.name, kNothing, "unit quaternion, body to world"},
        body.values("q_WB_" + p));
  }
  ++tracked_points_;
}

std::size_t Motion::count(const std::string& type) const {
  return static_cast<std::size_t>(
      std::count_if(channels_.begin(), channels_.end(), [&](const Channel& one) { return one.type == type; }));
}

std::vector<std::size_t> Motion::ticksAt(double rate) const {
  std::vector<std::size_t> ticks;
  const double slack = 1e-6 * samples_.haptic_period;  // times are sums of periods, with rounding errors
  std::size_t tick = 0;
  for (std::size_t k = 0;; ++k) {
    const double time = begin() + static_cast<double>(k) / rate;
    if (time > samples_.time.back() + slack) return ticks;
    while (tick + 1 < samples_.time.size() && samples_.time[tick + 1] <= time + slack) ++tick;
    if (ticks.empty() || ticks.back() != tick) ticks.push_back(tick);
  }
}

std::string Motion::rows(char separator, const std::vector<std::size_t>& ticks) const {
  const std::size_t n = ticks.empty() ? samples_.time.size() : ticks.size();
  std::string text;
  text.reserve(n * channels_.size() * 10);
  std::array<char, 32> time{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t tick = ticks.empty() ? i : ticks[i];
    // time alone needs more digits than single precision has
    text.append(time.data(),
                static_cast<std::size_t>(std::snprintf(time.data(), time.size(), "%.6f", values_[0][tick])));
    for (std::size_t c = 1; c < channels_.size(); ++c) {
      text += separator;
      append(text, values_[c][tick]);
    }
    text += '\n';
  }
  return text;
}

}  // namespace presa::experiment
