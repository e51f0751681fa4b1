#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/definition/expression.h"

namespace presa::experiment {
namespace {

using testing::HasSubstr;

const SymbolTable kNames({"a", "thumb.fn", "nan"});
const std::vector<double> kValues{3, 0.5, std::nan("")};

double valueOf(const std::string& text) {
  Diagnostics diagnostics;
  const auto expression = Expression::compile(text, kNames, {"x.xml", 1, 1}, diagnostics);
  EXPECT_TRUE(expression) << diagnostics.text();
  return expression ? expression->evaluate(kValues) : std::nan("");
}

std::string findingOf(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(Expression::compile(text, kNames, {"x.xml", 7, 3}, diagnostics)) << text;
  return diagnostics.text();
}

TEST(Expression, FollowsTheRulesOfArithmetic) {
  EXPECT_EQ(valueOf("1 + 2 * 3"), 7);
  EXPECT_EQ(valueOf("(1 + 2) * 3"), 9);
  EXPECT_EQ(valueOf("8 / 4 / 2"), 1);
  EXPECT_EQ(valueOf("1 - 2 - 3"), -4);
  EXPECT_EQ(valueOf("-a * -2"), 6);
  EXPECT_EQ(valueOf("1e-3 + 2.5E+1"), 25.001);
  EXPECT_EQ(valueOf("100 * (a - thumb.fn) / a"), 250.0 / 3);
  EXPECT_EQ(valueOf("max(min(a, 2), abs(-1)) + hypot(3, 4) + sqrt(4) + ln(1) + exp(0)"), 10);
}

TEST(Expression, ComparesAndCombines) {
  EXPECT_EQ(valueOf("a > 2 and thumb.fn < 1"), 1);
  EXPECT_EQ(valueOf("a gt 2 and thumb.fn lt 1"), 1);
  EXPECT_EQ(valueOf("not a == 3 or thumb.fn != 0.5"), 0);
  EXPECT_EQ(valueOf("1 or 0 and 0"), 1);
  EXPECT_EQ(valueOf("a >= 3 and a <= 3 and a ge 3 and a le 3 and a eq 3"), 1);
}

// A guard on a missing number must not end a phase.
TEST(Expression, NothingHoldsOfNoNumber) {
  Diagnostics diagnostics;
  for (const char* text : {"nan > 0", "nan < 0", "nan == nan", "nan"})
    EXPECT_FALSE(Expression::compile(text, kNames, {}, diagnostics)->holds(kValues)) << text;
}

TEST(Expression, SaysWhereAndWhatIsWrong) {
  EXPECT_THAT(findingOf("a +"), HasSubstr("x.xml:7:3: error[E901]: at character 4 of 'a +'"));
  EXPECT_THAT(findingOf("a = 3"), HasSubstr("equal is written =="));
  EXPECT_THAT(findingOf("thum.fn > 1"), HasSubstr("did you mean 'thumb.fn'"));
  EXPECT_THAT(findingOf("sqr(4)"), HasSubstr("did you mean 'sqrt'"));
  EXPECT_THAT(findingOf("(a"), HasSubstr("expected ')', found the end"));
  EXPECT_THAT(findingOf("3x"), HasSubstr("'3x' is not a number"));
  EXPECT_THAT(findingOf("mean(hold, a)"), HasSubstr("there is no function 'mean'"));
  EXPECT_THAT(findingOf(std::string(500, '(') + "a" + std::string(500, ')')), HasSubstr("too deep"));
  std::string nested;
  for (int i = 0; i < 60; ++i) nested += "1+(";
  EXPECT_THAT(findingOf(nested + "a" + std::string(60, ')')), HasSubstr("too deep"));
}

TEST(Expression, AggregatesNameTheirPhase) {
  Diagnostics diagnostics;
  const std::vector<std::string> phases{"lift", "hold"};
  const SymbolTable samples({"t", "fn"});
  std::vector<Aggregate> aggregates;
  const auto expression = Expression::compile("a + first(hold, fn > 1 and t > 2, 2 * fn) / seconds(lift)", kNames, {},
                                              diagnostics, &aggregates, &samples, &phases);
  ASSERT_TRUE(expression) << diagnostics.text();
  ASSERT_EQ(aggregates.size(), 2U);
  EXPECT_EQ(aggregates[0].phase, 1U);
  const std::vector<double> sample{2.5, 4};
  EXPECT_TRUE(aggregates[0].condition->holds(sample));
  EXPECT_EQ(aggregates[0].value->evaluate(sample), 8);
  const std::vector<double> values{3, 0.5, 0, 8, 2};  // values of the names, then of the aggregates
  EXPECT_EQ(expression->evaluate(values), 7);
  EXPECT_FALSE(Expression::compile("mean(hald, fn)", kNames, {}, diagnostics, &aggregates, &samples, &phases));
  EXPECT_THAT(diagnostics.text(), HasSubstr("did you mean 'hold'"));
  EXPECT_FALSE(Expression::compile("mean(hold, a)", kNames, {}, diagnostics, &aggregates, &samples, &phases));
}

}  // namespace
}  // namespace presa::experiment
