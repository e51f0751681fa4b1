#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace presa {

/// What a phase of a scripted motion is for. The name of a phase is its author's own word: nothing interprets it.
/// Reports judge a run by intents: figures of a hold need kHold, and only an object that was lost before the first
/// kRelease counts as dropped.
enum class PhaseIntent : std::uint8_t { kNone, kLift, kHold, kRelease };

/// As motion files spell them, indexed by PhaseIntent.
inline constexpr std::array<std::string_view, 4> kPhaseIntentNames{"none", "lift", "hold", "release"};

/// The intent of that name; none for another word.
inline std::optional<PhaseIntent> phaseIntentOf(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kPhaseIntentNames.size(); ++i) {
    if (kPhaseIntentNames[i] == name) return static_cast<PhaseIntent>(i);
  }
  return std::nullopt;
}

/// A phase, or several in a row that have one intent.
struct PhaseSpan {
  double begin = 0,  ///< [s]
      end = 0;       ///< [s]
};

/// The first phase with this intent, with those of the same intent that follow it directly; none if there is none.
/// `times`: the start of each phase, then the end of the last one [s].
inline std::optional<PhaseSpan> firstSpanOf(PhaseIntent intent, const std::vector<PhaseIntent>& intents,
                                            const std::vector<double>& times) {
  for (std::size_t i = 0; i < intents.size() && i + 1 < times.size(); ++i) {
    if (intents[i] != intent) continue;
    std::size_t last = i;
    while (last + 2 < times.size() && last + 1 < intents.size() && intents[last + 1] == intent) ++last;
    return PhaseSpan{times[i], times[last + 1]};
  }
  return std::nullopt;
}

}  // namespace presa
