#pragma once

namespace presa {

/// Part of a movement done after part s of its time: the smoothest from rest to rest [Flash & Hogan 1985].
inline double minimumJerk(double s) noexcept { return s <= 0 ? 0 : s >= 1 ? 1 : s * s * s * (10 + s * (-15 + 6 * s)); }
inline double minimumJerkSlope(double s) noexcept { return s <= 0 || s >= 1 ? 0 : 30 * s * s * (1 - s) * (1 - s); }

}  // namespace presa
