#include "modules/collision_fcl/facet_set.h"

#include <algorithm>

namespace presa {
namespace {

constexpr std::size_t kBits = 64;

}  // namespace

FacetSet::FacetSet(std::size_t count) {
  all_.reserve(count);
  do {
    count = (count + kBits - 1) / kBits;
    levels_.emplace_back(count, 0);
  } while (count > 1);
}

void FacetSet::clear() noexcept {
  if (all_.size() >= levels_[0].size()) {
    for (auto& level : levels_) std::ranges::fill(level, 0);
  } else {
    for (const std::int32_t facet : all_) {
      auto i = static_cast<std::size_t>(facet);
      for (auto& level : levels_) level[i /= kBits] = 0;
    }
  }
  all_.clear();
}

void FacetSet::add(std::int32_t facet) noexcept {
  auto i = static_cast<std::size_t>(facet);
  if (has(facet)) return;
  all_.push_back(facet);
  for (auto& level : levels_) {
    const std::uint64_t bit = std::uint64_t{1} << (i % kBits);
    std::uint64_t& word = level[i /= kBits];
    if ((word & bit) != 0) return;
    word |= bit;
  }
}

bool FacetSet::has(std::int32_t facet) const noexcept {
  const auto i = static_cast<std::size_t>(facet);
  return (levels_[0][i / kBits] >> (i % kBits) & 1U) != 0;
}

bool FacetSet::hasAny(std::int32_t begin, std::int32_t end) const noexcept {
  auto i = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(end) - 1;  // both inclusive
  if (begin >= end) return false;
  for (const auto& level : levels_) {
    const std::uint64_t from = ~std::uint64_t{0} << (i % kBits),
                        up_to = ~std::uint64_t{0} >> (kBits - 1 - last % kBits);
    i /= kBits;
    last /= kBits;
    if (i == last) return (level[i] & from & up_to) != 0;
    if ((level[i] & from) != 0 || (level[last] & up_to) != 0) return true;
    // the words between them, as bits of the next level
    ++i;
    --last;
    if (i > last) return false;
  }
  return false;
}

}  // namespace presa
