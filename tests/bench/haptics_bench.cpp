#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

// One haptic tick of two fingers that slide over a bumpy mesh with friction. The same 10 000 ticks again and again: the
// machine's interrupts (tens of us of CPU time each, in one tick of a few hundred) fall on other ticks every time, so the
// cheapest of five runs of each tick is the tick's own cost. p999_us is over those; p999_raw_us over every single tick.
void BM_HapticTickTwoFingers(benchmark::State& state) {
  constexpr std::size_t kTicks = 10'000;
  const std::vector<PatchTriangle> patch = bumpyPatch(static_cast<double>(state.range(0)) * 1e-6, 0.012);
  std::vector<BoundingSphere> bounds;
  for (const PatchTriangle& triangle : patch) bounds.push_back(boundOf(triangle.v_B));
  std::vector<std::int64_t> own(kTicks, std::numeric_limits<std::int64_t>::max()), raw;
  for (auto _ : state) {
    FingertipState fingers[2] = {{{0, 0, 0.01}, {0, 0, 0.01}}, {{0, 0, 0.01}, {0, 0, 0.01}}};
    std::unique_ptr<Surroundings> near[2] = {std::make_unique<Surroundings>(), std::make_unique<Surroundings>()};
    for (std::size_t i = 0; i < kTicks; ++i) {
      const double t = 1e-3 * static_cast<double>(i);
      const std::int64_t begin = threadCpuNs();
      for (std::size_t f = 0; f < 2; ++f) {
        Surroundings& s = *near[f];
        s.begin(0, i / 10);  // a new patch every ten ticks
        s.addTriangles(patch.data(), bounds.data(), static_cast<int>(patch.size()), 0, nullptr, {Vec3::Zero(), 1});
        const Vec3 g(3e-3 * std::sin(2 * t), 3e-3 * std::cos(3 * t), 0.0065);
        ProxyContact contact = slideProxy(fingers[f], g, 0.008, s);
        holdByFriction(contact, fingers[f], g, 0.008, {0.8, 0.6}, s);
        fingers[f] = contact.state;
      }
      const std::int64_t took = threadCpuNs() - begin;
      own[i] = std::min(own[i], took);
      raw.push_back(took);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(kTicks) * state.iterations());
  for (auto* ticks : {&own, &raw}) std::sort(ticks->begin(), ticks->end());
  const auto at = [](const std::vector<std::int64_t>& ticks, std::size_t permille) {
    return static_cast<double>(ticks[ticks.size() * permille / 1000]) * 1e-3;
  };
  state.counters["p50_us"] = at(own, 500);
  state.counters["p99_us"] = at(own, 990);
  state.counters["p999_us"] = at(own, 999);
  state.counters["p999_raw_us"] = at(raw, 999);
  state.counters["triangles"] = static_cast<double>(patch.size());
}
BENCHMARK(BM_HapticTickTwoFingers)->Arg(2000)->Arg(1500)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace presa
