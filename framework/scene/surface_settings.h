#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace presa {

/// What commands have asked the surfaces to be: of each open parameter (openSurfaces) the last value, none before the
/// first. Whole state, so that a reader who misses one sees the next. Only where a run takes commands.
struct SurfaceSettings {
  static constexpr std::size_t kCapacity = 96;  ///< open parameters of one scene at the most
  /// The last change of one parameter.
  struct Slot {
    std::uint64_t number = 0;  ///< of the change, counted over all slots from 1; 0: as loaded
    double value = 0;          ///< asked for, in the unit of the parameter
  };
  std::uint64_t newest = 0;             ///< the highest number
  std::array<Slot, kCapacity> slots{};  ///< as openSurfaces
};

/// Takes the changes one after another, one a tick: every reader that steps in the same ticks takes the same.
class SettingsTaker {
 public:
  static constexpr std::size_t kNone = SurfaceSettings::kCapacity;  ///< no change is left
  /// The slot whose change is next, or kNone. Nonblocking.
  std::size_t next(const SurfaceSettings& settings) noexcept {
    if (settings.newest == taken_) return kNone;
    std::size_t first = kNone;
    for (std::size_t s = 0; s < settings.slots.size(); ++s) {
      const std::uint64_t number = settings.slots[s].number;
      if (number > taken_ && (first == kNone || number < settings.slots[first].number)) first = s;
    }
    taken_ = first == kNone ? settings.newest : settings.slots[first].number;
    return first;
  }

 private:
  std::uint64_t taken_ = 0;
};

}  // namespace presa
