#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/means.h"
#include "experiments/runner/statistics/regression.h"
#include "experiments/runner/statistics/resampling.h"
#include "tests/experiments/runner/statistics/surrogate_subject.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;

struct Quoted {
  const char* name;
  SurrogateRule rule;
  std::array<double, 3> rho;  ///< of the grip force with friction, mass and stiffness: means over 200 seeds
};

class Surrogate : public testing::TestWithParam<Quoted> {};
INSTANTIATE_TEST_SUITE_P(Statistics, Surrogate,
                         testing::Values(Quoted{"L0", {0, 0}, {-0.582, 0.775, 0.018}},
                                         Quoted{"d_h 0.2 mm", {0.2e-3, 0}, {-0.571, 0.749, 0.187}},
                                         Quoted{"d_h 0.5 mm", {0.5e-3, 0}, {-0.521, 0.672, 0.391}},
                                         Quoted{"d_h 1 mm", {1e-3, 0}, {-0.438, 0.546, 0.587}},
                                         Quoted{"scatter 0.3", {0, 0.3}, {-0.553, 0.712, 0.017}},
                                         Quoted{"scatter 0.6", {0, 0.6}, {-0.468, 0.588, 0.016}}));

// The quoted means are over 200 seeds of another generator: two such means differ by sd sqrt(2/200); the bound is four
// of these plus the rounding of the last digit. The standard deviations over seeds are quoted as 0.01 to 0.06.
TEST_P(Surrogate, HasTheCorrelationsOfTheModel) {
  constexpr std::uint64_t kSeeds = 200;
  std::array<Values, 3> rho;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const SurrogateStudy study(seed, GetParam().rule);
    rho[0].push_back(*spearman(study.grip, study.design.mu_s));
    rho[1].push_back(*spearman(study.grip, study.design.mass));
    rho[2].push_back(*spearman(study.grip, study.design.stiffness));
  }
  for (std::size_t factor = 0; factor < 3; ++factor) {
    const double sd = *standardDeviation(rho[factor]);
    EXPECT_NEAR(*mean(rho[factor]), GetParam().rho[factor], 4 * sd * std::sqrt(2.0 / kSeeds) + 5e-4)
        << GetParam().name << ", factor " << factor;
    EXPECT_GT(sd, 0.005) << GetParam().name << ", factor " << factor;
    EXPECT_LT(sd, 0.065) << GetParam().name << ", factor " << factor;
  }
}

// One study of the subject with human resolution, through every statistic of a report.
TEST(SurrogateChain, OneStudyThroughAllStatistics) {
  const SurrogateStudy study(20061, {0.2e-3, 0});
  const GripDesign& design = study.design;
  const SpearmanTest stiffness = *spearmanTest(study.grip, design.stiffness);
  EXPECT_EQ(stiffness.n, 162U);
  EXPECT_GT(std::abs(stiffness.rho), *criticalCorrelation(162, 0.05));
  EXPECT_LT(stiffness.p, 0.05);
  EXPECT_GT(stiffness.interval.low, 0);
  RandomStream random(20061, "permutation");
  EXPECT_LT(spearmanPermutation(study.grip, design.stiffness, study.subjects, 2000, random)->p, 0.05);
  EXPECT_FALSE(bootstrapSubjects(
                   study.subjects, [](auto) { return 0.0; }, 10, 0.95, random)
                   .interval);

  // to the slip force (exponents 1, -1, 0) the rule adds terms that grow with stiffness but not with the slip force
  const std::vector<Values> factors{design.mass, design.mu_s, design.stiffness};
  const LinearFit exponents = *logLinear(study.grip, factors, study.subjects);
  EXPECT_LT(exponents.coefficients[0].interval.high, 1);
  EXPECT_GT(exponents.coefficients[1].interval.low, -1);
  EXPECT_GT(exponents.coefficients[2].interval.low, 0);
  const ControlSlope slope =
      *controlSlope(study.grip, design.stiffness, std::vector{design.mass, design.mu_s}, study.subjects);
  EXPECT_NEAR(slope.slope().value, exponents.coefficients[2].value - 1, 1e-12);
  EXPECT_LT(slope.p_force, 1e-3);

  // the relative margin falls with mass and grows with stiffness
  const auto median_margin = [&](const Values& factor, double level) {
    Values margins;
    for (std::size_t i = 0; i < factor.size(); ++i) {
      if (factor[i] == level) margins.push_back(*relativeSafetyMargin(study.grip[i], design.slip[i]));
    }
    return *median(margins);
  };
  EXPECT_GT(median_margin(design.mass, 0.1), median_margin(design.mass, 0.2));
  EXPECT_GT(median_margin(design.mass, 0.2), median_margin(design.mass, 0.4));
  EXPECT_LT(median_margin(design.stiffness, 500), median_margin(design.stiffness, 1000));
  EXPECT_LT(median_margin(design.stiffness, 1000), median_margin(design.stiffness, 2000));

  std::vector<LabelledValue> by_mass;
  for (std::size_t i = 0; i < 162; ++i) {
    by_mass.push_back({study.subjects[i], static_cast<int>(std::lround(10 * design.mass[i])), study.grip[i]});
  }
  const WithinSubjectIntervals within = *withinSubjectIntervals(by_mass);
  EXPECT_EQ(within.subjects, 3U);
  ASSERT_EQ(within.conditions.size(), 3U);
  EXPECT_LT(within.conditions[0].mean, within.conditions[1].mean);
  EXPECT_LT(within.conditions[1].mean, within.conditions[2].mean);
}

}  // namespace
}  // namespace presa::statistics
