#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace presa::subject {

/// Digits in order: thumb, index. The hand lives in a plane: q, the way of a digit along the grip, grows inwards (0 where
/// it met the object); y is up. Coordinates of the hand, not of the object.
inline constexpr int kDigits = 2;

/// What one digit feels.
struct DigitSenses {
  double q = 0;       ///< own position along the grip, inwards [m]
  double y = 0;       ///< own height [m]
  double v_y = 0;     ///< its rate [m/s]
  double normal = 0;  ///< force that pushes it outwards, >= 0; 0: touches nothing [N]
  double load = 0;    ///< weight it carries: force that pulls it down [N]
};

/// What is SEEN of the object: with the eyes, not with the fingers.
struct Sight {
  bool object = false;   ///< the object is in view; the rest holds only then
  double height = 0;     ///< of the object above the mean height of the digits [m]
  double aside = 0;      ///< of the object along the grip, in the thumb's direction, in the hand's coordinates [m]
  bool sliding = false;  ///< it moves against a digit that touches it
};

/// All that a brain learns about the world, once a tick.
struct Senses {
  std::array<DigitSenses, kDigits> digits;
  double effort = 0;  ///< lift force commanded per digit, the sense of effort [N]
  Sight sight;
};

/// What the brain wants of its hand until the next tick.
struct Intent {
  double grip = 0;             ///< force of each digit inwards [N]
  double gain = 1;             ///< on it: an equilibrium-point hand pushes against its own stiffness too
  double height = 0;           ///< of the fingers [m]
  double height_rate = 0;      ///< at which a wrong height is corrected by force; 0: as it is [1/s]
  bool reaching = false;       ///< position instead of force along the grip: q goes to `reach`
  double reach = 0;            ///< [m]
  double aside = 0;            ///< middle of the hand along the grip, in the thumb's direction [m]
  bool take_up_again = false;  ///< this tick the object is picked up anew
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
