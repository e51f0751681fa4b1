#include "experiments/runner/statistics/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "framework/core/math/random.h"
#include "tests/experiments/runner/statistics/grip_design.h"

namespace presa::statistics {
namespace {

using Values = std::vector<double>;

Eigen::MatrixXd withIntercept(const std::vector<Values>& predictors) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(predictors[0].size()),
                                                  static_cast<Eigen::Index>(predictors.size() + 1));
  for (std::size_t i = 0; i < predictors.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i + 1)) =
        Eigen::Map<const Eigen::VectorXd>(predictors[i].data(), columns.rows());
  }
  return columns;
}

Eigen::VectorXd vectorOf(const Values& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// NIST StRD, Longley: ill-conditioned (4859 even after centring and scaling the columns); certified values to 9 digits.
TEST(LeastSquares, LongleyAsCertified) {
  const Values y{60323, 61122, 60171, 61187, 63221, 63639, 64989, 63761,
                 66019, 67857, 68169, 66513, 68655, 69564, 69331, 70551};
  const std::vector<Values> x{
      {83.0, 88.5, 88.2, 89.5, 96.2, 98.1, 99.0, 100.0, 101.2, 104.6, 108.4, 110.8, 112.6, 114.2, 115.7, 116.9},
      {234289, 259426, 258054, 284599, 328975, 346999, 365385, 363112, 397469, 419180, 442769, 444546, 482704, 502601,
       518173, 554894},
      {2356, 2325, 3682, 3351, 2099, 1932, 1870, 3578, 2904, 2822, 2936, 4681, 3813, 3931, 4806, 4007},
      {1590, 1456, 1616, 1650, 3099, 3594, 3547, 3350, 3048, 2857, 2798, 2637, 2552, 2514, 2572, 2827},
      {107608, 108632, 109773, 110929, 112075, 113270, 115094, 116219, 117388, 118734, 120445, 121950, 123366, 125368,
       127852, 130081},
      {1947, 1948, 1949, 1950, 1951, 1952, 1953, 1954, 1955, 1956, 1957, 1958, 1959, 1960, 1961, 1962}};
  const LinearFit fit = *leastSquares(withIntercept(x), vectorOf(y));
  const Values certified{-3482258.63459582, 15.0618722713733,    -0.0358191792925910, -2.02022980381683,
                         -1.03322686717359, -0.0511041056535807, 1829.15146461355};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(fit.coefficients[i].value / certified[i], 1, 1e-9) << i;
  EXPECT_NEAR(fit.coefficients[0].standard_error / 890420.383607373, 1, 1e-9);
  EXPECT_NEAR(fit.coefficients[1].standard_error / 84.9149257747669, 1, 1e-9);
  EXPECT_NEAR(fit.coefficients[6].standard_error / 455.478499142212, 1, 1e-9);
  EXPECT_NEAR(fit.residual_sd / 304.854073561965, 1, 1e-9);
  EXPECT_NEAR(fit.r_squared, 0.995479004577296, 1e-12);
  EXPECT_EQ(fit.df, 9U);
  const Coefficient& year = fit.coefficients[6];
  EXPECT_NEAR(year.t, year.value / year.standard_error, 1e-12);
  EXPECT_NEAR(year.interval.halfWidth() / year.standard_error, 2.262157, 5e-7);  // t(.975, 9)
  EXPECT_NEAR(year.p, 0.003037, 5e-7);                                           // as R prints it
}

TEST(LeastSquares, NoResultWhereThereIsNone) {
  const Values y{1, 2, 4, 3}, nan{1, 2, std::numeric_limits<double>::quiet_NaN(), 3};
  const auto fits = [](const std::vector<Values>& x, const Values& of) {
    return leastSquares(withIntercept(x), vectorOf(of)).has_value();
  };
  EXPECT_TRUE(fits({{1, 2, 3, 4}}, y));
  EXPECT_FALSE(fits({{1, 2, 3, 4}}, nan));
  EXPECT_FALSE(fits({nan}, y));
  EXPECT_FALSE(fits({{5, 5, 5, 5}}, y));                              // dependent on the intercept
  EXPECT_FALSE(fits({{1, 2, 3, 4}, {2, 4, 6, 8.0000000001}}, y));     // dependent on its neighbour
  EXPECT_FALSE(fits({{1, 2, 3, 4}, {1, 0, 0, 1}, {0, 1, 0, 0}}, y));  // no degree of freedom
  EXPECT_FALSE(fits({{0, 0, 0, 0}}, y));
  EXPECT_FALSE(fits({{1, 2, 3, 4}}, {2, 2, 2, 2}));
  EXPECT_FALSE(fits({{1, 2, 3, 4}}, {2, 2, 2}));
  EXPECT_FALSE(leastSquares(withIntercept({{1, 2, 3, 4}}), vectorOf(y), 1));
}

struct Trials {
  GripDesign design{6};  // 3 subjects x 54
  std::vector<int> subjects;
  Values force;
  Trials(double of_mass, double of_mu, double of_k, double scatter) {
    RandomStream random(5, "trials");
    for (std::size_t i = 0; i < design.mass.size(); ++i) {
      subjects.push_back(static_cast<int>(i / 54));
      force.push_back((1 + subjects.back()) * std::pow(design.mass[i], of_mass) * std::pow(design.mu_s[i], of_mu) *
                      std::pow(design.stiffness[i], of_k) * std::exp(scatter * random.normal()));
    }
  }
  std::vector<Values> predictors() const { return {design.mass, design.mu_s, design.stiffness}; }
};

TEST(LogLinear, ExponentsOfTheSlipForceAreExact) {
  const GripDesign design(6);
  std::vector<int> subjects(162);
  for (std::size_t i = 0; i < 162; ++i) subjects[i] = static_cast<int>(i / 54);
  const LinearFit fit =
      *logLinear(design.slip, std::vector<Values>{design.mass, design.mu_s, design.stiffness}, subjects);
  EXPECT_NEAR(fit.coefficients[0].value, 1, 1e-12);
  EXPECT_NEAR(fit.coefficients[1].value, -1, 1e-12);
  EXPECT_NEAR(fit.coefficients[2].value, 0, 1e-12);
  EXPECT_NEAR(fit.residual_sd, 0, 1e-12);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
}

// [Frisch & Waugh 1933]: centring and a dummy per subject give the same fit, including the standard errors.
TEST(LogLinear, EqualsDummiesPerSubject) {
  const Trials trials(0.8, -0.9, 0.2, 0.16);
  const LinearFit centred = *logLinear(trials.force, trials.predictors(), trials.subjects);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(162, 6);
  Eigen::VectorXd y(162);
  for (Eigen::Index i = 0; i < 162; ++i) {
    const auto at = static_cast<std::size_t>(i);
    columns.row(i).head(3) << std::log(trials.design.mass[at]), std::log(trials.design.mu_s[at]),
        std::log(trials.design.stiffness[at]);
    columns(i, 3 + trials.subjects[at]) = 1;
    y[i] = std::log(trials.force[at]);
  }
  const LinearFit dummies = *leastSquares(columns, y);
  EXPECT_EQ(centred.df, dummies.df);
  EXPECT_NEAR(centred.residual_sd, dummies.residual_sd, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(centred.coefficients[i].value, dummies.coefficients[i].value, 1e-12);
    EXPECT_NEAR(centred.coefficients[i].standard_error, dummies.coefficients[i].standard_error, 1e-12);
  }
  // each true exponent lies in its own 99.9 % interval
  const LinearFit wide = *logLinear(trials.force, trials.predictors(), trials.subjects, 0.999);
  EXPECT_TRUE(wide.coefficients[0].interval.contains(0.8));
  EXPECT_TRUE(wide.coefficients[1].interval.contains(-0.9));
  EXPECT_TRUE(wide.coefficients[2].interval.contains(0.2));
  EXPECT_NEAR(wide.residual_sd, 0.16, 4 * 0.16 / std::sqrt(2.0 * 156));
}

TEST(LogLinear, NoResultWhereThereIsNone) {
  Trials trials(1, -1, 0, 0.1);
  Values of_subject;  // constant within each subject
  for (const int subject : trials.subjects) of_subject.push_back(0.1 * (1 + subject));
  EXPECT_FALSE(logLinear(trials.force, std::vector<Values>{of_subject}, trials.subjects));
  EXPECT_FALSE(logLinear(of_subject, trials.predictors(), trials.subjects));
  EXPECT_FALSE(logLinear(trials.force, trials.predictors(), std::vector<int>(161)));
  EXPECT_FALSE(logLinear(trials.force, std::vector<Values>{Values(161, 1)}, trials.subjects));
  EXPECT_FALSE(logLinear({}, {}, {}));
  trials.force[7] = 0;
  EXPECT_FALSE(logLinear(trials.force, trials.predictors(), trials.subjects));
}

TEST(ControlSlope, TellsForceFromDepth) {
  const auto slope = [](double of_k) {
    const Trials trials(1, -1, of_k, 0.15);
    return *controlSlope(trials.force, trials.design.stiffness,
                         std::vector<Values>{trials.design.mass, trials.design.mu_s}, trials.subjects, 0.999);
  };
  const ControlSlope force = slope(0), depth = slope(1), between = slope(0.5);
  EXPECT_TRUE(force.slope().interval.contains(-1));
  EXPECT_GT(force.p_force, 0.001);
  EXPECT_LT(force.slope().p, 1e-6);
  EXPECT_TRUE(depth.slope().interval.contains(0));
  EXPECT_GT(depth.slope().p, 0.001);
  EXPECT_LT(depth.p_force, 1e-6);
  EXPECT_TRUE(between.slope().interval.contains(-0.5));
  EXPECT_LT(between.p_force, 1e-6);
  EXPECT_LT(between.slope().p, 1e-6);
}

// In a balanced design the other factors change the error of the slope, not the slope. The slope is the exponent of k
// minus 1.
TEST(ControlSlope, IsTheExponentOfStiffnessLessOne) {
  const Trials trials(0.8, -0.9, 0.2, 0.16);
  const std::vector<Values> others{trials.design.mass, trials.design.mu_s};
  const ControlSlope with = *controlSlope(trials.force, trials.design.stiffness, others, trials.subjects);
  const ControlSlope alone = *controlSlope(trials.force, trials.design.stiffness, {}, trials.subjects);
  EXPECT_NEAR(with.slope().value, alone.slope().value, 1e-12);
  EXPECT_LT(with.slope().standard_error, 0.5 * alone.slope().standard_error);
  EXPECT_NEAR(with.slope().value,
              logLinear(trials.force, trials.predictors(), trials.subjects)->coefficients[2].value - 1, 1e-12);
  EXPECT_FALSE(controlSlope(trials.force, Values(3, 500), {}, trials.subjects));
  EXPECT_FALSE(controlSlope(trials.force, Values(162, 500), {}, trials.subjects));
}

}  // namespace
}  // namespace presa::statistics
