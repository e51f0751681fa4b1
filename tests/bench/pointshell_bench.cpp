// Points against distance fields, beside the bound, transform and lookup alone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "framework/geometry/field_sweep.h"
#include "framework/geometry/mesh_distance.h"
#include "framework/geometry/point_shell.h"
#include "framework/haptics/renderers.h"
#include "tests/support/finger_world.h"

namespace presa {
namespace {

TriMesh bumpySphere(double radius, int subdivisions) {
  TriMesh mesh = makeSphere(radius, subdivisions);
  for (Vec3& v : mesh.vertices) v *= 1 + 0.02 * std::sin(200 * v.x()) * std::cos(150 * v.y());
  buildAdjacency(mesh);
  return mesh;
}

DistanceField fieldOf(const TriMesh& mesh, double voxel) {
  const MeshDistance distance(mesh);
  return *DistanceField::build([&](const Vec3& p, double bound) { return distance(p, bound); }, boundsOf(mesh),
                               {.voxel = voxel});
}

using F4 = float __attribute__((vector_size(16)));

F4 fourAt(const FieldSweep::Row& row, std::size_t i) {
  F4 four;
  std::memcpy(&four, &row[i], sizeof four);
  return four;
}

/// Sums for points with the force depth times gradient, four at once.
struct Wrenches {
  F4 depth{}, fx{}, fy{}, fz{}, tx{}, ty{}, tz{};

  void add(const FieldSweep& sweep, std::size_t i) {
    const F4 distance = fourAt(sweep.distance, i), zero{};
    const F4 deep = distance < zero ? -distance : zero;
    const F4 x = fourAt(sweep.placed[0], i), y = fourAt(sweep.placed[1], i), z = fourAt(sweep.placed[2], i);
    const F4 f = deep * fourAt(sweep.slope[0], i), g = deep * fourAt(sweep.slope[1], i),
             h = deep * fourAt(sweep.slope[2], i);
    depth += deep;
    fx += f;
    fy += g;
    fz += h;
    tx += y * h - z * g;
    ty += z * f - x * h;
    tz += x * g - y * f;
  }
};

// Transform, field, its gradient, force, torque and their sum for every point of a shell that lies on the field's
// surface: about half of them are in contact.
void BM_PointshellBrute(benchmark::State& state) {
  const TriMesh mesh = bumpySphere(0.05, 5);
  const DistanceField field = fieldOf(mesh, 0.1 / 128);
  const PointShell shell(mesh, 1e-9, static_cast<std::size_t>(state.range(0)));
  const Eigen::Vector3f shift = (-field.origin() / field.voxel()).cast<float>();
  double angle = 0;
  for (auto _ : state) {
    angle += 0.001;
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix() / field.voxel();
    Wrenches sum;
    FieldSweep sweep(field);
    for (const PointShell::Range& block : shell.blocks()) {
      sweep.place(turn.cast<float>(), shift, std::span(shell.points()).subspan(block.first, block.end - block.first));
      sweep.lookUpSlopes();
      for (std::size_t i = 0; i < sweep.count(); i += 4) sum.add(sweep, i);
    }
    benchmark::DoNotOptimize(sum);
  }
  state.counters["ns_per_point"] =
      benchmark::Counter(static_cast<double>(shell.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(BM_PointshellBrute)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMicrosecond);

/// A tool of `points` points, pressed lightly on a slab or on a mesh and moved about, tick by tick.
void BM_PointshellLight(benchmark::State& state) {
  const auto points = std::to_string(state.range(0));
  const auto world = test::fingerWorld(
      R"(<scene version="1.1" name="light"><world gravity="0 0 0"/><haptics tools="pointshell"><pointshell max_points=")" +
      points +
      R"("/></haptics><materials><material name="any" stiffness="1000"><friction static="0.3" dynamic="0.2"/></material></materials>
    <body name="amphora" fixed="true" material="any"><haptic><mesh file="config/meshes/amphora.obj"/></haptic></body>
    <devices><device role="finger"><tool><capsule radius="0.02" length="0.06"/></tool></device></devices></scene>)");
  const auto renderer = makeToolRenderer(*world);
  const Touchables touchables(*world);
  BoundedList<ToolForce> forces(renderer->maxForces());
  ToolState tool;
  const auto& mesh = *world->meshes[0].haptic;
  const AxisBox box = boundsOf(mesh);
  const double side = box.high.x() + 0.02 - 0.001;
  std::vector<double> us;
  std::int64_t tick = 0, touched = 0;
  const auto handAt = [&](std::int64_t i) {
    const double t = 1e-3 * static_cast<double>(i);
    return Pose{{side, 0.01 * std::sin(2 * t), (box.low.z() + box.high.z()) / 2 + 0.02 * std::sin(3 * t)},
                Quat(Eigen::AngleAxisd(0.3 * std::sin(t), Vec3::UnitX()))};
  };
  for (auto _ : state) {
    const Pose X_WH = handAt(tick++);
    const Vec3 still = Vec3::Zero();
    forces.clear();
    const auto begin = std::chrono::steady_clock::now();
    renderer->touch({0, X_WH, still, still, 1e-3, touchables, world->scene.materials}, forces, tool);
    tool.alive = true;
    touched += tool.points;
    us.push_back(1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(us.begin(), us.end());
  const auto at = [&](double share) {
    return us[static_cast<std::size_t>(share * static_cast<double>(us.size() - 1))];
  };
  state.counters["p50_us"] = at(0.5);
  state.counters["p99.9_us"] = at(0.999);
  state.counters["points"] = static_cast<double>(touched) / static_cast<double>(us.size());
  state.counters["coarse"] = tool.coarse;
  state.counters["late"] = tool.late;
}
BENCHMARK(BM_PointshellLight)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Iterations(10'000)
    ->Unit(benchmark::kMicrosecond);

// A mesh of 300 k triangles at 256 voxels along its longest side.
void BM_DistanceFieldBuild(benchmark::State& state) {
  const TriMesh mesh = bumpySphere(0.05, 7);
  std::size_t bytes = 0;
  for (auto _ : state) bytes = fieldOf(mesh, 0.1 / 256).roomBytes();
  state.counters["triangles"] = static_cast<double>(mesh.triangles.size());
  state.counters["MiB"] = static_cast<double>(bytes) / (1 << 20);
}
BENCHMARK(BM_DistanceFieldBuild)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
}  // namespace presa
