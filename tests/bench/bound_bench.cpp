#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/lap_timer.h"
#include "tests/bench/plain_tree.h"
#include "tests/bench/touched.h"

// Lower bound of proxy_tick: only the search for the surface in each tick, in a plain tree, without temporal coherence.
namespace presa::bench {
namespace {

const PlainTree& treeOf(int triangles) {
  static int made = 0;
  static std::unique_ptr<const PlainTree> tree;
  if (made != triangles) {
    tree.reset();
    tree = std::make_unique<const PlainTree>(*sphereMesh(triangles));
    made = triangles;
  }
  return *tree;
}

/// One query: the point of the mesh closest to the centre of the fingertip, which rests on the surface along the path
/// of proxy_tick, and all triangles that the fingertip touches.
void query(benchmark::State& state, int triangles, double radius) {
  constexpr std::size_t kBlock = 5;
  const PlainTree& tree = treeOf(triangles);
  std::vector<Vec3> centres;
  for (const Vec3& direction : wayAround(kSphere + radius - kDepth)) {
    centres.push_back(tree.rest((kSphere + radius) * direction, -direction, radius));
  }
  Windows singles(centres.size()), blocks(centres.size() / kBlock);
  PlainTree::Found found;
  double touched = 0, queries = 0;
  const auto ask = [&](std::size_t i) {
    tree.query(centres[i], radius * (1 + 1e-3), found);
    benchmark::DoNotOptimize(found.nearest);
  };
  for (auto _ : state) {
    for (int pass = 0; pass < 5; ++pass) {
      for (std::size_t i = 0; i < centres.size(); ++i) {
        singles.add(i, cpuNsOf([&] { ask(i); }));
        touched += static_cast<double>(found.within.size());
        ++queries;
      }
      for (std::size_t i = 0; i < centres.size(); i += kBlock) {
        blocks.add(i / kBlock, cpuNsOf([&] {
                     for (std::size_t k = i; k < i + kBlock; ++k) ask(k);
                   }));
      }
    }
  }
  state.counters["p50_us"] = blocks.own(0.5) / kBlock;
  state.counters["mean_us"] = blocks.mean() / kBlock;
  state.counters["p99_us"] = singles.own(0.99);
  state.counters["p99_raw_us"] = singles.raw(0.99);
  state.counters["touched"] = touched / queries;
}

const bool kBoundRegistered = [] {
  const std::pair<const char*, double> radii[] = {{"r0", 0}, {"r0p1mm", 1e-4}, {"r1mm", 1e-3}, {"r8mm", 8e-3}};
  for (const int n : {20'480, 327'680, 1'310'720}) {
    for (const auto& [size, radius] : radii) {
      benchmark::RegisterBenchmark(("bound/sphere_" + std::to_string(n) + "/" + size).c_str(),
                                   [=, radius = radius](benchmark::State& state) { query(state, n, radius); })
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
}  // namespace presa::bench
