// Random results: the drawn front, the distances, the verdict and the sentences never contradict each other.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <functional>
#include <regex>

#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/verdict.h"

namespace presa::cost {
namespace {

/// Few different values, so that ties and near ties are common.
rc::Gen<double> figure() {
  return rc::gen::map(rc::gen::pair(rc::gen::inRange(1, 6), rc::gen::inRange(0, 8)),
                      [](std::pair<int, int> parts) { return 0.001 * parts.first * (1 + 0.02 * parts.second); });
}

Outcome outcome(std::size_t i) {
  Outcome made;
  made.setting.name = i == 0 ? "default" : "setting" + std::to_string(i);
  made.setting.choices = {{"engine", *rc::gen::inRange(0, 5) == 0 && i > 0 ? "bullet" : "ode"}};
  if (i > 0 && *rc::gen::inRange(0, 5) == 0) made.setting.sets = {"run/latency=0.01"};
  const double cost = *figure(), spread = 0.01 * *rc::gen::inRange(0, 12);
  for (const double part : {1 - spread, 1.0, 1 + spread}) {
    Timing timing;
    timing.per_second = cost * part;
    made.timings.push_back(timing);
  }
  if (*rc::gen::inRange(0, 8) == 0) made.failure = "cube was dropped";
  for (const char* metric : {"force_rms", "position", "proxy"})
    if (made.failure.empty() && *rc::gen::inRange(0, 10) > 0) made.error[metric] = *figure();
  return made;
}

Result anyResult() {
  Result result;
  result.metrics = {"force_rms", "position", "proxy"};
  const int count = *rc::gen::inRange(2, 14);
  for (int i = 0; i < count; ++i) result.outcomes.push_back(outcome(static_cast<std::size_t>(i)));
  for (const char* metric : {"force_rms", "position"}) {
    if (*rc::gen::arbitrary<bool>()) result.reference.residual[metric] = 0.1 * *figure();
    if (*rc::gen::arbitrary<bool>())
      result.reference.noticeable[metric] = *figure() * *rc::gen::element(0.1, 1.0, 10.0);
    if (*rc::gen::arbitrary<bool>())
      result.study.sentences.push_back({.kind = SentenceRule::Kind::kFront, .metric = metric});
    result.study.sentences.push_back({.kind = SentenceRule::Kind::kBelow, .metric = metric});
    result.study.sentences.push_back({.kind = SentenceRule::Kind::kCheapest, .metric = metric});
  }
  return result;
}

/// The largest factor that a text says something is better by: "at 0.5 times the error" is 2.
double largestClaim(const std::string& text) {
  static const std::regex part("at ([0-9.e+-]+) times the ");
  double largest = 1;
  for (std::sregex_iterator it(text.begin(), text.end(), part), end; it != end; ++it)
    largest = std::max(largest, 1 / std::stod((*it)[1]));
  return largest;
}

bool says(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

void expectTrue(const char* name, const std::function<void()>& property) {
  SCOPED_TRACE(name);
  EXPECT_TRUE(rc::check(name, property));
}

TEST(FrontProperties, NoSettingOfTheDrawnFrontIsBeaten) {
  expectTrue("the front", [] {
    const Result result = anyResult();
    for (const std::string& metric : result.metrics) {
      const std::vector<Judged> all = judged(result, metric), front = frontOf(result, metric);
      for (std::size_t i = 0; i < front.size(); ++i) {
        for (const Judged& other : all) RC_ASSERT(!comparable(result, other.index) || !beats(other, front[i]));
        if (i > 0) {
          RC_ASSERT(front[i - 1].cost.median <= front[i].cost.median && front[i - 1].error >= front[i].error);
        }
      }
      // whatever is not drawn on it is beaten, and nothing beats in a circle: the front is not empty
      bool any = false;
      for (const Judged& each : all) {
        if (!comparable(result, each.index)) continue;
        any = true;
        const bool on = std::any_of(front.begin(), front.end(), [&](const Judged& f) { return f.index == each.index; });
        const bool beaten = std::any_of(all.begin(), all.end(), [&](const Judged& other) {
          return comparable(result, other.index) && beats(other, each);
        });
        RC_ASSERT(on != beaten);
      }
      RC_ASSERT(any != front.empty());
    }
  });
}

TEST(FrontProperties, TheDistanceIsOneExactlyOnTheDrawnFront) {
  expectTrue("the distance", [] {
    const Result result = anyResult();
    for (const std::string& metric : result.metrics) {
      const auto distance = distanceToFront(result, metric);
      if (!distance) continue;
      const std::vector<Judged> front = frontOf(result, metric);
      RC_ASSERT(
          (distance->ratio() == 1) ==
          (!front.empty() && std::any_of(front.begin(), front.end(), [](const Judged& f) { return f.index == 0; })));
      for (const Judged& other : judged(result, metric)) {
        if (!comparable(result, other.index)) continue;
        const Judged usual = judged(result, metric).front();
        if (noDearer(other, usual)) RC_ASSERT(usual.error / other.error <= distance->ratio() * (1 + 1e-12));
        if (cheaper(other, usual) && other.error <= usual.error)
          RC_ASSERT(usual.cost.median / other.cost.median <= distance->ratio() * (1 + 1e-12));
      }
    }
  });
}

TEST(FrontProperties, NoSentenceContradictsItselfOrTheVerdict) {
  expectTrue("the sentences", [] {
    const Result result = anyResult();
    const Verdict verdict = verdictOf(result);
    const bool close = verdict.kind == Verdict::Kind::kOnFront || verdict.kind == Verdict::Kind::kNear;
    std::vector<std::string> texts = sentences(result);
    for (const std::string& text : texts) {
      if (!says(text, "The default lies")) continue;
      if (says(text, "lies on the front")) RC_ASSERT(largestClaim(text) == 1);
      if (says(text, "lies within")) RC_ASSERT(largestClaim(text) <= 1.3005);
      if (says(text, "lies beyond")) RC_ASSERT(largestClaim(text) >= 1.2995 && !close);
      if (verdict.kind == Verdict::Kind::kOnFront) RC_ASSERT(says(text, "lies on the front"));
    }
    if (says(verdict.headline, "within 1.3") || says(verdict.headline, "on the front"))
      RC_ASSERT(largestClaim(verdict.details.front()) <= 1.3005 && !verdict.better);
    const bool all_unfelt =
        says(verdict.headline, "nobody feels the errors of either") && !says(verdict.headline, "of either in ");
    for (const std::string& text : verdict.details)
      RC_ASSERT(!all_unfelt || !says(text, "No setting is known to be free"));
    RC_ASSERT(verdict.better.has_value() == (verdict.kind == Verdict::Kind::kBeaten));
    if (verdict.better) RC_ASSERT(says(verdict.headline, result.outcomes[*verdict.better].setting.name.c_str()));
  });
}

TEST(FrontProperties, TheBetterSettingIsWorseInNothingThatIsJudgedOrFelt) {
  expectTrue("the better setting", [] {
    const Result result = anyResult();
    const auto better = betterSetting(result);
    if (!better) return;
    RC_ASSERT(comparable(result, *better) && result.outcomes[*better].failure.empty());
    RC_ASSERT(!hasConditions(result.outcomes[*better].setting));
    for (const std::string& metric : judgedMetrics(result)) {
      if (!distanceToFront(result, metric)) continue;
      const Judged usual = judged(result, metric).front();
      Judged other = usual;
      for (const Judged& each : judged(result, metric))
        if (each.index == *better) other = each;
      RC_ASSERT(other.index == *better && noDearer(other, usual) && other.error <= usual.error);
    }
    for (const auto& [metric, limit] : result.reference.noticeable) {
      const auto felt = [&](std::size_t i) {
        return result.outcomes[i].error.contains(metric) && result.claimed(result.outcomes[i], metric) >= limit;
      };
      RC_ASSERT(!felt(*better) || felt(0));
    }
  });
}

TEST(FrontProperties, TheCheapestIsTheCheapest) {
  expectTrue("the cheapest", [] {
    const Result result = anyResult();
    for (const auto& [metric, limit] : result.reference.noticeable) {
      const auto found = cheapestBelow(result, metric, limit);
      for (const Judged& each : judged(result, metric)) {
        const Outcome& outcome = result.outcomes[each.index];
        if (hasConditions(outcome.setting) || !(result.claimed(outcome, metric) < limit)) continue;
        RC_ASSERT(found && result.outcomes[*found].perSecond().median <= each.cost.median);
      }
      if (!found) continue;
      RC_ASSERT(!hasConditions(result.outcomes[*found].setting));
      RC_ASSERT(result.claimed(result.outcomes[*found], metric) < limit);
    }
  });
}

}  // namespace
}  // namespace presa::cost
