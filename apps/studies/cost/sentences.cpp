#include <algorithm>
#include <cmath>
#include <map>

#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

using terminal::format;

bool has(const Outcome& outcome, const std::string& metric) {
  return outcome.failure.empty() && outcome.error.contains(metric);
}

/// Ratio over several pairs: geometric mean and range.
struct Ratio {
  double log_sum = 0, low = INFINITY, high = 0;
  int count = 0;
  void add(double ratio) {
    log_sum += std::log(ratio);
    low = std::min(low, ratio);
    high = std::max(high, ratio);
    ++count;
  }
  double mean() const { return count > 0 ? std::exp(log_sum / count) : 1; }
};

std::string asFactor(const Ratio& ratio) {
  if (ratio.count < 2) return format("%.3g", ratio.mean());
  return format("%.3g (%.3g to %.3g over %d pairs)", ratio.mean(), ratio.low, ratio.high, ratio.count);
}

/// Outcomes grouped by the values of all factors but one, then by that factor's value.
using Lines = std::map<std::string, std::map<std::string, const Outcome*>>;
Lines linesAlong(const Result& result, const std::string& factor) {
  Lines lines;
  for (const Outcome& outcome : result.outcomes) {
    std::string rest, value;
    for (const auto& [name, choice] : outcome.setting.choices) {
      if (name == factor)
        value = choice;
      else
        rest += name + "=" + choice + ";";
    }
    lines[rest][value] = &outcome;
  }
  return lines;
}

struct Limit {
  double value = 0;
  std::string words;
};
std::optional<Limit> limitOf(const Result& result, const SentenceRule& rule) {
  const Metric& metric = *findMetric(rule.metric);
  if (rule.limit > 0) return Limit{rule.limit, withUnit(rule.limit, metric.unit)};
  const auto known = result.reference.noticeable.find(rule.metric);
  if (known == result.reference.noticeable.end()) return std::nullopt;
  return Limit{known->second, metric.unit == "steps"
                                  ? "one just-noticeable step"
                                  : "the just-noticeable difference of " + withUnit(known->second, metric.unit)};
}

std::string below(const Result& result, const SentenceRule& rule) {
  const auto limit = limitOf(result, rule);
  if (!limit) return {};
  std::size_t good = 0;
  const Outcome* best = nullptr;
  const Outcome* worst = nullptr;
  const auto error = [&](const Outcome* outcome) { return result.claimed(*outcome, rule.metric); };
  for (const Judged& each : judged(result, rule.metric)) {
    const Outcome* outcome = &result.outcomes[each.index];
    good += error(outcome) < limit->value ? 1 : 0;
    if (best == nullptr || error(outcome) < error(best)) best = outcome;
    if (worst == nullptr || error(outcome) > error(worst)) worst = outcome;
  }
  if (best == nullptr) return {};
  const Metric& metric = *findMetric(rule.metric);
  const auto valueText = [&](const Outcome& outcome) {
    return (result.resolved(outcome, rule.metric) ? "" : "at most ") +
           withUnit(result.claimed(outcome, rule.metric), metric.unit) + " (" + outcome.setting.name + ")";
  };
  return format("%zu of %zu settings stay below %s in %s: from ", good, result.outcomes.size(), limit->words.c_str(),
                lowered(metric.title).c_str()) +
         valueText(*best) + " to " + valueText(*worst) + ".";
}

std::string halving(const Result& result, const SentenceRule& rule) {
  Ratio error, cost;
  for (const auto& [rest, line] : linesAlong(result, rule.factor)) {
    std::vector<std::pair<double, const Outcome*>> values;
    for (const auto& [value, outcome] : line) {
      const auto x = numberIn(value);
      if (x && *x > 0 && has(*outcome, rule.metric) && outcome->timed() && outcome->error.at(rule.metric) > 0)
        values.emplace_back(*x, outcome);
    }
    std::sort(values.begin(), values.end());
    for (std::size_t i = 0; i + 1 < values.size(); ++i) {
      // scale each pair to a doubling of the value
      const double power = std::log(2.0) / std::log(values[i + 1].first / values[i].first);
      const Outcome &coarse = *values[i].second, &fine = *values[i + 1].second;
      error.add(std::pow(coarse.error.at(rule.metric) / fine.error.at(rule.metric), power));
      cost.add(std::pow(fine.perSecond().median / coarse.perSecond().median, power));
    }
  }
  if (error.count == 0) return {};
  const bool rate = rule.factor.ends_with("_rate") || rule.factor.starts_with("rates/");
  const std::string what = rate ? "Halving the step (doubling " + rule.factor + ")" : "Doubling " + rule.factor;
  return what + " divides the error (" + lowered(findMetric(rule.metric)->title) + ") by " + asFactor(error) +
         " and multiplies the processor time by " + format("%.3g.", cost.mean());
}

std::string compare(const Result& result, const SentenceRule& rule) {
  Ratio error, cost;
  int b_fails = 0, a_fails = 0, pairs = 0;
  for (const auto& [rest, line] : linesAlong(result, rule.factor)) {
    const auto a = line.find(rule.a), b = line.find(rule.b);
    if (a == line.end() || b == line.end()) continue;
    ++pairs;
    a_fails += has(*a->second, rule.metric) ? 0 : 1;
    b_fails += has(*b->second, rule.metric) ? 0 : 1;
    if (!has(*a->second, rule.metric) || !has(*b->second, rule.metric)) continue;
    const double ea = a->second->error.at(rule.metric), eb = b->second->error.at(rule.metric);
    if (ea > 0 && eb > 0) error.add(eb / ea);
    if (a->second->timed() && b->second->timed())
      cost.add(b->second->perSecond().median / a->second->perSecond().median);
  }
  if (pairs == 0) return {};
  std::string text = rule.factor + " " + rule.b + " against " + rule.a + ": ";
  if (error.count > 0)
    text += "error (" + lowered(findMetric(rule.metric)->title) + ") times " + asFactor(error) +
            ", processor time times " + format("%.3g", cost.mean());
  else
    text += "no pair in which both hold";
  return text +
         format("; %s fails in %d of %d settings, %s in %d.", rule.b.c_str(), b_fails, pairs, rule.a.c_str(), a_fails);
}

std::string cheapest(const Result& result, const SentenceRule& rule) {
  const auto limit = limitOf(result, rule);
  if (!limit) return {};
  const std::string title = lowered(findMetric(rule.metric)->title);
  const auto found = cheapestBelow(result, rule.metric, limit->value);
  if (!found) return "No setting stays below " + limit->words + " in " + title + ".";
  const Outcome& outcome = result.outcomes[*found];
  const double cost = outcome.perSecond().median;
  std::string text = "The cheapest setting below " + limit->words + " in " + title + " is " + outcome.setting.name +
                     ": " + format("%.3g ms of processor time per simulated second", 1e3 * cost);
  const Outcome& usual = result.outcomes.front();
  if (*found != 0 && usual.timed()) text += format(", %.3g times that of the default", cost / usual.perSecond().median);
  return text + ".";
}

std::string front(const Result& result, const SentenceRule& rule) {
  const auto distance = distanceToFront(result, rule.metric);
  if (!distance) return {};
  const std::string title = lowered(findMetric(rule.metric)->title);
  if (distance->ratio() <= 1) return "The default lies on the front of " + title + ".";
  return std::string("The default lies ") + (distance->ratio() <= kNearFront ? "within" : "beyond") +
         " 1.3 times of the front of " + title + ": " + whatBeats(result, *distance) + ".";
}

std::string order(const Result& result, const SentenceRule& rule) {
  const std::string error = lowered(findMetric(rule.metric)->title);
  for (const Order& each : result.orders) {
    if (each.factor != rule.factor || each.metric != rule.metric) continue;
    const bool exact = result.study.reference_kind == Study::Reference::kAnalytic;
    return "The order of convergence along " + rule.factor + format(" is %.2f: the error (", each.order) + error +
           format(") of %zu values from ", each.values.size() - (exact ? 0 : 1)) + each.values.front() +
           (exact ? " to " + each.values.back() + ", all else the same."
                  : " on, each against that of " + each.values.back() + " with all else the same.");
  }
  if (result.study.file.empty()) return {};  // nobody has asked
  return "No order of convergence appears along " + rule.factor + " in " + error + ".";
}

std::string failures(const Result& result) {
  std::map<std::string, int> reasons;
  int count = 0;
  for (const Outcome& outcome : result.outcomes) {
    if (outcome.failure.empty()) continue;
    ++reasons[outcome.failure];
    ++count;
  }
  if (count == 0) return format("None of the %zu settings failed.", result.outcomes.size());
  std::string text = format("%d of %zu settings failed: ", count, result.outcomes.size());
  bool first = true;
  for (const auto& [reason, n] : reasons) {
    text += (first ? "" : "; ") + reason + format(" (%d)", n);
    first = false;
  }
  return text + ".";
}

}  // namespace

std::string whatBeats(const Result& result, const FrontDistance& distance) {
  std::string text;
  if (distance.cost > 1)
    text = format("as accurate at %.4g times the processor time is ", 1 / distance.cost) +
           result.outcomes[distance.as_accurate].setting.name;
  if (distance.error > 1)
    text += (text.empty() ? "" : ", and ") + format("no dearer at %.4g times the error is ", 1 / distance.error) +
            result.outcomes[distance.as_cheap].setting.name;
  return text;
}

std::string lowered(std::string title) {
  if (!title.empty()) title[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(title[0])));
  return title;
}

std::vector<std::string> sentences(const Result& result) {
  std::vector<std::string> texts;
  for (const SentenceRule& rule : result.study.sentences) {
    const bool shows = std::find(result.metrics.begin(), result.metrics.end(), rule.metric) != result.metrics.end();
    if (rule.kind != SentenceRule::Kind::kFailures && !shows) continue;
    std::string text;
    switch (rule.kind) {
      case SentenceRule::Kind::kBelow:
        text = below(result, rule);
        break;
      case SentenceRule::Kind::kHalving:
        text = halving(result, rule);
        break;
      case SentenceRule::Kind::kCompare:
        text = compare(result, rule);
        break;
      case SentenceRule::Kind::kCheapest:
        text = cheapest(result, rule);
        break;
      case SentenceRule::Kind::kFront:
        text = front(result, rule);
        break;
      case SentenceRule::Kind::kOrder:
        text = order(result, rule);
        break;
      case SentenceRule::Kind::kFailures:
        text = failures(result);
        break;
    }
    if (!text.empty()) texts.push_back(text);
  }
  return texts;
}

}  // namespace presa::cost
