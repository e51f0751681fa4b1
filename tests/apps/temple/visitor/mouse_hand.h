#pragma once
#include <array>

#include "framework/core/math/random.h"
#include "modules/view_osg/pointer_control.h"

namespace presa::temple::test {

/// How a person's hand moves a mouse. Drawn once per visitor.
struct HandTraits {
  double overshoot = 0.08;  ///< mean part of a movement by which it goes too far
  double scatter = 0.10;    ///< standard deviation of that part
  double tremor = 0.0015;   ///< amplitude in the scene [m]
  double tremor_hz = 10;    ///< physiological tremor: 8 to 12 Hz
};
HandTraits drawHand(RandomStream& random);

/// A hand on mouse, wheel and keys that moves a PointerControl as a person's does: drags follow minimum-jerk profiles
/// that last as Fitts' law says, overshoot, tremble and come in whole pixels; notches and keys come one by one. One
/// action at a time.
class MouseHand {
 public:
  MouseHand(const HandTraits& traits, RandomStream& random) : traits_(traits), random_(random) {}

  /// A drag that should move the pair by `way` in W: level, or with Shift in the upright plane.
  void drag(const Vec3& way, bool upright, const view::PointerControl& pointer, const view::CameraControl& camera);
  /// Wheel notches (negative: backwards).
  void scroll(int notches);
  /// Keys q (positive) or e.
  void turn(int keys);
  bool busy() const { return left_ > 0 || notches_ != 0 || keys_ != 0; }
  /// One step of `period` [s].
  void step(double period, view::PointerControl& pointer, const view::CameraControl& camera);

 private:
  HandTraits traits_;
  RandomStream& random_;
  std::array<double, 2> wanted_{}, sent_{};  // of the drag in halves of the picture's height; sent: whole pixels
  double shake_ = 0;                         // tremor in the same unit
  double lasts_ = 0, left_ = 0;              // of the drag [s]
  double clock_ = 0, next_ = 0;              // [s], of the notches and keys
  bool upright_ = false;
  int notches_ = 0, keys_ = 0;
};

}  // namespace presa::temple::test
