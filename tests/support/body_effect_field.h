#pragma once
#include <memory>
#include <string>

#include "framework/haptics/body_effect.h"

namespace presa::test {

/// One body effect on a free cube, without a run: its wrench at any place and speed. The element is read like any
/// scene's, with the plug-in's manifest:
///
///     BodyEffectField field("<drag max_force=\"2\" linear=\"0.5\"/>");
///     EXPECT_LT(field.at({.v_WCm = Vec3(1, 0, 0)}).f_W.x(), 0);
///
/// The cube has 70 mm and 0.2 kg; gravity is 9.81 m/s^2 downwards.
class BodyEffectField {
 public:
  /// Throws InputError with every finding.
  explicit BodyEffectField(const std::string& element);
  ~BodyEffectField();

  /// The wrench at this state; `body`, `step`, mass, inertia and gravity are those of the cube. Zero after the effect
  /// broke its contract. Nonblocking if the effect is: put a RealTimeGuard around it.
  BodyEffectWrench at(BodyEffectInput state) noexcept;
  bool broken() const noexcept;  ///< the effect broke its contract

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
