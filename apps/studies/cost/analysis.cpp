#include "apps/studies/cost/analysis.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/common/terminal/text.h"
#include "apps/studies/cost/condition_factor.h"

namespace presa::cost {
namespace {

/// True when the outcome has an error in this metric and a cost.
bool shown(const Outcome& outcome, const std::string& metric) {
  return outcome.failure.empty() && outcome.timed() && outcome.error.contains(metric);
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

}  // namespace

std::optional<double> numberIn(const std::string& text) {
  double value = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  return status == std::errc{} && rest == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string valueOf(const Setting& setting, const std::string& factor) {
  for (const auto& [name, value] : setting.choices) {
    if (name == factor) return value;
  }
  return {};
}

std::string setOptions(const std::vector<std::string>& sets) {
  std::string out;
  for (const std::string& set : sets) {
    const bool plain = set.find_first_of(" '\"$") == std::string::npos;
    out += (out.empty() ? "--set " : " --set ") + (plain ? set : "'" + set + "'");
  }
  return out;
}

std::string withUnit(double value, const std::string& unit) {
  return terminal::format("%.3g", value) + (unit.empty() ? "" : " " + unit);
}

std::vector<FactorGain> factorGains(const Result& result, const std::string& metric) {
  std::vector<FactorGain> gains;
  if (result.outcomes.empty() || !shown(result.outcomes.front(), metric)) return gains;
  const Outcome& usual = result.outcomes.front();
  // an error ratio is meaningless when the error is below the uncertainty of the reference
  const double known = std::max(kRounding, result.resolution(metric) / 10);
  const Spread cost = usual.perSecond();
  for (const Outcome& other : result.outcomes) {
    if (!shown(other, metric) || hasConditions(other.setting)) continue;
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
    if (apart && std::abs(std::log(gain.cost_ratio)) > std::log(kSameCost) && gain.error_ratio > 0)
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

}  // namespace presa::cost
