#pragma once

namespace presa {

/// Minimum-jerk movement from rest to rest [Flash & Hogan 1985]: fraction done, and its slope, at fraction s of time.
inline double minimumJerk(double s) noexcept { return s <= 0 ? 0 : s >= 1 ? 1 : s * s * s * (10 + s * (-15 + 6 * s)); }
/// Slope of minimumJerk over s.
inline double minimumJerkSlope(double s) noexcept { return s <= 0 || s >= 1 ? 0 : 30 * s * s * (1 - s) * (1 - s); }

}  // namespace presa
