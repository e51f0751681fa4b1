#include "apps/presa/explain/module_times.h"

#include <algorithm>
#include <array>
#include <random>

#include "framework/core/graph/stage_watch.h"
#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

using Samples = std::vector<std::int64_t>;

double quantile(Samples& samples, double q) {
  if (samples.empty()) return 0;
  const auto at = std::min(samples.size() - 1, static_cast<std::size_t>(q * static_cast<double>(samples.size())));
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(at), samples.end());
  return static_cast<double>(samples[at]);
}

TickTime timeOf(Samples& samples) {
  return {std::max(0.0, quantile(samples, 0.5)), std::max(0.0, quantile(samples, 0.999)), samples.size()};
}

/// Of a pair of reads with nothing between.
std::int64_t clockCost() {
  Samples samples;
  for (int i = 0; i < 1001; ++i) {
    const std::int64_t begin = monotonicNs();
    samples.push_back(monotonicNs() - begin);
  }
  return static_cast<std::int64_t>(quantile(samples, 0.5));
}

/// Adds up the parts of one tick. The clock is read twice between two stages, so that the bookkeeping belongs to neither.
class StageClock final : public StageWatch {
 public:
  explicit StageClock(std::size_t stages) : sums_(stages), samples_(stages) {}

  void done(std::size_t stage) noexcept override {
    sums_[stage] += monotonicNs() - since_ - cost_;
    since_ = monotonicNs();
  }
  void time(WatchedStages& module, const Tick& tick) {
    std::fill(sums_.begin(), sums_.end(), 0);
    since_ = monotonicNs();
    module.stepWatched(tick, *this);
    for (std::size_t s = 0; s < sums_.size(); ++s) samples_[s].push_back(sums_[s]);
  }
  /// By stage, one a tick.
  std::vector<Samples>& samples() { return samples_; }

 private:
  Samples sums_;
  std::vector<Samples> samples_;
  std::int64_t since_ = 0;
  std::int64_t cost_ = clockCost();
};

/// A module and what is known of it so far.
class Timed {
 public:
  Timed(Graph& graph, RateGroup group, std::size_t index)
      : graph_(graph),
        group_(group),
        index_(index),
        watched_(dynamic_cast<WatchedStages*>(graph.modules(group)[index])),
        stages_(graph.modules(group)[index]->stages().size()) {
    for (const Connection& connection : graph.connections()) {
      const bool ours = connection.bridge != nullptr && &connection.from->owner() == graph.modules(group)[index];
      if (ours && std::find(bridges_.begin(), bridges_.end(), connection.bridge) == bridges_.end())
        bridges_.push_back(connection.bridge);
    }
  }
  /// In one piece or, by chance, stage by stage; a frame is rare and long enough for both.
  void step(const Tick& tick, bool by_stages) {
    if (watched_ != nullptr && (by_stages || group_ == RateGroup::kView)) {
      stepByStages(tick);
    } else {
      stepWhole(tick);
    }
  }
  ModuleTime result() {
    ModuleTime time{timeOf(steps_), {}};
    if (watched_ == nullptr) return time;
    for (Samples& samples : stages_.samples()) time.stages.push_back(timeOf(samples));
    return time;
  }

 private:
  void stepWhole(const Tick& tick) {
    const std::int64_t begin = monotonicNs();
    graph_.stepModule(group_, index_, tick);
    steps_.push_back(monotonicNs() - begin - cost_);
  }
  void stepByStages(const Tick& tick) {
    const std::int64_t begin = monotonicNs();
    stages_.time(*watched_, tick);
    for (BridgeBase* bridge : bridges_) bridge->push(tick.time);
    if (group_ == RateGroup::kView) steps_.push_back(monotonicNs() - begin - cost_);
  }

  Graph& graph_;
  RateGroup group_;
  std::size_t index_;
  WatchedStages* watched_;
  StageClock stages_;
  std::vector<BridgeBase*> bridges_;  // that its outputs cross
  Samples steps_;
  std::int64_t cost_ = clockCost();
};

}  // namespace

std::map<std::string, ModuleTime> measureModuleTimes(Graph& graph, const RateTable& rates, double duration) {
  static constexpr std::array kOrder{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic, RateGroup::kView,
                                     RateGroup::kBus};
  std::array<std::vector<Timed>, kRateGroupCount> timed;
  for (const RateGroup group : kOrder) {
    for (std::size_t m = 0; m < graph.modules(group).size(); ++m)
      timed[static_cast<std::size_t>(group)].emplace_back(graph, group, m);
    graph.start(group);
  }
  std::minstd_rand chance(1);  // not every second tick: the slower groups meet the haptic one always at the same ones
  for (std::uint64_t i = 0; i < rates.ticksWithin(RateGroup::kHaptic, duration); ++i) {
    for (const RateGroup group : kOrder) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (!graph.runs(group) || i % divisor != 0) continue;
      graph.pull(group);
      const Tick tick = rates.tick(group, i / divisor);
      for (Timed& module : timed[static_cast<std::size_t>(group)]) module.step(tick, chance() % 2 == 0);
    }
  }
  std::map<std::string, ModuleTime> times;
  for (const RateGroup group : kOrder) {
    const auto& modules = graph.modules(group);
    for (std::size_t m = 0; m < modules.size(); ++m)
      times[modules[m]->name()] = timed[static_cast<std::size_t>(group)][m].result();
  }
  for (auto group = kOrder.rbegin(); group != kOrder.rend(); ++group) graph.stop(*group);
  return times;
}

}  // namespace presa
