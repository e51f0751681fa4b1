#include "modules/view_osg/lesson.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace presa::view {

void Lesson::start(Step step, const Vec3& middle, double yaw) {
  step_ = step;
  from_ = middle;
  yaw_ = yaw;
}

void Lesson::update(const ViewFrame& frame, const std::vector<FingerView>& fingers) {
  if (step_ == Step::kDone) return;
  // who has placed a block needs no lesson
  if (frame.guidance && frame.guidance->placed > 0) step_ = Step::kDone;
  if (fingers.size() != 2 || !fingers[0].valid || !fingers[1].valid) return;
  const Vec3 middle = (fingers[0].p_WH + fingers[1].p_WH) / 2, line = fingers[1].p_WH - fingers[0].p_WH;
  const double yaw = std::atan2(line.y(), line.x());
  if (!from_) start(step_, middle, yaw);
  const Vec3 way = middle - *from_;
  const bool held = fingers[0].touches() && fingers[0].body == fingers[1].body && fingers[1].touches();
  switch (step_) {
    case Step::kDrag:
      if (way.head<2>().norm() > kDragged || held) start(Step::kPinch, middle, yaw);
      return;
    case Step::kPinch:
      if (held) start(Step::kLift, middle, yaw);
      return;
    case Step::kLift:
      if (!held) return start(Step::kPinch, middle, yaw);
      if (way.z() > kLifted) start(Step::kTurn, middle, yaw);
      return;
    case Step::kTurn:
      if (std::abs(std::remainder(yaw - yaw_, 2 * std::numbers::pi)) > kTurned) step_ = Step::kDone;
      return;
    case Step::kDone:
      return;
  }
}

const AssemblyWords::Action* Lesson::action(const AssemblyWords& words) const {
  static constexpr std::array kNames{"drag", "pinch", "lift", "turn"};
  if (step_ == Step::kDone) return nullptr;
  const char* const name = kNames[static_cast<std::size_t>(step_)];
  const auto found = std::ranges::find(words.actions, name, &AssemblyWords::Action::name);
  return found == words.actions.end() ? nullptr : &*found;
}

}  // namespace presa::view
