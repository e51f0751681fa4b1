#include <benchmark/benchmark.h>

#include <cmath>

#include "tests/support/friction_track.h"

// Cost per tick of a friction law, beside the cone's: the finger slides at 0.1 m/s and turns. The floor is 0.3 us.
namespace presa {
namespace {

void slide(benchmark::State& state, const char* element) {
  test::FrictionTrack finger(element, {});
  for (int i = 0; i < 1000; ++i) finger.slide({0.1, 0, 0});
  double phase = 0;
  for (auto _ : state) {
    phase += 0.01;
    Vec3 force = finger.slide({0.1 * std::cos(phase), 0.1 * std::sin(phase), 0});
    benchmark::DoNotOptimize(force);
  }
  if (!finger.slipping()) state.SkipWithError("the finger does not slide");
}

BENCHMARK_CAPTURE(slide, cone, "")->Name("friction/cone");
BENCHMARK_CAPTURE(slide, viscous, R"(<viscous damping="5"/>)")->Name("friction/viscous");
BENCHMARK_CAPTURE(slide, stribeck, R"(<stribeck speed="0.02" viscosity="1"/>)")->Name("friction/stribeck");
BENCHMARK_CAPTURE(slide, dahl, R"(<dahl stiffness="2000"/>)")->Name("friction/dahl");
BENCHMARK_CAPTURE(slide, lugre, R"(<lugre stiffness="2000" speed="0.02" damping="1" viscosity="1"/>)")
    ->Name("friction/lugre");
BENCHMARK_CAPTURE(slide, membrane, R"(<membrane stiffness="400"/>)")->Name("friction/membrane");
BENCHMARK_CAPTURE(slide, anisotropic, R"(<anisotropic grain="1 0 0" across="0.3"/>)")->Name("friction/anisotropic");

}  // namespace
}  // namespace presa
