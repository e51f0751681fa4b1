#pragma once
#include <array>

#include "framework/haptics/convex_pairs.h"
#include "framework/haptics/nearest_feasible.h"

namespace presa {

/// Where a tool that is held off all bodies may go, in translation: its orientation is that of the handle. Each pass
/// moves it within the half-spaces of the planes between it and the parts of the bodies, which it cannot cross. Thread:
/// haptic; nonblocking.
class GodObject {
 public:
  /// Gap that stays between god-object and bodies, so that the shortest way between them keeps a direction; forces and
  /// depths do not see it [m].
  static constexpr double kSkin = 2e-6;

  explicit GodObject(ConvexPairs& pairs) : pairs_(pairs) {}

  /// Moves from `x` to the point nearest to `goal` that the bodies let it reach, in a bounded number of passes. The pairs
  /// listed must be all that come within twice the way, and are apart as at `x` when it ends. False: it is still on its
  /// way.
  bool slide(const Quat& q_WT, const Vec3& goal, Vec3& x) noexcept;

  /// How the bodies push the tool.
  struct Push {
    Vec3 shift = Vec3::Zero();  ///< from `goal` to the surface, without the skin [m]
    /// Of one plane.
    struct Part {
      Vec3 nhat_W = Vec3::UnitZ();  ///< unit, into the tool
      double depth = 0;             ///< its share of shift, along nhat_W [m]
    };
    std::array<Part, 3> parts;  ///< the first `count` are set
    int count = 0;              ///< 0: no contact
  };
  /// At x, where the last slide() ended.
  Push pushOn(const Vec3& goal, const Vec3& x) const noexcept;

  bool complete() const noexcept { return complete_; }  ///< since begin(), all planes counted in each pass
  void begin() noexcept { complete_ = true; }           ///< a tick

 private:
  HalfSpaces planesWithin(double within, double skin, bool& all) const noexcept;
  double deepest() const noexcept;

  ConvexPairs& pairs_;
  bool complete_ = true;
};

}  // namespace presa
