#include "apps/studies/cost/front.h"

#include <algorithm>
#include <cstdlib>

#include "apps/common/terminal/text.h"
#include "apps/studies/cost/condition_factor.h"

namespace presa::cost {
namespace {

constexpr const char* kEngineFactor = "engine";

double asPrinted(double value) { return std::strtod(terminal::format("%.3g", value).c_str(), nullptr); }

std::string engineOf(const Setting& setting) {
  for (const auto& [name, value] : setting.choices) {
    if (name == kEngineFactor) return value;
  }
  return {};
}

}  // namespace

std::vector<Judged> judged(const Result& result, const std::string& metric) {
  std::vector<Judged> all;
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome& outcome = result.outcomes[i];
    if (!outcome.failure.empty() || !outcome.timed() || !outcome.error.contains(metric)) continue;
    all.push_back({i, outcome.perSecond(), asPrinted(result.claimed(outcome, metric))});
  }
  return all;
}

bool noDearer(const Judged& a, const Judged& b) { return a.cost.median <= kSameCost * b.cost.median; }

bool cheaper(const Judged& a, const Judged& b) {
  return kSameCost * a.cost.median < b.cost.median && a.cost.high < b.cost.low;
}

bool beats(const Judged& a, const Judged& b) {
  return (a.error < b.error && noDearer(a, b)) || (a.error <= b.error && cheaper(a, b));
}

bool comparable(const Result& result, std::size_t index) {
  const Setting& setting = result.outcomes[index].setting;
  return engineOf(setting) == engineOf(result.outcomes.front().setting) && !hasConditions(setting);
}

std::vector<Judged> frontOf(const Result& result, const std::string& metric) {
  std::vector<Judged> all = judged(result, metric);
  std::erase_if(all, [&](const Judged& each) { return !comparable(result, each.index); });
  const auto cheapest_first = [](const Judged& a, const Judged& b) { return a.cost.median < b.cost.median; };
  std::stable_sort(all.begin(), all.end(), cheapest_first);
  // most of thousands of settings are less accurate than one that is no dearer: the min error up to a cost tells
  std::vector<double> min_error;
  for (const Judged& each : all)
    min_error.push_back(min_error.empty() ? each.error : std::min(min_error.back(), each.error));
  std::vector<Judged> front;
  std::size_t no_dearer = 0;
  for (const Judged& each : all) {
    while (no_dearer < all.size() && noDearer(all[no_dearer], each)) ++no_dearer;
    if (min_error[no_dearer - 1] < each.error) continue;
    if (std::none_of(all.begin(), all.end(), [&](const Judged& other) { return beats(other, each); }))
      front.push_back(each);
  }
  return front;
}

std::optional<FrontDistance> distanceToFront(const Result& result, const std::string& metric) {
  const std::vector<Judged> all = judged(result, metric);
  if (all.empty() || all.front().index != 0) return std::nullopt;
  const Judged &usual = all.front(), *as_accurate = &usual, *as_cheap = &usual;
  for (const Judged& each : all) {
    if (!comparable(result, each.index)) continue;
    if (each.error <= usual.error && cheaper(each, usual) && each.cost.median < as_accurate->cost.median)
      as_accurate = &each;
    if (noDearer(each, usual) && each.error < as_cheap->error) as_cheap = &each;
  }
  return FrontDistance{usual.cost.median / as_accurate->cost.median, usual.error / as_cheap->error, as_accurate->index,
                       as_cheap->index};
}

std::optional<std::size_t> cheapestBelow(const Result& result, const std::string& metric, double limit) {
  std::optional<Judged> best;
  for (const Judged& each : judged(result, metric)) {
    const Outcome& outcome = result.outcomes[each.index];
    if (hasConditions(outcome.setting) || !(result.claimed(outcome, metric) < limit)) continue;
    if (!best || each.cost.median < best->cost.median ||
        (each.cost.median == best->cost.median && each.error < best->error))
      best = each;
  }
  return best ? std::optional(best->index) : std::nullopt;
}

bool isUnfelt(const Result& result, std::size_t index) {
  const Outcome& outcome = result.outcomes[index];
  return std::all_of(result.metrics.begin(), result.metrics.end(), [&](const std::string& metric) {
    const auto limit = result.reference.noticeable.find(metric);
    if (limit == result.reference.noticeable.end()) return true;
    return outcome.error.contains(metric) && result.claimed(outcome, metric) < limit->second;
  });
}

std::optional<std::size_t> cheapestUnfelt(const Result& result) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome& outcome = result.outcomes[i];
    if (!isUnfelt(result, i) || !outcome.failure.empty() || !outcome.timed() || hasConditions(outcome.setting))
      continue;
    if (!best || outcome.perSecond().median < result.outcomes[*best].perSecond().median) best = i;
  }
  return best;
}

}  // namespace presa::cost
