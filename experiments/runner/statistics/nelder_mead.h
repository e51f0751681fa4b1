#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace presa::statistics {

template <std::size_t N>
struct Minimum {
  std::array<double, N> at{};
  double value = 0;
};

struct NelderMeadOptions {
  double first_step = 0.3;         ///< along each axis: choose units in which it is small but not tiny
  double value_tolerance = 1e-10;  ///< converged when the values at the corners agree to this …
  double size_tolerance = 1e-7;    ///< … and the corners are this close
  int max_evaluations = 4000;
};

/// A local minimum of `f` over N variables without derivatives [Nelder & Mead 1965, coefficients 1, 2, 1/2, 1/2]. `f`
/// may be infinite but not NaN, and must be finite at `start`. Deterministic; allocates nothing. Returns the best point
/// so far when it does not converge within max_evaluations.
template <std::size_t N, class Function>
Minimum<N> nelderMead(const Function& f, const std::array<double, N>& start, const NelderMeadOptions& options = {}) {
  std::array<Minimum<N>, N + 1> simplex;
  int evaluations = 0;
  const auto evaluated = [&](const std::array<double, N>& at) { return ++evaluations, Minimum<N>{at, f(at)}; };
  const auto between = [](const std::array<double, N>& a, const std::array<double, N>& b, double share) {
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = a[i] + share * (b[i] - a[i]);
    return result;
  };
  const auto by_value = [](const Minimum<N>& a, const Minimum<N>& b) { return a.value < b.value; };

  simplex[0] = evaluated(start);
  for (std::size_t i = 0; i < N; ++i) {
    std::array<double, N> corner = start;
    corner[i] += options.first_step;
    simplex[i + 1] = evaluated(corner);
  }
  for (;;) {
    std::stable_sort(simplex.begin(), simplex.end(), by_value);
    Minimum<N>&best = simplex.front(), &worst = simplex.back();
    double size = 0;
    for (const Minimum<N>& corner : simplex) {
      for (std::size_t i = 0; i < N; ++i) size = std::max(size, std::abs(corner.at[i] - best.at[i]));
    }
    const bool converged = worst.value - best.value <= options.value_tolerance && size <= options.size_tolerance;
    if (converged || evaluations >= options.max_evaluations) return best;

    std::array<double, N> centre{};
    for (std::size_t c = 0; c < N; ++c) {
      for (std::size_t i = 0; i < N; ++i) centre[i] += simplex[c].at[i] / static_cast<double>(N);
    }
    const Minimum<N> reflected = evaluated(between(centre, worst.at, -1));
    if (reflected.value < best.value) {
      const Minimum<N> expanded = evaluated(between(centre, worst.at, -2));
      worst = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < simplex[N - 1].value) {
      worst = reflected;
    } else {
      const Minimum<N>& better = reflected.value < worst.value ? reflected : worst;
      const Minimum<N> contracted = evaluated(between(centre, better.at, 0.5));
      if (contracted.value < better.value) {
        worst = contracted;
      } else {
        for (std::size_t c = 1; c <= N; ++c) simplex[c] = evaluated(between(best.at, simplex[c].at, 0.5));
      }
    }
  }
}

}  // namespace presa::statistics
