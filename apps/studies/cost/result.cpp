#include "apps/studies/cost/result.h"

#include <algorithm>

#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

template <class Value>
Spread spread(const std::vector<Timing>& timings, Value value) {
  std::vector<double> values;
  for (const Timing& timing : timings) values.push_back(value(timing));
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {median, values.front(), values.back()};
}

}  // namespace

double Result::resolution(const std::string& metric) const {
  const auto found = reference.residual.find(metric);
  return findMetric(metric)->absolute || found == reference.residual.end() ? 0 : 10 * found->second;
}

double Result::claimed(const Outcome& outcome, const std::string& metric) const {
  return std::max({outcome.error.at(metric), resolution(metric), kRounding});
}

bool Result::resolved(const Outcome& outcome, const std::string& metric) const {
  const auto error = outcome.error.find(metric);
  return error == outcome.error.end() || error->second >= resolution(metric);
}

Spread Outcome::perSecond() const {
  return spread(timings, [](const Timing& t) { return t.per_second; });
}
Spread Outcome::busiestTick() const {
  return spread(timings, [](const Timing& t) { return t.busiestTick(); });
}
Spread Outcome::load() const {
  return spread(timings, [](const Timing& t) { return t.load; });
}
Spread Outcome::memory() const {
  return spread(timings, [](const Timing& t) { return t.memory; });
}

}  // namespace presa::cost
