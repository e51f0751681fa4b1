#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <vector>

#include "framework/core/schedule/clock.h"
#include "framework/session/load_world.h"
#include "framework/session/session.h"
#include "tests/support/made_model.h"

// A textured model in the window: seconds from nothing loaded to the first frame, then the time of a frame while the camera
// stands and the body turns. xvfb-run -s '-screen 0 1280x720x24' ./dev bench BM_Model
namespace presa {
namespace {

namespace fs = std::filesystem;

double seconds() { return 1e-9 * static_cast<double>(monotonicNs()); }

/// Processor time of this process, all threads, and of its readers of meshes [s]: on a busy machine the honest figure.
double busy() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& t : {used.ru_utime, used.ru_stime})
      sum += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }
  return sum;
}

/// A ball with hills: `columns` around, half as many rows; three maps of `side` pixels.
std::string writeScene(const fs::path& folder, std::uint32_t columns, std::uint32_t side) {
  const auto place = [](float u, float v) {
    const float turn = 2 * std::numbers::pi_v<float> * (u < 1 ? u : 0), up = std::numbers::pi_v<float> * (v - 0.5F);
    const float r =
        0.05F * (1 + 0.04F * std::sin(9 * turn) * std::cos(7 * up) + 0.004F * std::sin(70 * turn) * std::cos(60 * up));
    const float c = v > 0 && v < 1 ? std::cos(up) : 0;
    return std::array<float, 3>{r * c * std::cos(turn), r * c * std::sin(turn), r * std::sin(up)};
  };
  const auto normal = [&](float u, float v) {
    const auto p = place(u, v);
    const float length = std::hypot(p[0], p[1], p[2]);
    return std::array<float, 3>{p[0] / length, p[1] / length, p[2] / length};
  };
  const auto shade = [](std::uint32_t x, std::uint32_t y) {
    return static_cast<std::uint8_t>(90 + (x * 7 ^ y * 13) % 120);
  };
  test::written(folder / "c.png", test::png(side, side, [&](auto x, auto y) {
                  return test::Rgb{shade(x, y), shade(y, x), 90};
                }));
  test::written(folder / "n.png", test::png(side, side, [&](auto x, auto y) {
                  return test::Rgb{static_cast<std::uint8_t>(108 + shade(x, y) / 6), 128, 245};
                }));
  test::written(folder / "r.png", test::png(side, side, [&](auto x, auto y) { return test::Rgb{0, shade(x, y), 0}; }));
  test::writeGltf(folder, "ball", test::sheet(columns, columns / 2, place, normal),
                  R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":2},)"
                  R"("metallicFactor":0},"normalTexture":{"index":1}})",
                  {"c.png", "n.png", "r.png"});
  return test::written(folder / "scene.xml", R"(<scene version="1.0" name="ball"><world gravity="0 0 0"/>
    <materials><material name="stone" stiffness="1000"/></materials>
    <body name="ball" angular_velocity="0 0 1"><visual><mesh file="ball.gltf"/></visual>
      <physics mass="0.2"><sphere radius="0.05"/></physics></body></scene>)");
}

void BM_Model(benchmark::State& state, std::uint32_t columns, std::uint32_t side) {
  if (std::getenv("DISPLAY") == nullptr) {
    state.SkipWithError("needs a display: xvfb-run");
    return;
  }
  const fs::path folder = fs::temp_directory_path() / ("presa_model_bench_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string scene = writeScene(folder, columns, side);
  std::vector<double> frames, frames_busy;
  double loaded_s = 0, first_s = 0, loaded_busy = 0, first_busy = 0;
  for (auto _ : state) {
    const double start = seconds(), idle = busy();
    Diagnostics found;
    RunOptions options;
    options.view = RunOptions::View::kWindow;
    Loaded loaded = loadWorld({scene, "", {}}, options, found);
    if (found.hasErrors()) throw InputError(found);
    loaded_s = seconds() - start, loaded_busy = busy() - idle;
    const RateTable rates(loaded.world->scene.rates);
    RunControl control;
    Session session(std::move(loaded), control, {});
    for (const RateGroup group : {RateGroup::kDynamics, RateGroup::kView}) session.graph().start(group);
    for (std::uint64_t i = 0; i < 60; ++i) {
      for (std::uint64_t step = 0; step < 3; ++step)
        session.graph().step(RateGroup::kDynamics, rates.tick(RateGroup::kDynamics, 3 * i + step));
      const double before = seconds(), busy_before = busy();
      session.graph().step(RateGroup::kView, rates.tick(RateGroup::kView, i));
      if (i == 0) first_s = seconds() - start, first_busy = busy() - idle;
      if (i > 0) frames.push_back(1e3 * (seconds() - before)), frames_busy.push_back(1e3 * (busy() - busy_before));
    }
    for (const RateGroup group : {RateGroup::kView, RateGroup::kDynamics}) session.graph().stop(group);
  }
  fs::remove_all(folder);
  for (auto* times : {&frames, &frames_busy}) std::ranges::sort(*times);
  state.counters["triangles"] = columns * (columns / 2) * 2;
  state.counters["loaded_s"] = loaded_s;
  state.counters["first_frame_s"] = first_s;
  state.counters["frame_p50_ms"] = frames[frames.size() / 2];
  state.counters["loaded_cpu_s"] = loaded_busy;
  state.counters["first_frame_cpu_s"] = first_busy;
  state.counters["frame_cpu_p50_ms"] = frames_busy[frames_busy.size() / 2];
  state.counters["frame_p90_ms"] = frames[frames.size() * 9 / 10];
}
BENCHMARK_CAPTURE(BM_Model, 300k_2048, 548, 2048)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(BM_Model, 1M_4096, 1000, 4096)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace presa
