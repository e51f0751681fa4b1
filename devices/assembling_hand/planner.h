#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/assembling_hand/choice.h"
#include "devices/hand/pair_plan.h"
#include "framework/scene/goal_pose.h"

namespace presa::assembling {

/// The plan of a pair of fingers that builds a scene's assembly. Thread: haptic; no allocation after construction.
class Planner final : public PairPlan {
 public:
  enum Phase : int {
    kLook,
    kRise,
    kOver,
    kDown,
    kClose,
    kGrip,
    kLift,
    kLoosen,
    kShake,
    kSwing,
    kCarry,
    kSettle,
    kApproach,
    kHover,
    kLower,
    kTip,
    kOpen,
    kLeave
  };
  static const std::vector<std::string>& phaseNames();

  /// `fingertip`: radius [m].
  Planner(std::shared_ptr<const World> world, double fingertip);

 private:
  void next(const ObjectState& objects) noexcept override;
  void look(const ObjectState& objects) noexcept;
  void consider(std::size_t goal, const ObjectState& objects) noexcept;
  bool leavesGap(std::size_t goal, const ObjectState& objects) const noexcept;
  void takeAim(const ObjectState& objects) noexcept;
  void moveAside(const ObjectState& objects) noexcept;
  void release() noexcept;
  bool holds(const ObjectState& objects) const noexcept;
  void carry(const ObjectState& objects) noexcept;
  void lower(const ObjectState& objects) noexcept;
  void tipOver(const ObjectState& objects) noexcept;
  void shake(const ObjectState& objects) noexcept;
  double swingingGrip(const ObjectState& objects) const noexcept;
  bool isOnItsHead(const ObjectState& objects) const noexcept;
  double tilt(const ObjectState& objects) const noexcept;
  double mayHang() const noexcept;
  bool isFilled(std::size_t goal, const ObjectState& objects) const noexcept;
  bool isPlaced(std::size_t body, const ObjectState& objects) const noexcept;
  double clearHeight(const ObjectState& objects) const noexcept;
  double openGap() const noexcept { return grasp_.half + fingertip_ + kOpening; }

  static constexpr double kOpening = 0.012;   // gap beside the body before closing [m]
  static constexpr double kClearance = 0.03;  // above all bodies [m]

  std::shared_ptr<const World> world_;
  const double fingertip_;
  const Chooser chooser_;
  std::vector<double> size_;   // by body: distance from its centre to its farthest corner [m]
  std::vector<Trial> trials_;  // by body
  std::size_t looked_at_ = 0;  // goals evaluated so far
  bool found_ = false;
  Choice best_;
  std::size_t wanted_ = 0;  // body to be placed; body_ may be an obstacle that is moved first
  std::size_t goal_ = 0, body_ = 0;
  Pose X_WG_, X_WB_taken_;
  Grasp grasp_;
  bool only_moves_ = false, tips_over_ = false;
  bool lay_ = false;  // lying when it was grasped
  int shakes_ = 0;
  int tips_ = 0;
  Vec3 tip_along_ = Vec3::Zero(), tip_about_ = Vec3::Zero();
  double tip_high_ = 0;
};

}  // namespace presa::assembling
