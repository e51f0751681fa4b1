#include "modules/view_osg/follow_camera.h"

#include <algorithm>

namespace presa::view {
namespace {

constexpr double kGlide = 0.7;  ///< duration of a change of place [s]
// the camera rests while the subject's reach in the picture is between these; a new place makes it 1
constexpr double kSmallest = 0.65, kLargest = 1.18;

}  // namespace

CameraPose FollowCamera::at(double clock, const std::vector<Ball>& subject, double aspect, double used_width,
                            bool now) {
  if (now || !placed_) {
    direction_ = choice_.direction(subject);
    from_ = to_ = frame(subject, aspect, used_width);
    placed_ = true;
    return to_;
  }
  const double reach = reachInPicture(subject, to_, aspect, used_width);
  if (reach < kSmallest || reach > kLargest) {
    from_ = glide(clock);
    to_ = frame(subject, aspect, used_width);
    left_at_ = clock;
  }
  return glide(clock);
}

CameraPose FollowCamera::frame(const std::vector<Ball>& subject, double aspect, double used_width) const {
  return frameSubject(subject, aspect, direction_.heading, used_width, direction_.elevation);
}

CameraPose FollowCamera::glide(double clock) const {
  const double t = std::clamp((clock - left_at_) / kGlide, 0.0, 1.0);
  if (t >= 1) return to_;
  const double share = t * t * (3 - 2 * t);
  return {from_.eye + share * (to_.eye - from_.eye), from_.target + share * (to_.target - from_.target)};
}

}  // namespace presa::view
