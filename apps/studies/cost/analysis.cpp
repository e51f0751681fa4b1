#include "apps/studies/cost/analysis.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/common/terminal/text.h"

namespace presa::cost {
namespace {

// other engines serve only for comparison: they do not support fingers, so none can be a default
constexpr const char* kEngineFactor = "engine";

/// True when the outcome has an error in this metric and a cost.
bool shown(const Outcome& outcome, const std::string& metric) {
  return outcome.failure.empty() && outcome.timed() && outcome.error.contains(metric);
}

std::optional<double> numeric(const std::string& text) {
  double value = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || rest != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The only factor in which two settings differ; null when they differ in none or several.
const std::string* onlyDifference(const Setting& a, const Setting& b) {
  const std::string* found = nullptr;
  for (std::size_t k = 0; k < a.choices.size() && k < b.choices.size(); ++k) {
    if (a.choices[k].second == b.choices[k].second) continue;
    if (found != nullptr) return nullptr;
    found = &a.choices[k].first;
  }
  return found;
}

std::string valueOf(const Setting& setting, const std::string& factor) {
  for (const auto& [name, value] : setting.choices) {
    if (name == factor) return value;
  }
  return {};
}

}  // namespace

std::string withUnit(double value, const std::string& unit) {
  return terminal::format("%.3g", value) + (unit.empty() ? "" : " " + unit);
}

std::vector<std::size_t> paretoFront(const Result& result, const std::string& metric, CostOf cost_of) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    if (shown(result.outcomes[i], metric)) order.push_back(i);
  }
  const auto cost = [&](std::size_t i) { return (result.outcomes[i].*cost_of)().median; };
  const auto error = [&](std::size_t i) { return result.claimed(result.outcomes[i], metric); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return cost(a) != cost(b) ? cost(a) < cost(b) : error(a) < error(b); });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || error(i) < error(front.back())) front.push_back(i);
  }
  return front;
}

std::optional<FrontDistance> distanceToFront(const Result& result, const std::string& metric) {
  if (result.outcomes.empty() || !shown(result.outcomes.front(), metric)) return std::nullopt;
  const auto cost = [&](std::size_t i) { return result.outcomes[i].perSecond().median; };
  const auto error = [&](std::size_t i) { return result.claimed(result.outcomes[i], metric); };
  FrontDistance found;
  for (std::size_t i = 1; i < result.outcomes.size(); ++i) {
    const Setting& setting = result.outcomes[i].setting;
    const bool eligible = valueOf(setting, kEngineFactor) == valueOf(result.outcomes.front().setting, kEngineFactor);
    if (!shown(result.outcomes[i], metric) || !eligible) continue;
    if (error(i) <= error(0) && cost(i) < cost(found.as_accurate)) found.as_accurate = i;
    if (cost(i) <= cost(0) && error(i) < error(found.as_cheap)) found.as_cheap = i;
  }
  const auto over = [](double a, double b) { return a > b ? a / b : 1; };
  found.cost = over(cost(0), cost(found.as_accurate));
  found.error = over(error(0), error(found.as_cheap));
  return found;
}

std::vector<FactorGain> factorGains(const Result& result, const std::string& metric) {
  std::vector<FactorGain> gains;
  if (result.outcomes.empty() || !shown(result.outcomes.front(), metric)) return gains;
  const Outcome& usual = result.outcomes.front();
  // an error ratio is meaningless when the error is below the uncertainty of the reference
  const double known = std::max(kRounding, result.resolution(metric) / 10);
  const Spread cost = usual.perSecond();
  for (const Outcome& other : result.outcomes) {
    if (!shown(other, metric)) continue;
    const std::string* factor = onlyDifference(usual.setting, other.setting);
    if (factor == nullptr || !(usual.error.at(metric) > known) || !(cost.median > 0)) continue;
    const Spread changed = other.perSecond();
    FactorGain gain{*factor,
                    valueOf(usual.setting, *factor),
                    valueOf(other.setting, *factor),
                    changed.median / cost.median,
                    other.error.at(metric) / usual.error.at(metric),
                    std::nullopt};
    // a change within the spread of the repeats does not count
    const bool apart = changed.low > cost.high || changed.high < cost.low;
    if (apart && std::abs(std::log(gain.cost_ratio)) > 0.05 && gain.error_ratio > 0)
      gain.per_double_cost = std::pow(gain.error_ratio, std::log(2.0) / std::log(gain.cost_ratio));
    gains.push_back(gain);
  }
  std::stable_sort(gains.begin(), gains.end(), [&](const FactorGain& a, const FactorGain& b) {
    const auto place = [&](const std::string& name) {
      return std::find_if(result.study.factors.begin(), result.study.factors.end(),
                          [&](const Factor& factor) { return factor.name == name; }) -
             result.study.factors.begin();
    };
    return place(a.factor) < place(b.factor);
  });
  return gains;
}

std::optional<std::size_t> cheapestBelow(const Result& result, const std::string& metric, double limit) {
  for (const std::size_t i : paretoFront(result, metric)) {
    if (result.claimed(result.outcomes[i], metric) < limit) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> cheapestUnfelt(const Result& result) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.outcomes.size(); ++i) {
    const Outcome& outcome = result.outcomes[i];
    const bool unfelt = std::all_of(result.metrics.begin(), result.metrics.end(), [&](const std::string& metric) {
      const auto limit = result.reference.noticeable.find(metric);
      if (limit == result.reference.noticeable.end()) return true;
      return outcome.error.contains(metric) && result.claimed(outcome, metric) < limit->second;
    });
    if (!unfelt || !outcome.failure.empty() || !outcome.timed()) continue;
    if (!best || outcome.perSecond().median < result.outcomes[*best].perSecond().median) best = i;
  }
  return best;
}

std::optional<double> observedOrder(const Result& result, const std::string& metric, const std::string& factor) {
  double n = 0, x_sum = 0, y_sum = 0, xx = 0, xy = 0;
  for (const Outcome& outcome : result.outcomes) {
    const std::string* difference = onlyDifference(result.outcomes.front().setting, outcome.setting);
    const bool along = &outcome == &result.outcomes.front() || (difference != nullptr && *difference == factor);
    const std::optional<double> value = numeric(valueOf(outcome.setting, factor));
    const auto error = outcome.error.find(metric);
    if (!along || !value || !(*value > 0) || !outcome.failure.empty() || error == outcome.error.end()) continue;
    if (!(error->second > 0)) continue;
    const double x = std::log(*value), y = std::log(error->second);
    n += 1, x_sum += x, y_sum += y, xx += x * x, xy += x * y;
  }
  const double spread = n * xx - x_sum * x_sum;
  return n >= 2 && spread > 0 ? std::optional(-(n * xy - x_sum * y_sum) / spread) : std::nullopt;
}

}  // namespace presa::cost
