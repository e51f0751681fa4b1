#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "framework/core/math/random.h"
#include "tests/experiments/runner/statistics/grip_design.h"

namespace presa::statistics {

/// The grip force that the rule of the simulated subject gives for a slip force, without time stepping:
///   G = (G^ / (1 - SM) + z sqrt((cv G^ / (1 - SM))^2 + s0^2 + (k dX)^2 / 12 + (k d_h)^2)) exp(scatter xi),
/// where G^ = m g / (2 mu_s) (1 + w_F xi) is the remembered slip force. A model, not a person: it only supplies data to
/// test the statistics.
struct SurrogateRule {
  double own_resolution = 0;  ///< d_h [m]
  double scatter = 0;         ///< SD of ln G from trial to trial
};

/// Three subjects, each with the 27 cubes twice; traits are drawn per subject from the model's populations.
struct SurrogateStudy {
  SurrogateStudy(std::uint64_t seed, const SurrogateRule& rule) {
    for (std::uint64_t subject = 0; subject < 3; ++subject) {
      RandomStream traits(seed, "traits", subject), trials(seed, "trials", subject);
      const double cv = traits.uniform(0.02, 0.04), weber = traits.uniform(0.07, 0.10), sm = traits.uniform(0.1, 0.4);
      const double z = std::abs(2 + 0.5 * traits.normal());
      for (std::size_t i = 54 * subject; i < 54 * (subject + 1); ++i) {
        const double k = design.stiffness[i], encoder = trials.uniform(55e-6, 130e-6);
        const double remembered = std::max(0.05, design.slip[i] * (1 + weber * trials.normal()));
        const double base = remembered / (1 - sm);
        const double uncertainty = std::sqrt(std::pow(cv * base, 2) + 0.02 * 0.02 + std::pow(k * encoder, 2) / 12 +
                                             std::pow(k * rule.own_resolution, 2));
        grip.push_back((base + z * uncertainty) * std::exp(rule.scatter * trials.normal()));
        subjects.push_back(static_cast<int>(subject));
      }
    }
  }
  GripDesign design{6};
  std::vector<double> grip;  ///< [N]
  std::vector<int> subjects;
};

}  // namespace presa::statistics
