#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

/// Numbers in the compact form that the page's script reads (replay_data.js).
namespace presa::replay_page {

/// Bytes of whole numbers, little-endian, as base64.
std::string packedBytes(const std::vector<std::uint8_t>& values);
std::string packedBytes(const std::vector<std::uint16_t>& values);
std::string packedBytes(const std::vector<std::uint32_t>& values);

/// Values as 65 535 levels between their min and max: {lo, step, d}, where d is base64 of int16; a value that is not
/// finite becomes -32768. The error is at most half a step. Values that are all the same give {lo} alone.
nlohmann::json packed(const std::vector<double>& values);

/// Intervals of equal length that cover all ticks of a recording.
struct Bins {
  double begin = 0, width = 0;  ///< [s]
  std::size_t count = 0;
  bool every_tick = false;  ///< one tick a bin: nothing is lost
  std::size_t indexOf(double time) const;
};
/// At most `most` bins, none shorter than a tick of `period`.
Bins binsOf(const std::vector<double>& time, double period, std::size_t most);

/// Min and max of a signal in each bin, so that an oscillation faster than the bins keeps its amplitude:
/// {low, high}, or {low} with one tick a bin. Bins without a tick have no value.
nlohmann::json envelope(const std::vector<double>& time, const std::vector<double>& values, const Bins& bins);

/// Base64 of a byte for each bin: bit k is set when the state was k in it.
std::string statesIn(const std::vector<double>& time, const std::vector<double>& states, const Bins& bins);

}  // namespace presa::replay_page
