#include "modules/view_osg/frame_budget.h"

#include <algorithm>

namespace presa::view {
namespace {

constexpr double kSpare =
    0.8;  // limit for a higher share, relative to kLongest: hysteresis that keeps the share from oscillating

}  // namespace

bool FrameBudget::add(double seconds) {
  times_[count_++] = seconds;
  if (count_ < kJudged) return false;
  count_ = 0;
  auto* const middle = times_.begin() + kJudged / 2;
  std::nth_element(times_.begin(), middle, times_.end());
  if (*middle > kLongest) return changeTo(std::min(at_ + 1, kShares.size() - 1));
  if (at_ == 0) return false;
  // frame time is proportional to the number of pixels
  const double grows = kShares[at_ - 1] / kShares[at_];
  return *middle * grows * grows < kSpare * kLongest && changeTo(at_ - 1);
}

bool FrameBudget::changeTo(std::size_t at) {
  if (at == at_) return false;
  at_ = at;
  return true;
}

}  // namespace presa::view
