#include "apps/studies/cost/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/metrics.h"

namespace presa::cost {
namespace {

using terminal::format;

std::string titleOf(const std::string& metric) { return lowered(findMetric(metric)->title); }

std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : "; ") + part;
  return text;
}

/// Every setting beside the default, in every metric.
class Pairs {
 public:
  explicit Pairs(const Result& result) {
    for (const std::string& metric : result.metrics) {
      std::vector<std::optional<Judged>>& row = judged_[metric];
      row.resize(result.outcomes.size());
      for (const Judged& each : judged(result, metric)) row[each.index] = each;
    }
  }
  /// No value when one of the two has no error there.
  struct Pair {
    Judged usual, other;
  };
  std::optional<Pair> of(const std::string& metric, std::size_t index) const {
    const std::vector<std::optional<Judged>>& row = judged_.at(metric);
    if (!row.front() || !row[index]) return std::nullopt;
    return Pair{*row.front(), *row[index]};
  }

 private:
  std::map<std::string, std::vector<std::optional<Judged>>> judged_;
};

bool felt(const Result& result, const std::string& metric, std::size_t index) {
  const auto limit = result.reference.noticeable.find(metric);
  const Outcome& outcome = result.outcomes[index];
  return limit != result.reference.noticeable.end() && outcome.error.contains(metric) &&
         result.claimed(outcome, metric) >= limit->second;
}

/// Whether nobody feels any of these errors of the default, as far as thresholds are known for all of them.
bool defaultUnfelt(const Result& result, const std::vector<std::string>& names) {
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return result.reference.noticeable.contains(name) && result.outcomes.front().error.contains(name) &&
           !felt(result, name, 0);
  });
}

/// How much the setting gains over the default, as a sum of logarithms; no value when it may not replace it.
std::optional<double> gainOf(const Result& result, const Pairs& pairs, std::size_t index) {
  double sum = 0;
  bool beyond = false, all_better = true, any = false;
  for (const std::string& metric : judgedMetrics(result)) {
    if (!pairs.of(metric, 0)) continue;
    const auto pair = pairs.of(metric, index);
    if (!pair || !noDearer(pair->other, pair->usual) || pair->other.error > pair->usual.error) return std::nullopt;
    const double error = pair->usual.error / pair->other.error;
    const double cost = cheaper(pair->other, pair->usual) ? pair->usual.cost.median / pair->other.cost.median : 1;
    sum += std::log(error) + (any ? 0 : std::log(cost));  // the cost is the same in every metric
    beyond = beyond || error > kNearFront || cost > kNearFront;
    all_better = all_better && error > 1;
    any = true;
  }
  if (!any || !(beyond || all_better)) return std::nullopt;
  for (const std::string& metric : result.metrics) {
    if (felt(result, metric, index) && !felt(result, metric, 0)) return std::nullopt;
  }
  return sum;
}

/// "0.98 times the processor time of the default; 0.71 times its error in force, RMS error"
std::string gainText(const Result& result, std::size_t better) {
  const Pairs pairs(result);
  std::vector<std::string> parts;
  for (const std::string& metric : judgedMetrics(result)) {
    const auto pair = pairs.of(metric, better);
    if (!pair) continue;
    if (parts.empty())
      parts.push_back(
          format("%.3g times the processor time of the default", pair->other.cost.median / pair->usual.cost.median));
    parts.push_back(pair->other.error < pair->usual.error
                        ? format("%.3g times its error in ", pair->other.error / pair->usual.error) + titleOf(metric)
                        : "the same " + titleOf(metric));
  }
  return listed(parts);
}

/// Errors, judged or not, in which the setting is worse than the default by more than kNearFront.
std::string pricesOf(const Result& result, std::size_t better) {
  const Pairs pairs(result);
  std::vector<std::string> parts;
  for (const std::string& metric : result.metrics) {
    const auto pair = pairs.of(metric, better);
    if (pair && pair->other.error > kNearFront * pair->usual.error)
      parts.push_back(format("%s %.3g times", titleOf(metric).c_str(), pair->other.error / pair->usual.error));
  }
  return listed(parts);
}

/// For each metric of `names` in which the default is farther from the front than `over`: what beats it.
std::vector<std::string> beatenIn(const Result& result, const std::vector<std::string>& names, double over) {
  std::vector<std::string> parts;
  for (const std::string& name : names) {
    const auto distance = distanceToFront(result, name);
    if (distance && distance->ratio() > over) parts.push_back(titleOf(name) + ": " + whatBeats(result, *distance));
  }
  return parts;
}

/// Whether a setting beside the default could replace it.
bool hasCandidates(const Result& result) {
  for (std::size_t i = 1; i < result.outcomes.size(); ++i)
    if (comparable(result, i)) return true;
  return false;
}

void addUnfelt(const Result& result, Verdict& verdict) {
  const bool known = std::any_of(result.metrics.begin(), result.metrics.end(), [&](const std::string& metric) {
    return result.reference.noticeable.contains(metric);
  });
  if (!known) return;
  const auto found = cheapestUnfelt(result);
  if (!found) {
    std::vector<std::string> of_default;
    for (const std::string& metric : result.metrics)
      if (felt(result, metric, 0)) of_default.push_back(titleOf(metric));
    verdict.details.push_back("No setting is known to be free of errors that can be felt" +
                              (of_default.empty() ? "" : "; the default's is in " + listed(of_default)) + ".");
    return;
  }
  const Outcome &cheapest = result.outcomes[*found], &usual = result.outcomes.front();
  std::string text = "The cheapest setting whose errors nobody feels is " +
                     (*found == 0 ? std::string("the default") : cheapest.setting.name) +
                     format(": %.3g ms of processor time per simulated second", 1e3 * cheapest.perSecond().median);
  if (*found != 0 && usual.timed())
    text += format(", %.3g times that of the default", cheapest.perSecond().median / usual.perSecond().median);
  verdict.details.push_back(text + ".");
}

}  // namespace

std::vector<std::string> judgedMetrics(const Result& result) {
  for (const bool fronts : {true, false}) {
    std::vector<std::string> names;
    for (const SentenceRule& rule : result.study.sentences) {
      const bool shows = std::find(result.metrics.begin(), result.metrics.end(), rule.metric) != result.metrics.end();
      const bool taken = std::find(names.begin(), names.end(), rule.metric) != names.end();
      if (shows && !taken && (!fronts || rule.kind == SentenceRule::Kind::kFront)) names.push_back(rule.metric);
    }
    if (!names.empty()) return names;
  }
  return result.metrics;
}

std::optional<std::size_t> betterSetting(const Result& result) {
  const Pairs pairs(result);
  std::optional<std::size_t> best;
  double best_gain = 0;
  for (std::size_t i = 1; i < result.outcomes.size(); ++i) {
    if (!comparable(result, i)) continue;
    const auto gain = gainOf(result, pairs, i);
    if (!gain || (best && *gain <= best_gain)) continue;
    best = i;
    best_gain = *gain;
  }
  return best;
}

Verdict verdictOf(const Result& result) {
  Verdict verdict;
  if (result.outcomes.empty()) return verdict;
  const std::vector<std::string> names = judgedMetrics(result);
  std::vector<std::string> known;
  double ratio = 1;
  for (const std::string& name : names) {
    const auto distance = distanceToFront(result, name);
    if (!distance) continue;
    known.push_back(titleOf(name));
    ratio = std::max(ratio, distance->ratio());
  }
  verdict.better = betterSetting(result);
  const std::string judged_in = " in " + listed(known);
  if (known.empty()) {
    const std::string& failure = result.outcomes.front().failure;
    verdict.headline = failure.empty() ? "The default cannot be judged" : "The default fails: " + failure;
  } else if (verdict.better) {
    const std::size_t better = *verdict.better;
    verdict.kind = Verdict::Kind::kBeaten;
    verdict.unfelt = defaultUnfelt(result, names);
    const bool others = !isUnfelt(result, 0) || !isUnfelt(result, better);
    verdict.headline = "The default is beaten by " + result.outcomes[better].setting.name +
                       (verdict.unfelt ? ", but nobody feels the errors of either" : "") +
                       (verdict.unfelt && others ? judged_in : "");
    verdict.details.push_back("It has " + gainText(result, better) + ".");
    if (const std::string prices = pricesOf(result, better); !prices.empty())
      verdict.details.push_back("It is worse than the default in errors that this study does not judge: " + prices +
                                ".");
  } else if (!hasCandidates(result)) {
    verdict.kind = Verdict::Kind::kOnFront;
    verdict.headline = "The default has no rival here";
    verdict.details.push_back(
        "The other settings have latency, late ticks or another engine. They are compared with the "
        "same reference, and are no choice.");
  } else if (ratio <= 1) {
    verdict.kind = Verdict::Kind::kOnFront;
    verdict.headline = "The default is on the front";
    verdict.details.push_back("No other setting is both no dearer and more accurate, or cheaper and as accurate," +
                              judged_in + ".");
  } else if (ratio <= kNearFront) {
    verdict.kind = Verdict::Kind::kNear;
    verdict.headline = "The default is within 1.3 times of the front";
    verdict.details.push_back("What beats it, by less than that: " + listed(beatenIn(result, names, 1)) + ".");
  } else {
    verdict.kind = Verdict::Kind::kTradeOff;
    const std::vector<std::string> beaten = beatenIn(result, names, kNearFront);
    verdict.headline = "The default is beaten in " +
                       (beaten.size() == 1 ? "one error" : std::to_string(beaten.size()) + " errors") +
                       ", but by no setting in all";
    verdict.details.push_back("Beyond 1.3 times: " + listed(beaten) +
                              ". Each is worse than the default in another error that is judged, or its error can be "
                              "felt where that of the default cannot.");
  }
  std::vector<std::string> others = result.metrics;
  std::erase_if(others,
                [&](const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); });
  std::vector<std::string> more;
  for (const std::string& name : others) {
    const auto distance = distanceToFront(result, name);
    if (!distance || distance->ratio() <= kNearFront) continue;
    const std::size_t by = distance->error >= distance->cost ? distance->as_cheap : distance->as_accurate;
    more.push_back(titleOf(name) + " by " + result.outcomes[by].setting.name +
                   format(", %.3g times", distance->ratio()));
  }
  if (!more.empty())
    verdict.details.push_back("Not judged by this study, but beaten beyond 1.3 times in " + listed(more) + ".");
  addUnfelt(result, verdict);
  return verdict;
}

}  // namespace presa::cost
