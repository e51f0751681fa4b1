#include "apps/studies/cost/looks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/verdict.h"

namespace presa::cost {
namespace {

constexpr int kShapes[] = {0, 1, 2, 4};  // of svg::symbolPath; the diamond is the default's

int shapeOf(std::size_t i) { return kShapes[i % std::size(kShapes)]; }

/// Indices of the knobs in which the setting differs from the default.
std::vector<std::size_t> differences(const Result& result, const Outcome& outcome) {
  std::vector<std::size_t> found;
  const auto &a = outcome.setting.choices, &b = result.outcomes.front().setting.choices;
  for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) {
    if (a[k].second != b[k].second) found.push_back(k);
  }
  return found;
}

/// A knob's values in the study's order, then others in the order of the settings.
std::vector<std::string> valuesOf(const Result& result, std::size_t knob) {
  std::vector<std::string> values;
  const auto add = [&](const std::string& value) {
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  };
  for (const Outcome& outcome : result.outcomes) add(outcome.setting.choices[knob].second);
  return values;
}

/// Colours of a knob's values: told apart, or, of more than there are colours, a ramp in the order of the numbers.
std::vector<int> colorsOf(const std::vector<std::string>& values) {
  const auto count = static_cast<int>(values.size());
  std::vector<int> order(values.size()), colors(values.size());
  std::iota(order.begin(), order.end(), 0);
  if (count <= svg::kColors) return order;
  const auto number = [&](int i) { return numberIn(values[static_cast<std::size_t>(i)]); };
  if (std::ranges::all_of(order, [&](int i) { return number(i).has_value(); }))
    std::ranges::stable_sort(order, {}, [&](int i) { return *number(i); });
  for (int place = 0; place < count; ++place)
    colors[static_cast<std::size_t>(order[static_cast<std::size_t>(place)])] =
        svg::kRamp + (svg::kRampSteps - 1) * place / (count - 1);
  return colors;
}

/// Variance of the logarithms of cost and error that a knob's values explain, per value beyond the first.
double effectOf(const Result& result, std::size_t knob) {
  const std::vector<std::string> metrics = judgedMetrics(result);
  if (metrics.empty()) return 0;
  struct Sums {
    double n = 0, cost = 0, error = 0;
    double explained() const { return (cost * cost + error * error) / n; }
  };
  std::map<std::string, Sums> groups;
  Sums all;
  for (const Judged& each : judged(result, metrics.front())) {
    for (Sums* sums : {&groups[result.outcomes[each.index].setting.choices[knob].second], &all})
      sums->n += 1, sums->cost += std::log(each.cost.median), sums->error += std::log(each.error);
  }
  double effect = all.n > 0 ? -all.explained() : 0;
  for (const auto& [value, sums] : groups) effect += sums.explained();
  return groups.size() > 1 ? effect / static_cast<double>(groups.size() - 1) : 0;
}

/// A knob's value in words for people: engines have their own names.
std::string wordOf(const std::string& knob, const std::string& value) {
  if (knob != "engine") return value;
  return value == "ode" ? "ODE" : value == "mujoco" ? "MuJoCo" : value == "bullet" ? "Bullet" : value;
}

/// Whether the value of this knob might be one of another.
bool isAmbiguous(const Result& result, const Outcome& outcome, std::size_t knob) {
  for (std::size_t k = 0; k < outcome.setting.choices.size(); ++k) {
    const auto values = valuesOf(result, k);
    if (k != knob && values.size() > 1 && std::ranges::count(values, outcome.setting.choices[knob].second) > 0)
      return true;
  }
  return false;
}

std::string tagOf(const Result& result, const Outcome& outcome, const std::vector<std::size_t>& knobs) {
  if (knobs.empty()) return &outcome == &result.outcomes.front() ? "default" : outcome.setting.name;
  if (knobs.size() == 1 && isAmbiguous(result, outcome, knobs.front()))
    return outcome.setting.choices[knobs.front()].first + " " + outcome.setting.choices[knobs.front()].second;
  std::string tag;
  for (const std::size_t k : knobs) {
    const auto& [knob, value] = outcome.setting.choices[k];
    tag += (tag.empty() ? "" : ", ") + wordOf(knob, value);
  }
  return tag;
}

/// The knobs, the one to colour by first, and the one to draw by shape second: of two, not one with more values than
/// there are shapes.
std::vector<std::size_t> ranked(const Result& result, std::vector<std::size_t> knobs) {
  const auto rank = [&](std::size_t k) {
    return result.outcomes.front().setting.choices[k].first == "engine" ? INFINITY : effectOf(result, k);
  };
  std::stable_sort(knobs.begin(), knobs.end(), [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
  const auto fits = [&](std::size_t k) { return valuesOf(result, k).size() <= std::size(kShapes); };
  if (knobs.size() > 1 && fits(knobs[0]) && !fits(knobs[1])) std::swap(knobs[0], knobs[1]);
  return knobs;
}

}  // namespace

Looks looksOf(const Result& result) {
  Looks looks;
  if (result.outcomes.empty()) return looks;
  const auto& usual = result.outcomes.front().setting.choices;
  bool one_at_a_time = true;
  for (const Outcome& outcome : result.outcomes) {
    const std::vector<std::size_t> knobs = differences(result, outcome);
    one_at_a_time = one_at_a_time && knobs.size() < 2;
    looks.of.push_back({0, 0, tagOf(result, outcome, knobs)});
  }
  std::vector<std::size_t> knobs;
  for (std::size_t k = 0; k < usual.size(); ++k) {
    if (valuesOf(result, k).size() > 1) knobs.push_back(k);
  }
  if (one_at_a_time) {
    for (std::size_t rank = 0; rank < knobs.size(); ++rank)
      looks.legend.push_back({usual[knobs[rank]].first, static_cast<int>(rank % svg::kColors), shapeOf(rank)});
    for (std::size_t i = 0; i < looks.of.size(); ++i) {
      const std::vector<std::size_t> own = differences(result, result.outcomes[i]);
      if (own.empty()) continue;
      const auto rank = static_cast<std::size_t>(std::find(knobs.begin(), knobs.end(), own.front()) - knobs.begin());
      looks.of[i].color = looks.legend[rank].color;
      looks.of[i].shape = looks.legend[rank].shape;
    }
    return looks;
  }
  knobs = ranked(result, knobs);
  for (std::size_t rank = 0; rank < 2; ++rank) {
    const std::vector<std::string> values = valuesOf(result, knobs[rank]);
    const std::vector<int> colors = colorsOf(values);
    for (std::size_t v = 0; v < values.size(); ++v) {
      const std::string& knob = usual[knobs[rank]].first;
      looks.legend.push_back(
          {knob + " " + wordOf(knob, values[v]), rank == 0 ? colors[v] : -1, rank == 0 ? 0 : shapeOf(v)});
    }
    if (rank == 0) std::ranges::stable_sort(looks.legend, {}, &svg::WorkFigure::Entry::color);
    for (std::size_t i = 0; i < looks.of.size(); ++i) {
      const std::string& value = result.outcomes[i].setting.choices[knobs[rank]].second;
      const auto v = static_cast<std::size_t>(std::find(values.begin(), values.end(), value) - values.begin());
      if (rank == 0)
        looks.of[i].color = colors[v];
      else
        looks.of[i].shape = shapeOf(v);
    }
  }
  return looks;
}

}  // namespace presa::cost
