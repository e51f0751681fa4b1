#include <benchmark/benchmark.h>
#include <malloc.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/state/limits.h"
#include "modules/collision_fcl/mesh_index.h"
#include "tests/bench/lap_timer.h"
#include "tests/bench/touched.h"

// Indices of the collision thread side by side: same mesh, same motion of a probe, same triangles found.
namespace presa::bench {
namespace {

using Index = CollisionSettings::Index;

/// Memory that the process has from the heap [bytes].
double heapBytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
}

/// A mesh of which Presa's hierarchy exists in any case, and an index over it. Made anew for another benchmark only.
struct Indexed {
  Indexed(Index kind, int triangles) {
    const std::shared_ptr<const TriMesh> mesh = sphereMesh(triangles);
    const double empty = heapBytes();
    tree = std::make_unique<const MeshTree>(mesh);
    tree_mib = (heapBytes() - empty) / 0x1p20;
    found = std::make_unique<FacetSet>(static_cast<std::size_t>(triangles));
    const double before = heapBytes();
    build_ms = static_cast<double>(cpuNsOf([&] { index = makeMeshIndex(kind, *tree); })) * 1e-6;
    index_mib = (heapBytes() - before) / 0x1p20;
  }
  std::unique_ptr<const MeshTree> tree;
  std::unique_ptr<MeshIndex> index;
  std::unique_ptr<FacetSet> found;
  double tree_mib = 0, index_mib = 0, build_ms = 0;
};

Indexed& indexed(Index kind, int triangles) {
  static std::pair<Index, int> made{Index::kTree, 0};
  static std::unique_ptr<Indexed> all;
  if (made != std::pair(kind, triangles)) {
    all.reset();
    all = std::make_unique<Indexed>(kind, triangles);
    made = {kind, triangles};
  }
  return *all;
}

enum class Answer { kTriangles, kCut };

/// The ways of a probe in the periods of the collision thread (10 ms, 1 mm) around the sphere, enlarged by `reach`.
/// kTriangles: the set of the triangles within reach, the same under each index. kCut: the nodes that the collision
/// thread hands over; from Presa's own hierarchy it takes them without single triangles.
void query(benchmark::State& state, Index kind, int triangles, double reach, Answer answer) {
  Indexed& all = indexed(kind, triangles);
  std::vector<ProbeWay> ways;
  const std::vector<Vec3> path = wayAround(kSphere);
  const std::size_t stride = reach > 0.02 ? 20 : 1;  // wide ones take long
  for (std::size_t t = 10; t < path.size(); t += 10 * stride)
    ways.push_back({kSphere * path[t - 10], kSphere * path[t], reach});
  std::array<std::int32_t, kMaxCutNodes> cut{};
  Windows queries(ways.size());
  double found = 0, nodes = 0, asked = 0;
  const auto ask = [&](const ProbeWay& way) {
    if (answer == Answer::kCut && kind == Index::kTree) {
      nodes += static_cast<double>(all.tree->cut(way.to, way.radius, cut));
      return;
    }
    all.found->clear();
    all.index->find(way, *all.found);
    if (answer == Answer::kCut) nodes += static_cast<double>(cutAround(*all.found, *all.tree, cut));
    found += static_cast<double>(all.found->all().size());
  };
  for (auto _ : state) {
    for (int pass = 0; pass < 5; ++pass) {
      for (std::size_t i = 0; i < ways.size(); ++i) queries.add(i, cpuNsOf([&] { ask(ways[i]); }));
      asked += static_cast<double>(ways.size());
    }
  }
  state.counters["p50_us"] = queries.own(0.5);
  state.counters["mean_us"] = queries.mean();
  state.counters["p99_us"] = queries.own(0.99);
  state.counters["triangles"] = found / asked;
  state.counters["nodes"] = nodes / asked;
  state.counters["tree_mib"] = all.tree_mib;
  state.counters["index_mib"] = all.index_mib;
  state.counters["build_ms"] = all.build_ms;
}

const bool kIndexRegistered = [] {
  // the point of a probe; a fingertip of 8 mm and what it moves until the next query; the same as the tree takes it, so
  // that it serves for several queries
  const std::pair<const char*, double> reaches[] = {{"r0p1mm", 1e-4}, {"r18mm", 0.018}, {"r67mm", 0.067}};
  const std::pair<const char*, Index> kinds[] = {
      {"tree", Index::kTree}, {"obb", Index::kObb}, {"hcollide", Index::kHcollide}};
  for (const int n : {20'480, 327'680, 1'310'720}) {
    for (const auto& [name, kind] : kinds) {
      for (const auto& [size, reach] : reaches) {
        const std::string which = std::string("/") + name + "/sphere_" + std::to_string(n) + "/" + size;
        const auto add = [&, kind = kind, reach = reach](const std::string& row, Answer answer) {
          benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
            query(state, kind, n, reach, answer);
          })->Unit(benchmark::kMillisecond);
        };
        add("collision_query" + which, Answer::kCut);
        if (reach < 0.02) add("collision_triangles" + which, Answer::kTriangles);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace presa::bench
