#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "framework/schedule/clock.h"
#include "modules/haptics_proxy/god_object.h"

namespace presa {
namespace {

// The patch a fingertip of 8 mm sees on a bumpy surface of about 20 000 triangles (edge 1.5 mm): a height field.
std::vector<PatchTriangle> bumpyPatch(double edge, double reach) {
  std::vector<PatchTriangle> patch;
  const auto height = [](double x, double y) { return 3e-4 * std::sin(900 * x) * std::cos(700 * y); };
  const auto corner = [&](double x, double y) { return Vec3(x, y, height(x, y)); };
  for (double x = -reach; x < reach; x += edge) {
    for (double y = -reach; y < reach; y += edge) {
      PatchTriangle triangle{};
      triangle.v_B = {corner(x, y), corner(x + edge, y), corner(x + edge, y + edge)};
      patch.push_back(triangle);
      triangle.v_B = {corner(x, y), corner(x + edge, y + edge), corner(x, y + edge)};
      patch.push_back(triangle);
    }
  }
  return patch;
}

// One haptic tick of two fingers that slide over a bumpy mesh with friction: time per tick, and its 99.9th percentile.
void BM_HapticTickTwoFingers(benchmark::State& state) {
  const std::vector<PatchTriangle> patch = bumpyPatch(static_cast<double>(state.range(0)) * 1e-6, 0.012);
  auto s = std::make_unique<Surroundings>();
  s->addTriangles(patch.data(), static_cast<int>(patch.size()), 0, nullptr, {Vec3::Zero(), 1});
  const auto cone = [](std::int32_t) { return FrictionCone{0.8, 0.6}; };
  FingertipState fingers[2] = {{{0, 0, 0.01}, {0, 0, 0.01}}, {{0, 0, 0.01}, {0, 0, 0.01}}};
  std::vector<std::int64_t> ticks;
  ticks.reserve(1 << 20);
  double t = 0;
  for (auto _ : state) {
    const std::int64_t begin = monotonicNs();
    for (FingertipState& finger : fingers) {
      const Vec3 g(3e-3 * std::sin(2 * t), 3e-3 * std::cos(3 * t), 0.0065);
      finger = stepProxy(finger, g, 0.008, *s, cone).state;
    }
    t += 1e-3;
    if (ticks.size() < ticks.capacity()) ticks.push_back(monotonicNs() - begin);
  }
  std::sort(ticks.begin(), ticks.end());
  state.counters["p999_us"] = static_cast<double>(ticks[ticks.size() * 999 / 1000]) * 1e-3;
  state.counters["triangles"] = static_cast<double>(patch.size());
}
BENCHMARK(BM_HapticTickTwoFingers)->Arg(2000)->Arg(1500)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace presa
