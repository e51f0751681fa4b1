#pragma once
#include <cstddef>
#include <string>

namespace presa::cluster {

/// One of `count` parts of a piece of work, each made by a process of its own, perhaps on another machine.
struct Shard {
  int index = 1, count = 1;  ///< 1 <= index <= count
  /// Whether it makes that item of the work, counted from 0.
  bool holds(std::size_t i) const { return i % static_cast<std::size_t>(count) + 1 == static_cast<std::size_t>(index); }
};

/// "" for I/N with 1 <= I <= N, else what is wrong.
std::string shardTrouble(const std::string& text);
/// Of a text without trouble.
Shard shardFrom(const std::string& text);
/// "2/8"
std::string textOf(const Shard& shard);

}  // namespace presa::cluster
