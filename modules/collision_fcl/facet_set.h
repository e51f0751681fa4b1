#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace presa {

/// A set of facets of one mesh that answers at once whether it has any of a range: one bit for each facet, above it one
/// bit for each 64 of them, and so on. Thread: one; allocates at construction only.
class FacetSet {
 public:
  /// Room for the facets 0 to count - 1.
  explicit FacetSet(std::size_t count);

  void clear() noexcept;
  void add(std::int32_t facet) noexcept;
  bool has(std::int32_t facet) const noexcept;
  /// Whether the set has any facet of [begin, end).
  bool hasAny(std::int32_t begin, std::int32_t end) const noexcept;
  /// In the order in which they were added, each once.
  std::span<const std::int32_t> all() const noexcept { return all_; }

 private:
  std::vector<std::vector<std::uint64_t>> levels_;
  std::vector<std::int32_t> all_;
};

}  // namespace presa
