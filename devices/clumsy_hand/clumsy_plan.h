#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "devices/hand/pair_plan.h"
#include "framework/core/math/random.h"
#include "framework/scene/world.h"

namespace presa::clumsy {

/// Random actions of two fingers, without regard to their effect. Equal seeds and states give equal actions. Thread:
/// haptic; no allocation after construction.
class ClumsyPlan final : public PairPlan {
 public:
  enum Phase : int { kStray, kReach, kGrab, kLift, kShake, kThrow, kDrag, kPress, kPush, kOpen };
  static const std::vector<std::string>& phaseNames();
  static constexpr double kFastest = 1.2;  ///< max speed of a movement [m/s]
  static constexpr double kMaxGrip = 8;    ///< max grip force [N]

  /// `fingertip`: radius [m]. Precondition: the scene has a free body with a physics geometry.
  ClumsyPlan(std::shared_ptr<const World> world, double fingertip, std::uint64_t seed);

 private:
  struct Step {
    int phase = kStray;
    PairTarget to;
    double speed = 0;
  };
  void next(const ObjectState& objects) noexcept override;
  void choose(const ObjectState& objects) noexcept;
  void grab(const ObjectState& objects) noexcept;
  void withWhatIsHeld(PairTarget to) noexcept;
  void press(const ObjectState& objects) noexcept;
  void push(const ObjectState& objects) noexcept;
  void stray() noexcept;
  void add(Phase phase, const PairTarget& to, double speed) noexcept;
  Vec3 across(double min, double max) noexcept;
  double uniform(double low, double high) noexcept { return random_.uniform(low, high); }
  std::size_t anyBody() noexcept { return movable_[random_.below(movable_.size())]; }

  std::shared_ptr<const World> world_;
  const double fingertip_;
  std::vector<std::size_t> movable_;  // bodies
  std::vector<double> size_;          // distance from each body's origin to its farthest point [m]
  RandomStream random_;
  std::array<Step, 16> steps_;  // of the current action
  std::size_t count_ = 0, done_ = 0;
};

}  // namespace presa::clumsy
