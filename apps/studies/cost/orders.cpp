#include "apps/studies/cost/orders.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

constexpr int kLowest = 10, kHighest = 800;  // orders that are tried, in hundredths
constexpr double kApart =
    3;  // steps nearer to that of the finest setting are left out: its own error is in the difference
const double kScatter = std::log(1.5);  // of errors about their power

/// Root of the mean square by which the logarithms of the errors differ from those of the power.
double scatterOf(double power, const std::vector<double>& steps, const std::vector<double>& errors,
                 double compared_with) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double away = std::log(errors[i] / (std::pow(steps[i], power) - std::pow(compared_with, power)));
    sum += away;
    squares += away * away;
  }
  return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

/// Settings that differ in one factor only, coarse to fine, with their steps.
struct Line {
  std::vector<std::pair<double, const Outcome*>> settings;
  bool has_default = false;
};

Line lineAlong(const Result& result, const Factor& factor) {
  std::map<std::string, Line> lines;  // by the values of all other factors
  for (const Outcome& outcome : result.outcomes) {
    const std::optional<double> value = numberIn(valueOf(outcome.setting, factor.name));
    if (!outcome.failure.empty() || hasConditions(outcome.setting) || !value || !(*value > 0)) continue;
    std::string others;
    for (const auto& [name, choice] : outcome.setting.choices)
      if (name != factor.name) others += name + "=" + choice + ";";
    Line& line = lines[others];
    line.settings.emplace_back(factor.finer == Direction::kUp ? 1 / *value : *value, &outcome);
    line.has_default = line.has_default || &outcome == &result.outcomes.front();
  }
  if (lines.empty()) return {};
  Line longest = std::ranges::max_element(lines, {}, [](const auto& each) {
                   return std::pair(each.second.settings.size(), each.second.has_default);
                 })->second;
  std::ranges::sort(longest.settings, std::greater<>(), [](const auto& each) { return each.first; });
  return longest;
}

}  // namespace

std::optional<double> fittedOrder(const std::vector<double>& steps, const std::vector<double>& errors,
                                  double compared_with) {
  std::vector<double> apart, known;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!(errors[i] > kRounding) || steps[i] < kApart * compared_with) continue;
    apart.push_back(steps[i]);
    known.push_back(errors[i]);
  }
  if (known.size() < 2) return std::nullopt;
  int best = kLowest;
  double scatter = INFINITY;
  for (int power = kLowest; power <= kHighest; ++power) {
    const double now = scatterOf(0.01 * power, apart, known, compared_with);
    if (now < scatter) {
      scatter = now;
      best = power;
    }
  }
  const bool fits = scatter <= kScatter && best > kLowest && best < kHighest;
  return fits ? std::optional(0.01 * best) : std::nullopt;
}

std::vector<Order> ordersOf(const Result& result, const std::function<Evidence(std::uint64_t)>& evidence) {
  std::vector<Order> orders;
  const bool exact = result.study.reference_kind == Study::Reference::kAnalytic;
  for (const Factor& factor : result.study.factors) {
    if (factor.finer == Direction::kNone) continue;
    const Line line = lineAlong(result, factor);
    if (line.settings.size() < (exact ? 2 : 3)) continue;
    std::vector<Evidence> found;
    std::vector<double> steps;
    std::vector<std::string> values;
    for (const auto& [step, outcome] : line.settings) {
      if (!exact) found.push_back(evidence(outcome->setting.scene_hash));
      steps.push_back(step);
      values.push_back(valueOf(outcome->setting, factor.name));
    }
    const double compared_with = exact ? 0 : steps.back();
    if (!exact) steps.pop_back();
    for (const std::string& name : result.metrics) {
      const Metric& metric = *findMetric(name);
      std::vector<double> errors;
      for (std::size_t i = 0; i < steps.size() && !metric.absolute; ++i) {
        const auto& known = line.settings[i].second->error;
        errors.push_back(exact ? (known.contains(name) ? known.at(name) : 0)
                               : metric.error(found[i], found.back()).value_or(0));
      }
      if (const auto order = fittedOrder(steps, errors, compared_with))
        orders.push_back({factor.name, name, *order, values});
    }
  }
  return orders;
}

}  // namespace presa::cost
