#include <gtest/gtest.h>

#include "framework/plan/load_world.h"
#include "framework/plan/session.h"
#include "framework/schedule/executor.h"
#include "tests/app/support.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

struct Violations {
  int count = 0;
  std::string first;
};

// A shipped scene's whole script, stepped by hand as lockstep does. Counted per group from `warm` seconds on.
std::array<Violations, kRateGroupCount> violationsOf(const std::string& scene, double warm) {
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld({test::source(scene), "", {}}, {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  const RateTable rates(loaded.world->scene.rates);
  RunControl control;
  Session session(loaded.world, loaded.plan, control, {});
  constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};
  for (const RateGroup group : kGroups) session.graph().start(group);
  std::array<Violations, kRateGroupCount> violations;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    for (const RateGroup group : kGroups) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (i % divisor != 0) continue;
      const RealTimeGuard guard;
      session.graph().step(group, rates.tick(group, i / divisor));
      if (guard.violations() == 0 || rates.tick(RateGroup::kHaptic, i).time < warm) continue;
      Violations& own = violations[static_cast<std::size_t>(group)];
      if (own.count == 0) own.first = guard.first() + (" at " + std::to_string(rates.tick(RateGroup::kHaptic, i).time));
      own.count += guard.violations();
    }
  }
  for (auto group = kGroups.rbegin(); group != kGroups.rend(); ++group) session.graph().stop(*group);
  return violations;
}

// Reach, squeeze, lift, hold, slip and drop: the script of either scene. Collision has its memory from the start; dynamics
// grows its engine's working memory with the first contacts, which is what the warm-up is for.
TEST(Allocation, NoTickOfAnyGroupAllocatesOrLocksAfterWarmUp) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  for (const char* scene : {"config/scenes/cube.xml", "config/scenes/pinch_and_lift.xml"}) {
    const auto violations = violationsOf(scene, 0);
    for (int g = 0; g < kRateGroupCount; ++g) {
      const Violations& own = violations[static_cast<std::size_t>(g)];
      EXPECT_EQ(own.count, 0) << scene << ' ' << toString(static_cast<RateGroup>(g)) << ": " << own.first;
    }
  }
}

}  // namespace
}  // namespace presa
