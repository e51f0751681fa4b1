#include "apps/temple/ruins.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "apps/common/atomic_file.h"
#include "apps/temple/drop.h"
#include "apps/temple/spots.h"
#include "apps/temple/standing_blocks.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::temple {
namespace {

constexpr std::size_t kGroup = 8;
constexpr int kGroups = 60;        // max; a façade needs about ten
constexpr int kAttempts = 20;      // to drop blocks again that do not come to rest with all others
constexpr double kRound = 0.2;     // duration of a round, which starts from rest [s]
constexpr int kRounds = 15;        // max rounds of a group
constexpr int kLastRounds = 8;     // max rounds of all blocks together
constexpr double kLastSecond = 1;  // duration of the last round [s]
// A block at rest moves less than this in a round [m]. Jitter in a heap, from the iterative solver, is tolerated.
constexpr double kStill = 2e-4;

class Strewing {
 public:
  Strewing(const Building& building, std::uint64_t seed, std::string folder, const RuinsProgress& progress)
      : building_(building),
        seed_(seed),
        folder_(std::move(folder)),
        progress_(progress),
        field_(fieldFor(building)),
        spots_(field_) {
    std::filesystem::create_directories(std::filesystem::path(folder_) / "meshes");
    for (const SceneFile& file : meshFiles(building, true)) writeFileAtomically(folder_ + "/" + file.path, file.text);
    order_.resize(building.blocks.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return radiusOf(building.blocks[a].haptic) > radiusOf(building.blocks[b].haptic);
    });
  }

  Ruins strew() {
    std::uint64_t group = 0;
    waiting_ = order_;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      for (int fallen = 0; fallen < kGroups && !waiting_.empty(); ++fallen) {
        if (!strewGroup(group++)) return {};
      }
      if (!waiting_.empty()) break;
      if (!settleAll()) return {};
      if (restless_.empty()) {
        ruins_.X_WB.resize(all());
        for (const SceneSpec::Stone& stone : lying_) ruins_.X_WB[stone.block] = stone.X_WB;
        return std::move(ruins_);
      }
      takeUp();
    }
    refuse(974, building_.name,
           "block " + quote(building_.blocks[waiting_.front()].name) + " has not come to rest on the field",
           "another --seed distributes the blocks differently");
  }

 private:
  std::size_t all() const { return order_.size(); }
  const std::string& nameOf(const SceneSpec::Stone& stone) const { return building_.blocks[stone.block].name; }
  DropResult run(const std::vector<SceneSpec::Stone>& stones, double duration) {
    ruins_.simulated_seconds += duration;
    return drop(building_, stones, duration, folder_);
  }

  /// Chooses the next blocks and their spots, which do not overlap.
  std::vector<SceneSpec::Stone> drawGroup(RandomStream& random) {
    std::vector<SceneSpec::Stone> group;
    const std::size_t before = spots_.count();
    for (const std::size_t block : waiting_) {
      Pose X_WB;
      if (group.size() == kGroup || !spots_.find(building_.blocks[block], before, random, X_WB)) break;
      group.push_back({block, X_WB, false});
      spots_.take(cornersOf(building_.blocks[block], X_WB));
    }
    spots_.keep(before);
    if (group.empty())
      refuse(977, building_.name,
             "the field of 600 x 300 mm beside the building has no room for block " +
                 quote(building_.blocks[waiting_.front()].name),
             "take a smaller module");
    return group;
  }

  /// Drops the next group. Blocks that come to rest stay; the others will be dropped elsewhere. False when stopped.
  bool strewGroup(std::uint64_t number) {
    RandomStream random(seed_, "ruins", number);
    const std::vector<SceneSpec::Stone> group = drawGroup(random);
    // blocks at rest are fixed for now
    std::vector<SceneSpec::Stone> stones = lying_;
    for (SceneSpec::Stone& stone : stones) stone.fixed = true;
    stones.insert(stones.end(), group.begin(), group.end());
    std::vector<char> lies(stones.size(), 0);
    for (int round = 0; round < kRounds && std::count(lies.begin(), lies.end(), 0) > 0; ++round) {
      const DropResult result = run(stones, kRound);
      for (std::size_t i = 0; i < stones.size(); ++i) {
        lies[i] = stones[i].fixed || (result.sound && result.moved[i] < kStill) ? 1 : 0;
        if (!stones[i].fixed) stones[i].X_WB = result.X_WB[i];
      }
      if (!progress_(lying_.size(), all(), "falling: " + nameOf(group.front()))) return false;
    }
    for (std::size_t i = lying_.size(); i < stones.size(); ++i) {
      if (lies[i] == 0 || !field_.holds(stones[i].X_WB.p)) continue;
      std::erase(waiting_, stones[i].block);
      spots_.take(cornersOf(building_.blocks[stones[i].block], stones[i].X_WB));
      lying_.push_back({stones[i].block, stones[i].X_WB, false});
    }
    return true;
  }

  /// Frees all blocks and runs until none moves. Blocks that still move at the end go into restless_. False when
  /// stopped.
  bool settleAll() {
    for (int round = 0; round < kLastRounds; ++round) {
      // every fourth round is long enough for blocks to roll off inclined faces
      DropResult result = run(lying_, round % 4 == 3 ? kLastSecond : kRound);
      if (largest(result) < kStill) result = run(lying_, kLastSecond);
      ruins_.still = largest(result);
      restless_.clear();
      for (std::size_t i = 0; i < lying_.size(); ++i) {
        if (!result.sound || result.moved[i] >= kStill || !field_.holds(result.X_WB[i].p))
          restless_.push_back(lying_[i].block);
      }
      if (restless_.empty()) return true;
      for (std::size_t i = 0; i < lying_.size(); ++i) lying_[i].X_WB = result.X_WB[i];
      if (!progress_(lying_.size(), all(), "settling: " + building_.blocks[restless_.front()].name)) return false;
    }
    return true;
  }

  /// Takes up the restless blocks to drop them again elsewhere.
  void takeUp() {
    std::erase_if(lying_, [&](const SceneSpec::Stone& stone) {
      return std::ranges::find(restless_, stone.block) != restless_.end();
    });
    waiting_ = restless_;
    spots_.keep(0);
    for (const SceneSpec::Stone& stone : lying_) spots_.take(cornersOf(building_.blocks[stone.block], stone.X_WB));
  }

  static double largest(const DropResult& result) {
    return result.sound ? *std::max_element(result.moved.begin(), result.moved.end()) : 1e300;
  }

  const Building& building_;
  const std::uint64_t seed_;
  const std::string folder_;
  const RuinsProgress& progress_;
  const Field field_;
  Spots spots_;
  std::vector<std::size_t> order_, waiting_, restless_;  // blocks
  std::vector<SceneSpec::Stone> lying_;
  Ruins ruins_;
};

}  // namespace

Ruins strewRuins(const Building& building, std::uint64_t seed, const std::string& folder,
                 const RuinsProgress& progress) {
  if (building.upright) return standBlocks(building, seed);
  return Strewing(building, seed, folder, progress).strew();
}

}  // namespace presa::temple
