#pragma once

/// The distributions used by the analyses. Only distributions.cpp includes Boost.Math. Outside the stated domain the
/// result is NaN; nothing throws. Thread: any.
namespace presa::statistics {

/// P(Z <= z), exact in both tails.
double normalCdf(double z);
/// z with P(Z <= z) = p; -inf at 0, +inf at 1.
double normalQuantile(double p);
/// t with P(T <= t) = p; 0 < p < 1, degrees of freedom df > 0.
double studentQuantile(double p, double df);
/// P(|T| >= |t|); df > 0. Infinite t: 0.
double studentTwoSidedP(double t, double df);
/// P(X >= x); x >= 0, df > 0.
double chiSquareUpperP(double x, double df);

}  // namespace presa::statistics
