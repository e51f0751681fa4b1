#pragma once
#include <optional>
#include <string>

#include "modules/view_osg/finger_view.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

/// What a visitor is shown on the first block: drag, pinch, lift, turn, one after the other, each until it was done. No
/// drawing here.
class Lesson {
 public:
  enum class Step { kDrag, kPinch, kLift, kTurn, kDone };

  void update(const ViewFrame& frame, const std::vector<FingerView>& fingers);
  Step step() const { return step_; }
  /// The action of the scene's words that is shown now; null: none.
  const AssemblyWords::Action* action(const AssemblyWords& words) const;

  static constexpr double kDragged = 0.04;  ///< level way of the fingers that counts as a drag [m]
  static constexpr double kLifted = 0.03;   ///< height over where a block was taken that counts as lifted [m]
  static constexpr double kTurned = 0.25;   ///< turn of the fingers' line that counts as a turn [rad]

 private:
  void start(Step step, const Vec3& middle, double yaw);

  Step step_ = Step::kDrag;
  std::optional<Vec3> from_;  // middle between the fingers when the step began [m]
  double yaw_ = 0;            // and direction of their line [rad]
};

}  // namespace presa::view
