// Fronts, gains and sentences of made-up numbers.
#include "apps/presa/cost/analysis.h"

#include <gtest/gtest.h>

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
  result.study.knobs = {{"dynamics_rate", {}}, {"coupling", {}}};
  result.metrics = {"force_rms"};
  result.reference.noticeable["force_rms"] = 0.3;
  result.outcomes = {outcome("200", "soft", 0.010, 0.2),     outcome("100", "soft", 0.005, 0.4),
                     outcome("400", "soft", 0.020, 0.1),     outcome("100", "explicit", 0.005, 0, "cube was dropped"),
                     outcome("200", "explicit", 0.010, 0.8), outcome("400", "explicit", 0.020, 0.4)};
  return result;
}

TEST(Analysis, TheFrontHoldsWhatNothingBeats) {
  EXPECT_EQ(paretoFront(made(), "force_rms"), (std::vector<std::size_t>{1, 0, 2}));
}

TEST(Analysis, OneKnobBuysWhatItsNeighboursShow) {
  const auto gains = knobGains(made(), "force_rms");
  ASSERT_EQ(gains.size(), 3u);
  EXPECT_EQ(gains[0].to, "100");
  EXPECT_NEAR(gains[0].error_ratio, 2, 1e-12);
  EXPECT_NEAR(gains[0].per_double_cost.value(), 0.5, 1e-9);  // half the cost, twice the error
  EXPECT_NEAR(gains[1].per_double_cost.value(), 0.5, 1e-9);
  EXPECT_EQ(gains[2].knob, "coupling");
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

TEST(Analysis, TheOrderIsTheSlope) {
  EXPECT_NEAR(observedOrder(made(), "force_rms", "dynamics_rate").value(), 1, 1e-12);
}

TEST(Sentences, SayWhatTheNumbersSay) {
  using Kind = SentenceRule::Kind;
  Result result = made();
  result.study.sentences = {
      {.kind = Kind::kBelow, .metric = "force_rms"},
      {.kind = Kind::kHalving, .metric = "force_rms", .knob = "dynamics_rate"},
      {.kind = Kind::kCompare, .metric = "force_rms", .knob = "coupling", .a = "soft", .b = "explicit"},
      {.kind = Kind::kCheapest, .metric = "force_rms"},
      {.kind = Kind::kFailures},
      {.kind = Kind::kBelow, .metric = "hum"}};
  const auto texts = sentences(result);
  ASSERT_EQ(texts.size(), 5u) << "a metric that the scene does not have has no sentence";
  EXPECT_NE(texts[0].find("2 of 6 settings stay below the just-noticeable difference of 0.3 N"), std::string::npos)
      << texts[0];
  EXPECT_NE(texts[1].find("by 2 (2 to 2 over 3 pairs) and multiplies the processor time by 2."), std::string::npos)
      << texts[1];
  EXPECT_NE(texts[2].find("times 4 (4 to 4 over 2 pairs)"), std::string::npos) << texts[2];
  EXPECT_NE(texts[2].find("explicit fails in 1 of 3 settings, soft in 0"), std::string::npos) << texts[2];
  EXPECT_NE(texts[3].find("is default: 10 ms"), std::string::npos) << texts[3];
  EXPECT_NE(texts[4].find("1 of 6 settings failed: cube was dropped (1)"), std::string::npos) << texts[4];
}

}  // namespace
}  // namespace presa::cost
