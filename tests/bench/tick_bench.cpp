#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "framework/session/session.h"
#include "tests/bench/shipped_scene.h"

namespace presa {
namespace {

// Cost of the whole haptic tick of two fingers (devices, rendering, output stages, monitor) in a shipped scene's ten
// seconds of reach, lift, hold and drop. Percentiles are over the ticks of one run.
void BM_HapticTickOfScene(benchmark::State& state, const char* scene, const char* coupling = "soft") {
  constexpr std::uint64_t kTicks = 10'000;
  std::vector<std::int64_t> ticks;
  for (auto _ : state) {
    state.PauseTiming();
    Loaded loaded = bench::loadShipped(scene, {std::string("dynamics/coupling=") + coupling});
    const RateTable rates(loaded.world->scene.rates);
    RunControl control;
    Session session(std::move(loaded), control, {});
    state.ResumeTiming();
    constexpr RateGroup kGroups[] = {RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};
    for (const RateGroup group : kGroups) session.graph().start(group);
    ticks.clear();
    for (std::uint64_t i = 0; i < kTicks; ++i) {
      if (i % 5 == 0) session.graph().step(RateGroup::kDynamics, rates.tick(RateGroup::kDynamics, i / 5));
      if (i % 10 == 0) session.graph().step(RateGroup::kCollision, rates.tick(RateGroup::kCollision, i / 10));
      const std::int64_t begin = monotonicNs();
      session.graph().step(RateGroup::kHaptic, rates.tick(RateGroup::kHaptic, i));
      ticks.push_back(monotonicNs() - begin);
    }
    for (const RateGroup group : kGroups) session.graph().stop(group);
  }
  std::sort(ticks.begin(), ticks.end());
  state.counters["tick_p50_us"] = static_cast<double>(ticks[kTicks / 2]) * 1e-3;
  state.counters["tick_p99_us"] = static_cast<double>(ticks[kTicks * 99 / 100]) * 1e-3;
  state.counters["tick_p999_us"] = static_cast<double>(ticks[kTicks * 999 / 1000]) * 1e-3;
}
BENCHMARK_CAPTURE(BM_HapticTickOfScene, cube, "cube.xml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_HapticTickOfScene, pinch_and_lift, "pinch_and_lift.xml")->Unit(benchmark::kMillisecond);
// The haptic thread moves what the fingers hold: one body, two, four.
BENCHMARK_CAPTURE(BM_HapticTickOfScene, cube_held, "cube.xml", "haptic_rate")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_HapticTickOfScene, cup_and_ball, "cup_and_ball.xml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_HapticTickOfScene, cup_and_ball_held, "cup_and_ball.xml", "haptic_rate")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_HapticTickOfScene, tea_tray, "tea_tray.xml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_HapticTickOfScene, tea_tray_held, "tea_tray.xml", "haptic_rate")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace presa
