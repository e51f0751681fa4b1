#pragma once
#include <cmath>

/// Central range of a binomial count: the probability below `low` and above `high` is at most (1 - mass) / 2 each.
struct BinomialRange {
  int low = 0, high = 0;
};

inline BinomialRange binomialRange(int n, double p, double mass) {
  const auto pmf = [&](int k) {
    return std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
                    (n - k) * std::log1p(-p));
  };
  const double tail = (1 - mass) / 2;
  BinomialRange range{0, n};
  double below = pmf(0), above = pmf(n);
  while (below <= tail) below += pmf(++range.low);
  while (above <= tail) above += pmf(--range.high);
  return range;
}
