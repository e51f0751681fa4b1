#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "framework/session/session.h"
#include "tests/bench/shipped_scene.h"

// The window: processor time of a picture with software rendering, all threads of this process together, and of the
// first one from the start of the view. Run with a display: xvfb-run -s '-screen 0 1280x720x24' ./dev bench View
namespace presa {
namespace {

double processMs() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Frames of a run from `begin` to `end` [s] in virtual time, at the rate of the view.
void BM_View(benchmark::State& state, const std::string& scene, double begin, double end) {
  if (std::getenv("DISPLAY") == nullptr) {
    state.SkipWithError("needs a display: xvfb-run");
    return;
  }
  std::vector<double> frames, wall;
  double first = 0;
  for (auto _ : state) {
    state.PauseTiming();
    RunOptions options;
    options.view = RunOptions::View::kWindow;
    Loaded loaded = bench::loadShipped(scene, {}, options);
    const RateTable rates(loaded.world->scene.rates);
    RunControl control;
    Session session(std::move(loaded), control, {});
    state.ResumeTiming();
    constexpr RateGroup kGroups[] = {RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};
    for (const RateGroup group : kGroups) session.graph().start(group);
    const double start = processMs();
    session.graph().start(RateGroup::kView);
    for (std::uint64_t i = 0, drawn = 0; static_cast<double>(i) < 1000 * end; ++i) {
      if (i % 5 == 0) session.graph().step(RateGroup::kDynamics, rates.tick(RateGroup::kDynamics, i / 5));
      if (i % 10 == 0) session.graph().step(RateGroup::kCollision, rates.tick(RateGroup::kCollision, i / 10));
      session.graph().step(RateGroup::kHaptic, rates.tick(RateGroup::kHaptic, i));
      if (i % 17 != 0 || static_cast<double>(i) < 1000 * begin) continue;
      const double before = processMs();
      const std::int64_t clock = monotonicNs();
      session.graph().step(RateGroup::kView, rates.tick(RateGroup::kView, i / 17));
      if (drawn++ == 0) {
        first = processMs() - start;
        continue;
      }
      frames.push_back(processMs() - before);
      wall.push_back(static_cast<double>(monotonicNs() - clock) * 1e-6);
    }
    session.graph().stop(RateGroup::kView);
    for (const RateGroup group : kGroups) session.graph().stop(group);
  }
  for (auto* times : {&frames, &wall}) std::ranges::sort(*times);
  state.counters["first_ms"] = first;
  state.counters["frame_p50_ms"] = frames[frames.size() / 2];
  state.counters["frame_p90_ms"] = frames[frames.size() * 9 / 10];
  state.counters["wall_p50_ms"] = wall[wall.size() / 2];
}
BENCHMARK_CAPTURE(BM_View, cube, "cube.xml", 0.5, 6)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(BM_View, amphora, "pinch_and_lift.xml", 0.5, 6)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(BM_View, tea_tray, "tea_tray.xml", 0.5, 4)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace presa
