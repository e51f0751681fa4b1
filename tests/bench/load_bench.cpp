#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/input/folders.h"
#include "modules/collision_fcl/collision_module.h"
#include "modules/haptics_proxy/haptics_proxy.h"
#include "tests/bench/lap_timer.h"
#include "tests/bench/touched.h"

// Work before a run: building the hierarchy of the collision thread, and reading a big mesh from its file.
namespace presa::bench {
namespace {

void report(benchmark::State& state, std::vector<double> us) {
  std::ranges::sort(us);
  state.counters["p50_us"] = us[us.size() / 2];
  state.counters["p99_us"] = us[us.size() * 99 / 100];
}

template <class Build>
void timeEach(benchmark::State& state, const Build& build) {
  std::vector<double> us;
  for (auto _ : state) us.push_back(static_cast<double>(cpuNsOf(build)) * 1e-3);
  report(state, us);
}

void buildMeshTree(benchmark::State& state, int triangles) {
  const auto mesh = sphereMesh(triangles);
  timeEach(state, [&] { benchmark::DoNotOptimize(std::make_shared<const MeshTree>(mesh)); });
}

std::string writeObj(const TriMesh& mesh) {
  std::string file = std::filesystem::temp_directory_path() / "presa_bench_XXXXXX.obj";
  const int handle = mkstemps(file.data(), 4);
  std::FILE* out = handle < 0 ? nullptr : fdopen(handle, "w");
  if (out == nullptr) return "";
  for (const Vec3& v : mesh.vertices) std::fprintf(out, "v %.9g %.9g %.9g\n", v.x(), v.y(), v.z());
  for (const TriMesh::Triangle& t : mesh.triangles) std::fprintf(out, "f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return std::fclose(out) == 0 ? file : "";
}

/// Loads a scene with this single fixed body; false: it failed.
bool load(const std::string& file) {
  input::allowFolder(std::filesystem::path(file).parent_path().string());
  Scene scene = worldOf({{}}, 8e-3)->scene;
  scene.bodies[0].haptic = Geometry{MeshRef{.file = file}, {}, {}};
  Diagnostics diagnostics;
  const auto world = std::make_shared<const World>(buildWorld(std::move(scene), {}, diagnostics));
  if (diagnostics.hasErrors() || !world->meshes[0].haptic) return false;
  const HapticsProxy haptics(world, RunOptions{});
  const CollisionModule collision(world);
  return true;
}

struct LoadedMesh {
  double us = 0;
  double peak_mib = 0;
  bool well = false;
};

constexpr const char* kFileToLoad = "PRESA_BENCH_LOAD";

/// Loads the file in a new process of this program, so that its peak memory is that of the load.
LoadedMesh loadApart(const std::string& file, const std::string& benchmark) {
  setenv(kFileToLoad, file.c_str(), 1);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl("/proc/self/exe", "presa_bench", ("--benchmark_filter=^" + benchmark + "$").c_str(), nullptr);
    _exit(1);
  }
  unsetenv(kFileToLoad);
  int status = -1;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) != child) return {};
  const auto us = [](const timeval& t) { return 1e6 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec); };
  return {us(used.ru_utime) + us(used.ru_stime), static_cast<double>(used.ru_maxrss) / 1024, status == 0};
}

/// From the file to a world with its modules: processor time, including the kernel's, and peak memory.
void loadSphere(benchmark::State& state, int triangles) {
  if (const char* file = std::getenv(kFileToLoad)) _exit(load(file) ? 0 : 1);
  const std::string file = writeObj(*sphereMesh(triangles));
  std::vector<double> us;
  double peak_mib = 0;
  for (auto _ : state) {
    const LoadedMesh loaded = loadApart(file, "load/sphere_" + std::to_string(triangles));
    if (!loaded.well) {
      state.SkipWithError("the mesh was not loaded");
      break;
    }
    us.push_back(loaded.us);
    peak_mib = std::max(peak_mib, loaded.peak_mib);
  }
  std::filesystem::remove(file);
  if (us.empty()) return;
  report(state, us);
  state.counters["peak_mib"] = peak_mib;
}

const bool kLoadRegistered = [] {
  const auto add = [](const std::string& name, void (*measure)(benchmark::State&, int), int triangles) {
    benchmark::RegisterBenchmark((name + "/sphere_" + std::to_string(triangles)).c_str(), [=](benchmark::State& state) {
      measure(state, triangles);
    })->Unit(benchmark::kMillisecond);
  };
  add("load", loadSphere, 1'310'720);
  for (const int n : {20'480, 327'680, 1'310'720}) {
    add("bvh_build", buildMeshTree, n);
  }
  return true;
}();

}  // namespace
}  // namespace presa::bench
