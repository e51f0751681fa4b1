// Fronts, gains and sentences of invented numbers.
#include "apps/studies/cost/analysis.h"

#include <gtest/gtest.h>

#include "apps/studies/cost/verdict.h"

namespace presa::cost {
namespace {

Outcome outcome(const std::string& rate, const std::string& coupling, double cost, double error,
                const std::string& failure = {}) {
  Outcome made;
  made.setting.name = rate == "200" && coupling == "soft" ? "default" : "rate " + rate + " " + coupling;
  made.setting.choices = {{"dynamics_rate", rate}, {"coupling", coupling}};
  if (made.setting.name != "default") made.setting.sets = {"rates/dynamics=" + rate, "dynamics/coupling=" + coupling};
  made.failure = failure;
  if (failure.empty()) made.error["force_rms"] = error;
  for (const double factor : {0.99, 1.0, 1.01}) {
    Timing timing;
    timing.per_second = cost * factor;
    made.timings.push_back(timing);
  }
  return made;
}

Result made() {
  Result result;
  result.study.factors = {{"dynamics_rate", {}}, {"coupling", {}}};
  result.metrics = {"force_rms"};
  result.reference.noticeable["force_rms"] = 0.3;
  result.outcomes = {outcome("200", "soft", 0.010, 0.2),     outcome("100", "soft", 0.005, 0.4),
                     outcome("400", "soft", 0.020, 0.1),     outcome("100", "explicit", 0.005, 0, "cube was dropped"),
                     outcome("200", "explicit", 0.010, 0.8), outcome("400", "explicit", 0.020, 0.4)};
  return result;
}

std::vector<std::size_t> frontIndices(const Result& result) {
  std::vector<std::size_t> indices;
  for (const Judged& each : frontOf(result, "force_rms")) indices.push_back(each.index);
  return indices;
}

TEST(Analysis, TheFrontHoldsWhatNothingBeats) { EXPECT_EQ(frontIndices(made()), (std::vector<std::size_t>{1, 0, 2})); }

TEST(Analysis, TheDistanceFromTheFrontIsThatInCostAndThatInError) {
  Result result = made();
  const auto on = distanceToFront(result, "force_rms");
  ASSERT_TRUE(on);
  EXPECT_EQ(on->cost, 1);
  EXPECT_EQ(on->error, 1);
  // one as accurate at 0.8 of the cost, one no dearer at a quarter of the error, and better ones that must not count
  result.outcomes.push_back(outcome("150", "soft", 0.008, 0.2));
  result.outcomes.push_back(outcome("170", "soft", 0.010, 0.05));
  result.outcomes.push_back(outcome("500", "soft", 0.0111, 0.01));
  result.outcomes.push_back(outcome("600", "soft", 0.001, 0.01, "cube was dropped"));
  const auto off = distanceToFront(result, "force_rms");
  EXPECT_NEAR(off->cost, 1.25, 1e-12);
  EXPECT_EQ(off->as_accurate, 6u);
  EXPECT_NEAR(off->error, 4, 1e-12);
  EXPECT_EQ(off->as_cheap, 7u);
  EXPECT_NEAR(off->ratio(), 4, 1e-12) << "the larger one is what the default gives away";
  // an engine without fingers cannot be a default
  for (Outcome& each : result.outcomes) each.setting.choices.emplace_back("engine", "ode");
  result.outcomes.push_back(outcome("200", "soft", 0.001, 0.001));
  result.outcomes.back().setting.choices.emplace_back("engine", "bullet");
  EXPECT_EQ(distanceToFront(result, "force_rms")->ratio(), off->ratio());
  EXPECT_FALSE(distanceToFront(result, "hum")) << "the default has no such error";
}

// Errors below ten times the difference of two references count as equal: the cheapest of these settings is the front.
TEST(Analysis, ErrorsBelowTheResolutionAreEqual) {
  Result result = made();
  result.reference.residual["force_rms"] = 0.03;
  EXPECT_NEAR(result.resolution("force_rms"), 0.3, 1e-15);
  EXPECT_FALSE(result.resolved(result.outcomes[0], "force_rms"));
  EXPECT_TRUE(result.resolved(result.outcomes[1], "force_rms"));
  EXPECT_TRUE(result.resolved(result.outcomes[3], "force_rms")) << "a failure has no error to doubt";
  EXPECT_EQ(frontIndices(result), (std::vector<std::size_t>{1, 0}));
  EXPECT_FALSE(cheapestBelow(result, "force_rms", 0.3)) << "nothing is known to be below";
  EXPECT_EQ(distanceToFront(result, "force_rms")->ratio(), 1);
}

TEST(Analysis, OneFactorBuysWhatItsNeighboursShow) {
  const auto gains = factorGains(made(), "force_rms");
  ASSERT_EQ(gains.size(), 3u);
  EXPECT_EQ(gains[0].to, "100");
  EXPECT_NEAR(gains[0].error_ratio, 2, 1e-12);
  EXPECT_NEAR(gains[0].per_double_cost.value(), 0.5, 1e-9);  // half the cost, twice the error
  EXPECT_NEAR(gains[1].per_double_cost.value(), 0.5, 1e-9);
  EXPECT_EQ(gains[2].factor, "coupling");
  EXPECT_NEAR(gains[2].error_ratio, 4, 1e-12);
  EXPECT_FALSE(gains[2].per_double_cost) << "the cost did not change";
}

TEST(Analysis, TheCheapestBelowALimit) {
  EXPECT_EQ(cheapestBelow(made(), "force_rms", 0.3), 0u);
  EXPECT_EQ(cheapestBelow(made(), "force_rms", 0.5), 1u);
  EXPECT_FALSE(cheapestBelow(made(), "force_rms", 0.05));
}

TEST(Analysis, TheCheapestThatNobodyFeelsIsBelowEveryLimit) {
  Result result = made();
  EXPECT_EQ(cheapestUnfelt(result), 0u);
  result.metrics.push_back("grip");
  result.reference.noticeable["grip"] = 1;
  EXPECT_FALSE(cheapestUnfelt(result)) << "no setting has that error";
  result.outcomes[2].error["grip"] = 0.5;
  EXPECT_EQ(cheapestUnfelt(result), 2u);
}

TEST(Sentences, SayWhatTheNumbersSay) {
  using Kind = SentenceRule::Kind;
  Result result = made();
  result.study.sentences = {
      {.kind = Kind::kBelow, .metric = "force_rms"},
      {.kind = Kind::kHalving, .metric = "force_rms", .factor = "dynamics_rate"},
      {.kind = Kind::kCompare, .metric = "force_rms", .factor = "coupling", .a = "soft", .b = "explicit"},
      {.kind = Kind::kCheapest, .metric = "force_rms"},
      {.kind = Kind::kFailures},
      {.kind = Kind::kBelow, .metric = "hum"},
      {.kind = Kind::kFront, .metric = "force_rms"}};
  const auto texts = sentences(result);
  ASSERT_EQ(texts.size(), 6u) << "a metric that the scene does not have has no sentence";
  EXPECT_NE(texts[0].find("2 of 6 settings stay below the just-noticeable difference of 0.3 N"), std::string::npos)
      << texts[0];
  EXPECT_NE(texts[1].find("by 2 (2 to 2 over 3 pairs) and multiplies the processor time by 2."), std::string::npos)
      << texts[1];
  EXPECT_NE(texts[2].find("times 4 (4 to 4 over 2 pairs)"), std::string::npos) << texts[2];
  EXPECT_NE(texts[2].find("explicit fails in 1 of 3 settings, soft in 0"), std::string::npos) << texts[2];
  EXPECT_NE(texts[3].find("is default: 10 ms"), std::string::npos) << texts[3];
  EXPECT_NE(texts[4].find("1 of 6 settings failed: cube was dropped (1)"), std::string::npos) << texts[4];
  EXPECT_EQ(texts[5], "The default lies on the front of force, RMS error.");
  result.outcomes.push_back(outcome("150", "soft", 0.005, 0.1));
  EXPECT_EQ(
      sentences(result).back(),
      "The default lies beyond 1.3 times of the front of force, RMS error: as accurate at 0.5 times the processor "
      "time is rate 150 soft, and no dearer at 0.5 times the error is rate 150 soft.");
}

// A cost within 5 % is no reason: the timing of another run would turn it round.
TEST(Analysis, CostsThatTimingCannotTellApartAreTheSame) {
  Result result = made();
  result.outcomes.push_back(outcome("210", "soft", 0.0098, 0.2));
  EXPECT_EQ(distanceToFront(result, "force_rms")->ratio(), 1) << "as accurate, not measurably cheaper";
  result.outcomes.push_back(outcome("220", "soft", 0.0102, 0.1));
  EXPECT_NEAR(distanceToFront(result, "force_rms")->error, 2, 1e-12) << "more accurate, not measurably dearer";
}

TEST(Verdict, NamesWhatBeatsTheDefaultAndWhatDoesNot) {
  Result result = made();
  result.study.sentences = {{.kind = SentenceRule::Kind::kFront, .metric = "force_rms"}};
  EXPECT_EQ(verdictOf(result).kind, Verdict::Kind::kOnFront);
  // a fifth more accurate at the same cost: better in all that is judged, if in little
  result.outcomes.push_back(outcome("210", "soft", 0.010, 0.16));
  EXPECT_EQ(verdictOf(result).better, 6u);
  // a fifth cheaper and as accurate: near
  result.outcomes.back() = outcome("210", "soft", 0.008, 0.2);
  EXPECT_EQ(verdictOf(result).kind, Verdict::Kind::kNear);
  // half the error at the same cost, but what was not felt is felt
  result.outcomes.back() = outcome("210", "soft", 0.010, 0.1);
  EXPECT_EQ(verdictOf(result).kind, Verdict::Kind::kBeaten);
  EXPECT_TRUE(verdictOf(result).unfelt) << "0.2 N of 0.3 that are just noticeable";
  EXPECT_NE(verdictOf(result).headline.find("nobody feels the errors of either"), std::string::npos);
  result.reference.noticeable["force_rms"] = 0.15;
  EXPECT_FALSE(verdictOf(result).unfelt);
  result.reference.noticeable.erase("force_rms");
  EXPECT_FALSE(verdictOf(result).unfelt) << "nothing is known of what people feel";
  result.reference.noticeable["force_rms"] = 0.3;
  result.metrics.push_back("position");
  result.reference.noticeable["position"] = 1;
  result.outcomes.front().error["position"] = 0.1;
  result.outcomes.back().error["position"] = 2;
  EXPECT_EQ(verdictOf(result).kind, Verdict::Kind::kTradeOff);
  result.outcomes.front().failure = "cube was dropped";
  EXPECT_EQ(verdictOf(result).headline, "The default fails: cube was dropped");
}

}  // namespace
}  // namespace presa::cost
