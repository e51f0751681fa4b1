#pragma once
#include <limits>
#include <optional>

#include "devices/simulated_subject/model/afferents.h"

namespace presa::subject {

/// Percepts computed from the senses at each tick. Felt unless marked as seen.
class Perception {
 public:
  explicit Perception(double period) : period_(period) {}
  void step(const Afferents& afferents) noexcept;

  /// Mean grip and load of the digits over the last 50 ms [N].
  double grip() const noexcept { return grip_; }
  double load() const noexcept { return load_; }
  /// Stiffness of the held object [N/m]: slope of grip over closing of the fingers during a light grip.
  double stiffness() const noexcept;
  /// Freezes the stiffness estimate.
  void keepStiffness() noexcept { learning_ = false; }

  /// Rise of the fingers above their mean height over the last 0.4 s [m]: they spring up when load leaves them.
  double kick() const noexcept { return kick_; }
  /// Resets that mean to the current height.
  void rest() noexcept { usual_height_ = height_; }
  /// Neither rising nor sinking, and no sliding seen.
  bool still() const noexcept;
  bool seenSliding() const noexcept { return afferents_.sight.object && afferents_.sight.sliding; }
  /// Seen height loss of the object since the first touch, minus the compliance of the fingers [m].
  double fallen() const noexcept;
  /// Height of the object in the hand's coordinates [m].
  std::optional<double> seenHeight() const noexcept;
  /// Prepares for another grasp: forgets the height at the first touch.
  void release() noexcept {
    place_ = std::numeric_limits<double>::quiet_NaN();
    opening_ = true;
  }
  bool touchesBoth() const noexcept { return touching(0) && touching(1); }
  /// Seen position of the object along the grip, in the thumb's direction [m].
  std::optional<double> seenAside() const noexcept;
  /// The object has left the fingers, as felt or seen.
  bool lost() const noexcept { return (!touching(0) && !touching(1)) || fallen() > kGone; }

 private:
  static constexpr double kGone = 0.03;  // [m]
  bool touching(int digit) const noexcept { return afferents_.digits[digit].normal > 0; }
  void learnStiffness() noexcept;

  double period_;
  Afferents afferents_;
  double grip_ = 0, load_ = 0, height_ = 0, usual_height_ = 0, kick_ = 0, drift_ = 0;
  double place_ = std::numeric_limits<double>::quiet_NaN();  // seen height of the object at the first touch
  bool learning_ = true, opening_ = false;                   // opening: contact still belongs to the previous grasp
  // running means of closing and grip of both digits, and their centred sums of products
  double count_ = 0, mean_q_ = 0, mean_n_ = 0, qq_ = 0, qn_ = 0;
};

}  // namespace presa::subject
