#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "framework/core/schedule/executor.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/apps/presa/support.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

struct Violations {
  int max_in_a_tick = 0;
  std::string first;
};

// A shipped scene's whole script (reach, squeeze, lift, hold, slip and drop), stepped by hand like the lockstep
// executor.
std::array<Violations, kRateGroupCount> violationsOf(const std::string& scene) {
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({test::source(scene), "", {}}, {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  const RateTable rates(loaded.world->scene.rates);
  RunControl control;
  Session session(std::move(loaded), control, {});
  constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};
  for (const RateGroup group : kGroups) session.graph().start(group);
  std::array<Violations, kRateGroupCount> violations;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    for (const RateGroup group : kGroups) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (i % divisor != 0) continue;
      const RealTimeGuard guard;
      session.graph().step(group, rates.tick(group, i / divisor));
      const int count = guard.violations();
      Violations& own = violations[static_cast<std::size_t>(group)];
      if (count > 0 && own.max_in_a_tick == 0)
        own.first = guard.first() + (" at " + std::to_string(rates.tick(RateGroup::kHaptic, i).time));
      own.max_in_a_tick = std::max(own.max_in_a_tick, count);
    }
  }
  for (auto group = kGroups.rbegin(); group != kGroups.rend(); ++group) session.graph().stop(*group);
  return violations;
}

TEST(Allocation, NoTickAllocates) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const char* scene : {"config/scenes/cube.xml", "config/scenes/pinch_and_lift.xml"}) {
    const auto violations = violationsOf(scene);
    const auto of = [&](RateGroup group) { return violations[static_cast<std::size_t>(group)]; };
    for (const RateGroup group : {RateGroup::kHaptic, RateGroup::kCollision, RateGroup::kDynamics}) {
      EXPECT_EQ(of(group).max_in_a_tick, 0) << scene << ' ' << toString(group) << ": " << of(group).first;
    }
  }
}

}  // namespace
}  // namespace presa
