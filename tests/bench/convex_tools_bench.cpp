// Tools as convex parts: a tick of xfca and of light_cursor, beside the bound, the distances of their pairs alone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "framework/geometry/convex.h"
#include "framework/haptics/convex_pairs.h"
#include "framework/haptics/renderers.h"
#include "tests/support/finger_world.h"
#include "tests/support/mesh_file.h"

namespace presa {
namespace {

std::shared_ptr<const World> worldOf(const std::string& renderer, const std::string& tool, const std::string& bodies) {
  return test::fingerWorld(
      R"(<scene version="1.1" name="tools"><world gravity="0 0 0"/><haptics tools=")" + renderer +
      R"("/><materials><material name="any" stiffness="1000"><friction static="0.3" dynamic="0.2"/></material></materials>)" +
      bodies + R"(<devices><device role="finger"><tool>)" + tool + "</tool></device></devices></scene>");
}

std::string box(int number, const Vec3& at, const Vec3& size) {
  const auto text = [](const Vec3& v) {
    return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
  };
  return "<body name=\"b" + std::to_string(number) + R"(" fixed="true" material="any" pos=")" + text(at) +
         R"("><haptic><box size=")" + text(size) + R"("/></haptic></body>)";
}

/// A hull of 200 vertices on a sphere of 20 mm.
TriMesh stone() {
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i)
    points.push_back(0.02 * Vec3(normal(engine), normal(engine), normal(engine)).normalized());
  return *convexHull(points);
}

/// Ten boxes, all of which the stone may meet: a floor of nine and a wall.
std::string tenBoxes() {
  std::string bodies;
  for (int i = 0; i < 9; ++i) bodies += box(i, {0.012 * (i % 3 - 1), 0.012 * (i / 3 - 1), -0.01}, {0.012, 0.012, 0.02});
  return bodies + box(9, {0.035, 0, 0.02}, {0.02, 0.1, 0.04});
}

/// Processor time of this thread [us].
double processorUs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Ticks of a renderer, the hand at handAt(time). Each tick has the least time of several runs of the same motion: what
/// interrupts a machine now and then is not the tick's.
template <class HandAt>
void tickAlong(benchmark::State& state, const World& world, const HandAt& handAt) {
  constexpr int kTicks = 5000, kRuns = 5;
  const Touchables touchables(world);
  std::vector<double> us(kTicks, 1e300);
  ToolState tool;
  for (auto _ : state) {
    for (int run = 0; run < kRuns; ++run) {
      const auto renderer = makeToolRenderer(world);
      BoundedList<ToolForce> forces(renderer->maxForces());
      tool = {};
      for (int tick = 0; tick < kTicks; ++tick) {
        const Pose X_WH = handAt(1e-3 * tick);
        const Vec3 still = Vec3::Zero();
        forces.clear();
        if (!tool.alive) tool.X_WT = X_WH;
        const double begin = processorUs();
        renderer->touch({0, X_WH, still, still, 1e-3, touchables, world.scene.materials}, forces, tool);
        double& least = us[static_cast<std::size_t>(tick)];
        least = std::min(least, processorUs() - begin);
        tool.alive = true;
      }
    }
  }
  std::sort(us.begin(), us.end());
  const auto at = [&](double share) { return us[static_cast<std::size_t>(share * (kTicks - 1))]; };
  state.counters["p50_us"] = at(0.5);
  state.counters["p99.9_us"] = at(0.999);
  state.counters["late"] = tool.late;
}

Pose overTheFloor(double t) {
  return {{0.002 * std::sin(7 * t), 0.006 * std::cos(5 * t), 0.0175},
          Quat(Eigen::AngleAxisd(t, Vec3(1, 2, 3).normalized()))};
}

void BM_XfcaTick(benchmark::State& state) {
  const test::MeshFile mesh(stone(), "stone");
  tickAlong(state, *worldOf("xfca", "<mesh file=\"" + mesh.path() + "\"/>", tenBoxes()), overTheFloor);
}
BENCHMARK(BM_XfcaTick)->Iterations(1)->Unit(benchmark::kMillisecond);

void BM_XfcaBound(benchmark::State& state) {
  const test::MeshFile mesh(stone(), "stone");
  const auto world = worldOf("xfca", "<mesh file=\"" + mesh.path() + "\"/>", tenBoxes());
  const std::vector<ConvexSolid> bodies = convexBodies(*world, {});
  const ConvexSolid tool = convexTool(*world, 0, {});
  ConvexPairs pairs(tool, bodies);
  const Touchables touchables(*world);
  std::int64_t tick = 0;
  for (auto _ : state) {
    const Pose X_WT = overTheFloor(1e-3 * static_cast<double>(tick++));
    pairs.place(touchables);
    pairs.gather(X_WT, 0.1);
    pairs.separate({X_WT.p + Vec3(0, 0, 0.003), X_WT.q}, 1);
    benchmark::DoNotOptimize(pairs.near()[0].gap);
  }
  state.counters["pairs"] = static_cast<double>(pairs.near().size());
}
BENCHMARK(BM_XfcaBound)->Iterations(20'000)->Unit(benchmark::kMicrosecond);

/// A plate on five blocks: twenty contacts.
void BM_LightCursorTick(benchmark::State& state) {
  std::string bodies;
  for (int i = 0; i < 5; ++i)
    bodies += box(i, {i == 4 ? 0 : 0.04 * (i % 2 == 0 ? 1 : -1), i == 4 ? 0 : 0.04 * (i < 2 ? 1 : -1), -0.01},
                  {0.02, 0.02, 0.02});
  tickAlong(state, *worldOf("light_cursor", R"(<box size="0.12 0.12 0.01"/>)", bodies), [](double t) {
    return Pose{{0.002 * std::sin(7 * t), 0.002 * std::cos(5 * t), 0.003},
                Quat(Eigen::AngleAxisd(0.003 * std::sin(9 * t), Vec3(1, 2, 0).normalized()))};
  });
}
BENCHMARK(BM_LightCursorTick)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace presa
