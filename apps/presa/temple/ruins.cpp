#include "apps/presa/temple/ruins.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "apps/presa/atomic_file.h"
#include "apps/presa/temple/drop.h"
#include "apps/presa/temple/spots.h"
#include "framework/diagnostics/refuse.h"

namespace presa::temple {
namespace {

constexpr std::size_t kGroup = 8;
constexpr int kAttempts = 12;      // of a group
constexpr double kRound = 0.2;     // from rest to rest [s]
constexpr int kRounds = 15;        // of a group
constexpr int kLastRounds = 60;    // of all together
constexpr double kLies = 3e-4;     // moved less in a round: lies, while others still fall [m]
constexpr double kStill = 1e-4;    // the same at the end, over a second [m]
constexpr double kLastSecond = 1;  // [s]

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
    while (lying_.size() < order_.size()) {
      if (!strewGroup()) return {};
    }
    if (!settleAll()) return {};
    ruins_.X_WB.resize(building_.blocks.size());
    for (const SceneSpec::Stone& stone : lying_) ruins_.X_WB[stone.block] = stone.X_WB;
    return std::move(ruins_);
  }

 private:
  std::size_t all() const { return order_.size(); }
  const std::string& nameOf(const SceneSpec::Stone& stone) const { return building_.blocks[stone.block].name; }
  DropResult run(const std::vector<SceneSpec::Stone>& stones, double duration) {
    ruins_.simulated_seconds += duration;
    return drop(building_, stones, duration, folder_);
  }

  /// The next blocks over spots that are free of each other.
  std::vector<SceneSpec::Stone> drawGroup(RandomStream& random) {
    std::vector<SceneSpec::Stone> group;
    const std::size_t before = spots_.count();
    while (group.size() < kGroup && lying_.size() + group.size() < all()) {
      const std::size_t block = order_[lying_.size() + group.size()];
      Pose X_WB;
      if (!spots_.find(building_.blocks[block], before, random, X_WB)) break;
      group.push_back({block, X_WB, false});
      spots_.take(cornersOf(building_.blocks[block], X_WB));
    }
    spots_.keep(before);
    if (group.empty())
      refuse(977, building_.name,
             "the field of 600 x 300 mm beside the building has no room for block " +
                 quote(building_.blocks[order_[lying_.size()]].name),
             "take a smaller module");
    return group;
  }

  bool strewGroup() {
    std::string restless;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      RandomStream random(seed_, "ruins", 1000 * lying_.size() + static_cast<std::size_t>(attempt));
      std::vector<SceneSpec::Stone> group = drawGroup(random);
      // what lies is as firm as the ground for now
      std::vector<SceneSpec::Stone> stones = lying_;
      for (SceneSpec::Stone& stone : stones) stone.fixed = true;
      stones.insert(stones.end(), group.begin(), group.end());
      restless = nameOf(group.front());
      for (int round = 0; round < kRounds && !restless.empty(); ++round) {
        const DropResult result = run(stones, kRound);
        restless.clear();
        for (std::size_t i = lying_.size(); i < stones.size(); ++i) {
          stones[i].X_WB = result.X_WB[i];
          if (!result.sound || result.moved[i] > kLies) restless = nameOf(stones[i]);
        }
        if (!progress_(lying_.size(), all(), "falling: " + nameOf(group.front()))) return false;
      }
      for (std::size_t i = lying_.size(); i < stones.size(); ++i) {
        if (!field_.holds(stones[i].X_WB.p)) restless = nameOf(stones[i]);
      }
      if (!restless.empty()) continue;
      for (std::size_t i = lying_.size(); i < stones.size(); ++i) {
        spots_.take(cornersOf(building_.blocks[stones[i].block], stones[i].X_WB));
      }
      for (SceneSpec::Stone& stone : stones) stone.fixed = false;
      lying_ = std::move(stones);
      return true;
    }
    refuseRestless(restless);
  }

  bool settleAll() {
    std::string restless;
    for (int round = 0; round < kLastRounds; ++round) {
      DropResult result = run(lying_, kRound);
      if (largest(result) < kStill) {
        result = run(lying_, kLastSecond);
        ruins_.still = largest(result);
        if (ruins_.still < kStill) return true;
      }
      for (std::size_t i = 0; i < lying_.size(); ++i) {
        lying_[i].X_WB = result.X_WB[i];
        if (result.moved[i] >= kStill) restless = nameOf(lying_[i]);
      }
      if (!progress_(lying_.size(), all(), "settling: " + restless)) return false;
    }
    refuseRestless(restless);
  }

  static double largest(const DropResult& result) {
    return result.sound ? *std::max_element(result.moved.begin(), result.moved.end()) : 1e300;
  }

  [[noreturn]] void refuseRestless(const std::string& name) const {
    refuse(974, building_.name, "block " + quote(name) + " has not come to rest on the field",
           "another --seed strews the blocks another way");
  }

  const Building& building_;
  const std::uint64_t seed_;
  const std::string folder_;
  const RuinsProgress& progress_;
  const Field field_;
  Spots spots_;
  std::vector<std::size_t> order_;
  std::vector<SceneSpec::Stone> lying_;
  Ruins ruins_;
};

}  // namespace

Ruins strewRuins(const Building& building, std::uint64_t seed, const std::string& folder,
                 const RuinsProgress& progress) {
  return Strewing(building, seed, folder, progress).strew();
}

}  // namespace presa::temple
