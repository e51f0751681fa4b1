#pragma once

namespace presa {

/// The first value in a plain build, the second under a sanitizer. For repetitions and seconds of endurance only:
/// sanitizers look for what a step does to memory and threads, which the first steps show as well as the last, and are
/// ten to fifty times slower. Whether a figure holds for a minute is for the release build to say.
template <typename T>
constexpr T unlessSanitized([[maybe_unused]] T plain, [[maybe_unused]] T sanitized) {
#ifdef PRESA_SANITIZE
  return sanitized;
#else
  return plain;
#endif
}

}  // namespace presa
