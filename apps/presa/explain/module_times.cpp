#include "apps/presa/explain/module_times.h"

#include <algorithm>
#include <array>
#include <vector>

#include "framework/schedule/clock.h"

namespace presa {
namespace {

using Samples = std::vector<std::int64_t>;

double quantile(Samples& samples, double q) {
  if (samples.empty()) return 0;
  const auto at = std::min(samples.size() - 1, static_cast<std::size_t>(q * static_cast<double>(samples.size())));
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(at), samples.end());
  return static_cast<double>(samples[at]);
}

double clockCost() {
  Samples samples;
  for (int i = 0; i < 1001; ++i) {
    const std::int64_t begin = monotonicNs();
    samples.push_back(monotonicNs() - begin);
  }
  return quantile(samples, 0.5);
}

}  // namespace

std::map<std::string, ModuleTime> measureModuleTimes(Graph& graph, const RateTable& rates, double duration) {
  static constexpr std::array kOrder{RateGroup::kDynamics, RateGroup::kCollision, RateGroup::kHaptic, RateGroup::kView};
  std::array<std::vector<Samples>, kRateGroupCount> samples;
  for (const RateGroup group : kOrder) {
    samples[static_cast<std::size_t>(group)].resize(graph.modules(group).size());
    graph.start(group);
  }
  const double clock = clockCost();
  for (std::uint64_t i = 0; i < rates.ticksWithin(RateGroup::kHaptic, duration); ++i) {
    for (const RateGroup group : kOrder) {
      const auto divisor = static_cast<std::uint64_t>(rates.divisor(group));
      if (!graph.runs(group) || i % divisor != 0) continue;
      graph.pull(group);
      for (std::size_t m = 0; m < graph.modules(group).size(); ++m) {
        const std::int64_t begin = monotonicNs();
        graph.stepModule(group, m, rates.tick(group, i / divisor));
        samples[static_cast<std::size_t>(group)][m].push_back(monotonicNs() - begin);
      }
    }
  }
  std::map<std::string, ModuleTime> times;
  for (const RateGroup group : kOrder) {
    for (std::size_t m = 0; m < graph.modules(group).size(); ++m) {
      Samples& own = samples[static_cast<std::size_t>(group)][m];
      times[graph.modules(group)[m]->name()] = {std::max(0.0, quantile(own, 0.5) - clock),
                                                std::max(0.0, quantile(own, 0.999) - clock), own.size()};
    }
  }
  for (auto group = kOrder.rbegin(); group != kOrder.rend(); ++group) graph.stop(*group);
  return times;
}

}  // namespace presa
