// Power over the number of subjects: what the page and its file say.
#include "apps/experiment/simulate/power_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace presa::experiment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PowerCurve, IsMeasuredAtUpToSixNumbersOfSubjects) {
  EXPECT_THAT(curveSizes(3), ElementsAre(1, 2, 3));
  EXPECT_THAT(curveSizes(24), ElementsAre(4, 8, 12, 16, 20, 24));
  EXPECT_EQ(curveSizes(25).back(), 25);
}

// The interval of Wilson for 8 of 10: 0.490 to 0.943.
TEST(PowerCurve, KnowsHowUncertainItIs) {
  const PowerCurve::Point point = powerPoint(12, 8, 10);
  EXPECT_EQ(point.power, 0.8);
  EXPECT_NEAR(point.low, 0.4902, 1e-4);
  EXPECT_NEAR(point.high, 0.9433, 1e-4);
}

TEST(PowerCurve, CountsFromWhereThePowerStays) {
  const PowerCurve up_and_down{"t", {powerPoint(4, 9, 10), powerPoint(8, 7, 10), powerPoint(12, 9, 10)}};
  EXPECT_EQ(up_and_down.reached(0.8), 12) << "9 of 10 with 4 subjects was luck: 7 of 10 with 8";
  EXPECT_EQ(up_and_down.reached(0.95), 0);
  EXPECT_EQ(up_and_down.reached(0.7), 4);
}

TEST(PowerCurve, ThePageSaysFirstWhetherTheSubjectsAreEnough) {
  const std::vector<PowerCurve> curves{{"grip", {powerPoint(6, 9, 10), powerPoint(12, 10, 10)}},
                                       {"slip", {powerPoint(6, 1, 10), powerPoint(12, 4, 10)}}};
  const std::string html = powerFigure(curves, 12, 0.8);
  EXPECT_THAT(html, HasSubstr("<b>12 subjects give a power of 0.8 in 1 of 2 tests</b>"));
  EXPECT_THAT(html, HasSubstr("grip: power 1.00 (0.72 to 1.00) with 12 subjects; 6 are enough."));
  EXPECT_THAT(html, HasSubstr("slip: power 0.40 (0.17 to 0.69) with 12 subjects; that is too few."));
  EXPECT_LT(html.find("<b>"), html.find("class=\"plot"));
  EXPECT_THAT(html, HasSubstr("planned: 12"));
  EXPECT_THAT(powerFigure({{"one", {powerPoint(1, 10, 10), powerPoint(2, 10, 10)}}}, 2, 0.8),
              HasSubstr("; 1 is enough."));
  EXPECT_THAT(powerCurveCsv(curves), HasSubstr("12,\"slip\",0.4,"));
  EXPECT_THAT(powerFigure({}, 12, 0.8), HasSubstr("has no test"));
}

}  // namespace
}  // namespace presa::experiment
