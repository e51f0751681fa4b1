#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace presa::subject {

/// Digits in order: thumb, index. The hand moves in a plane: q is the position of a digit along the grip, positive
/// inwards (0 at the first contact with the object); y is up. Coordinates of the hand, not of the object.
inline constexpr int kDigits = 2;

/// The senses of one digit.
struct DigitAfferents {
  double q = 0;       ///< own position along the grip, inwards [m]
  double y = 0;       ///< own height [m]
  double v_y = 0;     ///< its rate [m/s]
  double normal = 0;  ///< outward force on the digit, >= 0; 0: no contact [N]
  double load = 0;    ///< downward force on the digit: the weight it carries [N]
};

/// Vision of the object.
struct Sight {
  bool object = false;   ///< the object is in view; the other fields are valid only then
  double height = 0;     ///< of the object above the mean height of the digits [m]
  double aside = 0;      ///< of the object along the grip, in the thumb's direction, in the hand's coordinates [m]
  bool sliding = false;  ///< the object moves relative to a touching digit
};

/// All inputs of the brain, once per tick.
struct Afferents {
  std::array<DigitAfferents, kDigits> digits;
  double effort = 0;  ///< lift force commanded per digit, the sense of effort [N]
  Sight sight;
};

/// The brain's command to its hand until the next tick.
struct MotorCommand {
  double grip = 0;             ///< inward force of each digit [N]
  double gain = 1;             ///< factor on the grip: an equilibrium-point hand also pushes against its own stiffness
  double height = 0;           ///< of the fingers [m]
  double height_rate = 0;      ///< correction rate of a height error by force; 0: keep the force [1/s]
  bool reaching = false;       ///< position instead of force control along the grip: q goes to `reach`
  double reach = 0;            ///< [m]
  double aside = 0;            ///< middle of the hand along the grip, in the thumb's direction [m]
  bool take_up_again = false;  ///< true in the tick in which the object is picked up again
};

enum class Phase : std::uint8_t {
  kReach,
  kPreload,
  kLoad,
  kSettle,
  kLoosen,
  kRegrasp,
  kAdjust,
  kHold,
  kRelease,
  kDone
};
inline constexpr std::array<std::string_view, 10> kPhaseNames{"reach",   "preload", "load", "settle",  "loosen",
                                                              "regrasp", "adjust",  "hold", "release", "done"};

}  // namespace presa::subject
