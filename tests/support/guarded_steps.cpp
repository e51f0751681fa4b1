#include "tests/support/guarded_steps.h"

#include <algorithm>

#include "tests/support/alloc_lock_guard.h"

namespace presa::test {
namespace {

constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};

}  // namespace

GuardedSteps::GuardedSteps(Session& session) : session_(session), rates_(session.world()->scene.rates) {
  for (const RateGroup group : kGroups) session_.graph().start(group);
}

GuardedSteps::~GuardedSteps() {
  for (auto group = kGroups.rbegin(); group != kGroups.rend(); ++group) session_.graph().stop(*group);
}

void GuardedSteps::run(std::uint64_t haptic_ticks) {
  for (const std::uint64_t end = next_ + haptic_ticks; next_ < end; ++next_) {
    for (const RateGroup group : kGroups) {
      const auto divisor = static_cast<std::uint64_t>(rates_.divisor(group));
      if (next_ % divisor != 0) continue;
      const Tick tick = rates_.tick(group, next_ / divisor);
      const RealTimeGuard guard;
      session_.graph().step(group, tick);
      std::string& first = first_[static_cast<std::size_t>(group)];
      if (guard.violations() > 0 && first.empty()) first = guard.first() + (" at " + std::to_string(tick.time));
    }
  }
}

}  // namespace presa::test
