#include <benchmark/benchmark.h>

#include <cmath>

#include "framework/device/output_stage.h"

// Cost per tick of the output from the graph to one device: the floor is 0.3 us.
namespace presa {
namespace {

void run(benchmark::State& state, const OutputLimits& limits) {
  OutputStage stage(limits);
  double phase = 0;
  for (auto _ : state) {
    phase += 0.01;
    const Vec3 wish(3 * std::sin(phase), 2, 1);
    Vec3 sent = stage.step({.command = wish, .p_WH = 0.01 * wish, .v_WH = {0.1, 0, 0}}, 1e-3).f;
    benchmark::DoNotOptimize(sent);
  }
}

void BM_OutputStage(benchmark::State& state) { run(state, {}); }
BENCHMARK(BM_OutputStage);

void BM_OutputStageAllNamed(benchmark::State& state) {
  run(state, {.continuous = 4, .heating_time = 30, .speed = 1, .passivity = true});
}
BENCHMARK(BM_OutputStageAllNamed);

}  // namespace
}  // namespace presa
