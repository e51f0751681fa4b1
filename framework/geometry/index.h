#pragma once
#include <cstddef>
#include <cstdint>

namespace presa {

/// An index that is known not to be negative, for use with the standard containers.
inline std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace presa
