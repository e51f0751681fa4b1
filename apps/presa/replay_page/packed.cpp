#include "apps/presa/replay_page/packed.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/common/report/base64.h"

namespace presa::replay_page {
namespace {

template <class Whole>
std::string littleEndian(const std::vector<Whole>& values) {
  std::string bytes;
  bytes.reserve(values.size() * sizeof(Whole));
  for (const Whole value : values) {
    for (std::size_t i = 0; i < sizeof(Whole); ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  }
  return base64(bytes);
}

constexpr double kLevels = 65534, kMiddle = 32767;
constexpr std::uint16_t kNothing = 0x8000;  // -32768

}  // namespace

std::string packedBytes(const std::vector<std::uint8_t>& values) { return littleEndian(values); }
std::string packedBytes(const std::vector<std::uint16_t>& values) { return littleEndian(values); }
std::string packedBytes(const std::vector<std::uint32_t>& values) { return littleEndian(values); }

nlohmann::json packed(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  bool whole = true;
  for (const double value : values) {
    whole = whole && std::isfinite(value);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high)) low = high = 0;  // nothing is finite
  if (whole && low == high) return {{"lo", low}};
  // a range beyond the largest number has no step; so has one number alone
  const double step = high > low && std::isfinite(high - low) ? (high - low) / kLevels : 1;
  std::vector<std::uint16_t> levels;
  levels.reserve(values.size());
  for (const double value : values) {
    const double level = std::clamp(std::round((value - low) / step), 0.0, kLevels) - kMiddle;
    levels.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(static_cast<std::int16_t>(level)) : kNothing);
  }
  return {{"lo", low}, {"step", step}, {"d", packedBytes(levels)}};
}

std::size_t Bins::indexOf(double time) const {
  const double bin = std::floor((time - begin) / width + 1e-6);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(count - 1)));
}

Bins binsOf(const std::vector<double>& time, double period, std::size_t most) {
  const double length = time.back() - time.front() + period;
  const auto ticks = static_cast<std::size_t>(std::llround(std::max(1.0, length / period)));
  const bool every_tick = ticks <= most;
  const std::size_t count = every_tick ? ticks : most;
  return {time.front(), every_tick ? period : length / static_cast<double>(count), count, every_tick};
}

nlohmann::json envelope(const std::vector<double>& time, const std::vector<double>& values, const Bins& bins) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> low(bins.count, nothing), high(bins.count, nothing);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const std::size_t bin = bins.indexOf(time[i]);
    low[bin] = std::fmin(low[bin], values[i]);
    high[bin] = std::fmax(high[bin], values[i]);
  }
  nlohmann::json packed_bins{{"low", packed(low)}};
  if (!bins.every_tick) packed_bins["high"] = packed(high);
  return packed_bins;
}

std::string statesIn(const std::vector<double>& time, const std::vector<double>& states, const Bins& bins) {
  std::vector<std::uint8_t> seen(bins.count, 0);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (states[i] >= 0 && states[i] < 8)
      seen[bins.indexOf(time[i])] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(states[i]));
  }
  return packedBytes(seen);
}

}  // namespace presa::replay_page
