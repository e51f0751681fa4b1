#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <string_view>
#include <utility>

#include "framework/core/math/fnv.h"

namespace presa {

/// Random numbers that are the same on every machine: the standard fixes the raw output of std::mt19937_64, but not the
/// distributions and std::shuffle, which are therefore written out here. Each named stream is independent: drawing more
/// numbers from "stimulus noise" does not change those of "order".
class RandomStream {
 public:
  /// The same pair gives the same numbers.
  RandomStream(std::uint64_t seed, std::string_view name) : engine_(mix(seed ^ hashOf(name))) {}
  /// A stream of its own for one item of many, such as a subject or a trial.
  RandomStream(std::uint64_t seed, std::string_view name, std::uint64_t item)
      : engine_(mix(mix(seed ^ hashOf(name)) + item)) {}

  std::uint64_t bits() { return engine_(); }                                          ///< 64 raw bits
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }            ///< in [0, 1), 53 bits
  double uniform(double low, double high) { return low + (high - low) * uniform(); }  ///< from [low, high)
  /// In [0, count), each equally likely; count > 0.
  std::uint64_t below(std::uint64_t count) {
    const std::uint64_t unfair = (0 - count) % count;  // 2^64 mod count
    for (;;) {
      if (const std::uint64_t drawn = bits(); drawn >= unfair) return drawn % count;
    }
  }
  /// Mean 0, standard deviation 1 [Box & Muller 1958]; draws two raw numbers on every call.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// Log-normal: exp of a normal variable, with the given median.
  double logNormal(double median, double sd_of_log) { return median * std::exp(sd_of_log * normal()); }
  /// All orders are equally likely [Fisher & Yates].
  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t left = items.size(); left > 1; --left) std::swap(items[left - 1], items[below(left)]);
  }

 private:
  static std::uint64_t hashOf(std::string_view text) {
    Fnv1a hash;
    hash.add(text);
    return hash.value();
  }
  /// SplitMix64: neighbouring seeds give unrelated streams.
  static std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }

  std::mt19937_64 engine_;
};

}  // namespace presa
