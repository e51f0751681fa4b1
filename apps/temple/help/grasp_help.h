#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "apps/temple/help/grasp_aim.h"
#include "framework/core/schedule/tick.h"
#include "framework/core/state/object_state.h"
#include "framework/device/pointer_state.h"

namespace presa::temple {

/// Helps a visitor with a mouse to take a block and to put it where it belongs. The help changes the target of the
/// visitor's pair of fingertips, as the visitor's own hand would, and nothing else: no force, no body, no goal. Over a
/// block the pair opens, comes to its middle, turns across its faces and goes down; a notch or two of the wheel close
/// it firmly; the hand carries clear of what stands; near its place the block is turned and lowered; the hand lets go
/// of a block that stands. Whatever the visitor does is added: a drag always moves the pair, the opposite notches open
/// it.
///
/// Strength 1: all of this. Less: from a smaller distance; below kHighHelp without the heights, below kNone nothing.
/// A new strength counts from the next block on.
///
/// Threads: setters and needed() any; all else haptic, nothing allocates. Lengths in W [m].
class GraspHelp {
 public:
  explicit GraspHelp(std::shared_ptr<const World> world);

  static constexpr double kReach = 0.045;   ///< distance from a block or its place at which full help begins [m]
  static constexpr double kHighHelp = 0.5;  ///< strength from which heights are helped with, too
  static constexpr double kNone = 0.1;      ///< strength below which the pointer's state is passed on as it is

  void setStrength(double strength) noexcept { strength_.store(strength, std::memory_order_relaxed); }
  void setPlaced(std::size_t body, bool placed) noexcept { placed_[body].store(placed, std::memory_order_relaxed); }
  /// False: the pointer's state is passed on as it is, and no block is at hand.
  void setActive(bool active) noexcept { active_.store(active, std::memory_order_relaxed); }
  /// The goal that the guide has for a held body (indices; kNoGoal, kNoBody: none).
  void setGoal(std::int32_t body, std::int32_t goal) noexcept {
    goal_.store((static_cast<std::int64_t>(body) << 32) | static_cast<std::uint32_t>(goal), std::memory_order_relaxed);
  }
  /// How far the visitor's own aim was from the helped one, at the last grasp and at the last place [m]; what is within
  /// kOwn of both was done without help.
  struct Need {
    double grasp = 0, place = 0;
  };
  static constexpr double kOwn = 0.012;
  Need needed() const noexcept { return {grasp_need_.load(), place_need_.load()}; }

  /// A finger's centre, and whether it is pressed; `side` 0: thumb, 1: index.
  void noteFinger(std::size_t side, const Vec3& p_WH) noexcept { p_WH_[side] = p_WH; }
  void noteForce(std::size_t side, double newton) noexcept { pressed_[side] = newton > kTouch; }
  void see(const ObjectState& objects) noexcept;
  /// The helped target for this tick; the same for both fingers.
  const PointerState& target(const PointerState& wanted, const Tick& tick) noexcept;

 private:
  enum class Stage { kFree, kOver, kAt, kGrip, kHeld, kPlace, kDown, kOpen, kLeave };
  static constexpr double kTouch = 0.3;  // [N]

  void step(const PointerState& wanted) noexcept;
  void go(Stage stage) noexcept;
  double since() const noexcept { return now_ - stage_at_; }
  void look(const PointerState& wanted) noexcept;
  void free(const PointerState& wanted) noexcept;
  void over(const PointerState& wanted) noexcept;
  void grip(const PointerState& wanted) noexcept;
  void carry(const PointerState& wanted) noexcept;
  void place(const PointerState& wanted) noexcept;
  void putDown(const PointerState& wanted, bool stands) noexcept;
  void overPlace(bool opens) noexcept;
  void open(const PointerState& wanted) noexcept;
  void release(const PointerState& wanted) noexcept;
  void notePlace() noexcept;
  double snapDistance() const noexcept;  ///< of the place [m]
  void aim(const PointerState& wanted) noexcept;
  void takeGoal(const PointerState& wanted) noexcept;
  void hold() noexcept;
  std::int32_t nearest(const Vec3& p, double reach) const noexcept;
  double clearHeight(const Vec3& p, double reach, std::int32_t but) const noexcept;
  bool wantsClosed() const noexcept;
  bool wantsOpen() const noexcept;
  bool loses() noexcept;
  double pairYaw() const noexcept;
  const Pose& poseOf(std::int32_t body) const noexcept;
  Vec3 middle() const noexcept { return (p_WH_[0] + p_WH_[1]) / 2; }
  double halfOpening() const noexcept { return (p_WH_[1] - p_WH_[0]).norm() / 2; }

  std::shared_ptr<const World> world_;
  std::vector<BlockShape> shapes_;
  double fingertip_ = 0;
  std::vector<std::atomic<bool>> placed_;
  std::atomic<std::int64_t> goal_{-1};
  std::atomic<bool> active_{true};
  std::atomic<double> strength_{1}, grasp_need_{0}, place_need_{0};

  std::vector<Pose> X_WB_;  // by body
  std::array<Vec3, 2> p_WH_{Vec3::Zero(), Vec3::Zero()};
  std::array<bool, 2> pressed_{};
  std::uint64_t tick_ = 0;
  double now_ = 0, stage_at_ = 0, touched_at_ = 0, opens_at_ = 0;  // [s]
  Stage stage_ = Stage::kFree;
  double help_ = 1;                               // strength for the block at hand
  std::int32_t body_ = kNoBody, left_ = kNoBody;  // at hand; just left
  GraspAim aim_;
  double closing_ = 0, open_from_ = 0, closed_from_ = 0;  // of the wheel: now, at its last minimum and maximum
  Vec3 offset_ = Vec3::Zero(), last_ = Vec3::Zero();      // helped minus wanted, level; the last wanted
  double yaw_offset_ = 0, base_ = 0;                      // likewise [rad]; closing that counts as open
  double taken_z_ = 0, highest_ = 0;                      // of the body where it was taken; of the hand since [m]
  Vec3 way_ = Vec3::Zero();  // level, from the body to its goal, by the visitor's own aim [m]
  std::int32_t place_ = -1;  // goal near which the body is held
  PointerState out_;
};

}  // namespace presa::temple
