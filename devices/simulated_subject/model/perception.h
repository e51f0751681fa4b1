#pragma once
#include <limits>
#include <optional>

#include "devices/simulated_subject/model/senses.h"

namespace presa::subject {

/// What is made of the senses from tick to tick. Felt except where it says seen.
class Perception {
 public:
  explicit Perception(double period) : period_(period) {}
  void step(const Senses& senses) noexcept;

  /// Mean grip and load of the digits over the last 50 ms [N].
  double grip() const noexcept { return grip_; }
  double load() const noexcept { return load_; }
  /// Stiffness of what is held [N/m]: slope of grip over closing of the fingers while it grips lightly.
  double stiffness() const noexcept;
  /// No more to be learnt of it.
  void keepStiffness() noexcept { learning_ = false; }

  /// The fingers spring up when load leaves them: their rise above where they were in the last 0.4 s [m].
  double kick() const noexcept { return kick_; }
  /// Forgets that past: they are where they belong now.
  void rest() noexcept { usual_height_ = height_; }
  /// Neither rising nor sinking, and not seen to slide.
  bool still() const noexcept;
  bool seenSliding() const noexcept { return senses_.sight.object && senses_.sight.sliding; }
  /// How far the object is seen below where it was first touched, less the give of the fingers [m].
  double fallen() const noexcept;
  /// Height of the object in the hand's coordinates [m].
  std::optional<double> seenHeight() const noexcept;
  /// What comes next is another grasp: the object will be touched elsewhere.
  void letGo() noexcept {
    place_ = std::numeric_limits<double>::quiet_NaN();
    opening_ = true;
  }
  bool touchesBoth() const noexcept { return touching(0) && touching(1); }
  /// Where the object is seen along the grip, in the thumb's direction [m].
  std::optional<double> seenAside() const noexcept;
  /// It has left the fingers, as they feel or as is seen.
  bool lost() const noexcept { return (!touching(0) && !touching(1)) || fallen() > kGone; }

 private:
  static constexpr double kGone = 0.03;  // [m]
  bool touching(int digit) const noexcept { return senses_.digits[digit].normal > 0; }
  void learnStiffness() noexcept;

  double period_;
  Senses senses_;
  double grip_ = 0, load_ = 0, height_ = 0, usual_height_ = 0, kick_ = 0, drift_ = 0;
  double place_ = std::numeric_limits<double>::quiet_NaN();  // seen height of the object at the first touch
  bool learning_ = true, opening_ = false;                   // opening: what is still touched is the grasp before
  // running means of closing and grip of both digits, and their sums of products about them
  double count_ = 0, mean_q_ = 0, mean_n_ = 0, qq_ = 0, qn_ = 0;
};

}  // namespace presa::subject
