#include "experiments/runner/statistics/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace presa::statistics {
namespace {

namespace bm = boost::math;
using bm::policies::ignore_error;

// report errors as values and avoid long double, so that every machine computes the same bits
using Policy =
    bm::policies::policy<bm::policies::domain_error<ignore_error>, bm::policies::pole_error<ignore_error>,
                         bm::policies::overflow_error<ignore_error>, bm::policies::evaluation_error<ignore_error>,
                         bm::policies::promote_double<false>, bm::policies::promote_float<false>>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double normalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normalQuantile(double p) {
  if (!(p >= 0 && p <= 1)) return kNan;
  if (p == 0 || p == 1) return p == 0 ? -kInfinity : kInfinity;
  return bm::quantile(bm::normal_distribution<double, Policy>(), p);
}

double studentQuantile(double p, double df) {
  if (!(p > 0 && p < 1 && df > 0)) return kNan;
  return bm::quantile(bm::students_t_distribution<double, Policy>(df), p);
}

double studentTwoSidedP(double t, double df) {
  if (std::isnan(t) || !(df > 0)) return kNan;
  if (std::isinf(t)) return 0;
  return 2 * bm::cdf(bm::complement(bm::students_t_distribution<double, Policy>(df), std::abs(t)));
}

double chiSquareUpperP(double x, double df) {
  if (!(x >= 0 && df > 0)) return kNan;
  if (std::isinf(x)) return 0;
  return bm::cdf(bm::complement(bm::chi_squared_distribution<double, Policy>(df), x));
}

}  // namespace presa::statistics
