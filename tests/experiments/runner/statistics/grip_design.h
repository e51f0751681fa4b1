#pragma once
#include <array>
#include <vector>

#include "experiments/runner/statistics/margin.h"
#include "experiments/runner/statistics/ranks.h"

namespace presa::statistics {

/// The 27 cubes of the grip study, each `repeats` times; one entry per trial.
struct GripDesign {
  explicit GripDesign(int repeats = 1) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      for (const double m : {0.1, 0.2, 0.4}) {
        for (const std::array<double, 2> friction : {std::array{0.4, 0.3}, {0.8, 0.6}, {1.2, 1.1}}) {
          for (const double k : {500.0, 1000.0, 2000.0}) {
            mass.push_back(m), mu_s.push_back(friction[0]), mu_d.push_back(friction[1]), stiffness.push_back(k);
            slip.push_back(*slipForce(m, friction[0])), sliding.push_back(*slipForce(m, friction[1]));
          }
        }
      }
    }
  }
  std::vector<double> mass, mu_s, mu_d, stiffness;  ///< [kg], [1], [1], [N/m]
  std::vector<double> slip,
      sliding;  ///< [N]: m g / (2 mu_s) and m g / (2 mu_d)
};

}  // namespace presa::statistics
