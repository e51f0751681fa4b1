#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"
#include "framework/core/state/device_state.h"

namespace presa::test {

/// One force effect and one fingertip, without a run: its force at any place and speed. The element is read like any
/// scene's, with the plug-in's manifest:
///
///     EffectField field("<magnet max_force=\"2\"/>");
///     EXPECT_LT(field.force({0.01, 0, 0}).x(), 0);
///
/// An element of a body belongs to a free cube of 70 mm in W's origin, in the orientation of W.
class EffectField {
 public:
  /// Throws InputError with every finding.
  explicit EffectField(const std::string& element);
  ~EffectField();

  /// Force on a fingertip of radius 8 mm at p_WT [m] that moves with v_WT [m/s], in W [N]. NaN after the effect broke
  /// its contract (framework/haptics/force_effect.h).
  /// Nonblocking if the effect is: put a RealTimeGuard around it.
  Vec3 force(const Vec3& p_WT, const Vec3& v_WT = Vec3::Zero()) noexcept;
  /// Force and torque on a tool about its centre, for an effect that gives a torque. As force().
  Wrench wrench(const FingerInput& tool) noexcept;
  /// Impulse given to the cube by all calls of force() and wrench() so far, each of 1 ms [N s]. Zero for an effect of
  /// the scene.
  Vec3 impulse() const noexcept;
  /// The same about the cube's centre [N m s].
  Vec3 angularImpulse() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
