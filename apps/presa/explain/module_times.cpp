#include "apps/presa/explain/module_times.h"

#include <algorithm>
#include <array>
#include <vector>

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

/// Time between two reads of the clock with nothing between them.
std::int64_t clockCost() {
  Samples samples;
  for (int i = 0; i < 1001; ++i) {
    const std::int64_t begin = monotonicNs();
    samples.push_back(monotonicNs() - begin);
  }
  return static_cast<std::int64_t>(quantile(samples, 0.5));
}

ModuleTime timeOf(Samples& samples, std::int64_t clock_cost) {
  const auto net = [&](double q) { return std::max(0.0, quantile(samples, q) - static_cast<double>(clock_cost)); };
  return {net(0.5), net(0.999), samples.size()};
}

}  // namespace

std::map<std::string, ModuleTime> measureModuleTimes(Graph& graph, const RateTable& rates, double duration) {
  static constexpr std::array kOrder{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic, RateGroup::kView,
                                     RateGroup::kBus};
  const std::int64_t clock_cost = clockCost();
  std::array<std::vector<Samples>, kRateGroupCount> samples;  // by group, by module
  for (const RateGroup group : kOrder) {
    samples[static_cast<std::size_t>(group)].resize(graph.modules(group).size());
    graph.start(group);
  }
  for (std::uint64_t i = 0; i < rates.ticksWithin(RateGroup::kHaptic, duration); ++i) {
    for (const RateGroup group : kOrder) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (!graph.runs(group) || i % divisor != 0) continue;
      const Tick tick = rates.tick(group, i / divisor);
      graph.pull(group, tick);
      for (std::size_t m = 0; m < graph.modules(group).size(); ++m) {
        const std::int64_t begin = monotonicNs();
        graph.stepModule(group, m, tick);
        samples[static_cast<std::size_t>(group)][m].push_back(monotonicNs() - begin);
      }
    }
  }
  std::map<std::string, ModuleTime> times;
  for (const RateGroup group : kOrder) {
    const auto& modules = graph.modules(group);
    for (std::size_t m = 0; m < modules.size(); ++m)
      times[modules[m]->name()] = timeOf(samples[static_cast<std::size_t>(group)][m], clock_cost);
  }
  for (auto group = kOrder.rbegin(); group != kOrder.rend(); ++group) graph.stop(*group);
  return times;
}

}  // namespace presa
