#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"

namespace presa {
namespace {

/// One scene, stepped by hand, with timed haptic ticks.
struct Timed {
  explicit Timed(const std::string& scene) {
    Diagnostics diagnostics;
    Loaded loaded =
        loadWorld({std::string(PRESA_SOURCE_DIR) + "/experiments/faults/" + scene, "", {}}, {}, diagnostics);
    if (diagnostics.hasErrors()) throw std::runtime_error(diagnostics.text());
    rates = std::make_unique<RateTable>(loaded.world->scene.rates);
    session = std::make_unique<Session>(std::move(loaded), control, Session::Options{});
    for (const RateGroup group : kGroups) session->graph().start(group);
  }
  ~Timed() {
    for (const RateGroup group : kGroups) session->graph().stop(group);
  }
  void step(std::uint64_t i) {
    if (i % 5 == 0) session->graph().step(RateGroup::kDynamics, rates->tick(RateGroup::kDynamics, i / 5));
    if (i % 10 == 0) session->graph().step(RateGroup::kCollision, rates->tick(RateGroup::kCollision, i / 10));
    const std::int64_t begin = threadCpuNs();
    session->graph().step(RateGroup::kHaptic, rates->tick(RateGroup::kHaptic, i));
    ticks.push_back(threadCpuNs() - begin);
  }
  double percentile(double share) {
    std::sort(ticks.begin(), ticks.end());
    return static_cast<double>(ticks[static_cast<std::size_t>(share * static_cast<double>(ticks.size() - 1))]) * 1e-3;
  }

  static constexpr std::array kGroups{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic};
  RunControl control;
  std::unique_ptr<RateTable> rates;
  std::unique_ptr<Session> session;
  std::vector<std::int64_t> ticks;
};

// Processor time of a haptic tick with a single cube, and with a stack of fifty bodies of mass ratio 1 to 10000 beside
// it: the same hand and object, alternating on one thread. Both share one core's caches here; in a run the dynamics has
// its own thread.
void BM_HapticTickBesideStack(benchmark::State& state) {
  constexpr std::uint64_t kTicks = 5000;
  double alone_p50 = 0, alone_p999 = 0, stack_p50 = 0, stack_p999 = 0;
  for (auto _ : state) {
    Timed alone("hold.xml"), stack("stack.xml");
    for (std::uint64_t i = 0; i < kTicks; ++i) {
      alone.step(i);
      stack.step(i);
    }
    alone_p50 = alone.percentile(0.5), alone_p999 = alone.percentile(0.999);
    stack_p50 = stack.percentile(0.5), stack_p999 = stack.percentile(0.999);
  }
  state.counters["alone_p50_us"] = alone_p50;
  state.counters["alone_p999_us"] = alone_p999;
  state.counters["stack_p50_us"] = stack_p50;
  state.counters["stack_p999_us"] = stack_p999;
  state.counters["p999_ratio"] = stack_p999 / alone_p999;
}
BENCHMARK(BM_HapticTickBesideStack)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(5);

}  // namespace
}  // namespace presa
