#include "experiments/runner/statistics/means.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/runner/statistics/distributions.h"

namespace presa::statistics {

bool allFinite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

std::optional<double> mean(std::span<const double> values) {
  if (values.empty() || !allFinite(values)) return std::nullopt;
  const double n = static_cast<double>(values.size());
  double rough = 0;
  for (const double value : values) rough += value / n;
  double rest = 0;  // rounding error of the first pass
  for (const double value : values) rest += value - rough;
  return rough + rest / n;
}

std::optional<double> standardDeviation(std::span<const double> values) {
  const std::optional<double> centre = mean(values);
  if (!centre || values.size() < 2) return std::nullopt;
  double squares = 0;
  for (const double value : values) squares += (value - *centre) * (value - *centre);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

std::optional<double> quantile(std::span<const double> values, double p) {
  if (values.empty() || !allFinite(values) || !(p >= 0 && p <= 1)) return std::nullopt;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::optional<double> median(std::span<const double> values) { return quantile(values, 0.5); }

std::optional<MeanEstimate> meanInterval(std::span<const double> values, double level) {
  const std::optional<double> sd = standardDeviation(values);
  if (!sd || !(level > 0 && level < 1)) return std::nullopt;
  const double n = static_cast<double>(values.size());
  const double centre = *mean(values), reach = studentQuantile(0.5 + level / 2, n - 1) * *sd / std::sqrt(n);
  return MeanEstimate{values.size(), centre, *sd, {centre - reach, centre + reach}};
}

std::optional<WithinSubjectIntervals> withinSubjectIntervals(std::span<const LabelledValue> values, double level) {
  std::map<int, std::map<int, std::vector<double>>> trials;  // subject, condition
  for (const LabelledValue& v : values) trials[v.subject][v.condition].push_back(v.value);
  if (trials.size() < 2) return std::nullopt;

  std::map<int, std::vector<double>> centred;  // one value per subject, by condition
  double grand_mean = 0;
  for (const auto& [subject, of_subject] : trials) {
    std::vector<double> cells;
    for (const auto& [condition, cell] : of_subject) {
      if (!allFinite(cell)) return std::nullopt;
      cells.push_back(*mean(cell));
    }
    const double own = *mean(cells);
    grand_mean += own / static_cast<double>(trials.size());
    std::size_t i = 0;
    for (const auto& [condition, cell] : of_subject) centred[condition].push_back(cells[i++] - own);
  }
  const auto is_whole = [&](const auto& entry) { return entry.second.size() == trials.size(); };
  if (centred.size() < 2 || !std::all_of(centred.begin(), centred.end(), is_whole)) return std::nullopt;

  const double m = static_cast<double>(centred.size());
  WithinSubjectIntervals result{trials.size(), std::sqrt(m / (m - 1)), {}};
  for (const auto& [condition, cells] : centred) {
    const std::optional<MeanEstimate> estimate = meanInterval(cells, level);
    if (!estimate) return std::nullopt;
    const double at = grand_mean + estimate->mean, reach = result.correction * estimate->interval.halfWidth();
    result.conditions.push_back({condition, at, {at - reach, at + reach}});
  }
  return result;
}

}  // namespace presa::statistics
