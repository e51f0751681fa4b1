#include <cmath>

#include "apps/common/terminal/text.h"
#include "apps/studies/lectures/lecture.h"
#include "apps/studies/lectures/wall.h"

namespace presa::lectures {

Lecture latency() {
  using terminal::format;
  constexpr double kMass = 2, kDamping = 2, kPeriod = 0.001;  // of the hand [kg, N s/m], and of the loop [s]
  Lecture lecture;
  lecture.name = "latency";
  lecture.title = "Latency: how hard a wall may be after a delay";
  lecture.description =
      "A hand of 2 kg and 2 N s/m leans on a wall at 1 kHz; the force of a sample is applied n samples later. Which "
      "stiffness does not shake the hand? Bisection, one run of a minute for each step.";
  lecture.knob = "delay";
  lecture.x_label = "delay and half a period, (n + 1/2) h [ms]";
  lecture.y_label = "largest stable stiffness [N/m]";
  lecture.oracle = "K = b / ((n + 1/2) h)";
  lecture.exact = "eigenvalues of the sampled loop";
  lecture.tolerance = 0.005;  // against the eigenvalues: ten times the step of the bisection
  double beyond_30 = 0;
  for (const int delay : {0, 1, 2, 5, 10, 20, 30, 50, 100}) {
    const stability::WallPlant plant{kMass, kDamping, kPeriod, delay};
    const double formula = kDamping / ((delay + 0.5) * kPeriod);
    const double measured = threshold(0.5 * formula, 1.5 * formula, kStep, [&](double stiffness) {
      return lean({plant, stiffness}).settles;
    });
    lecture.points.push_back(
        {1e3 * (delay + 0.5) * kPeriod, format("%d ms", delay), measured, formula, largestStableStiffness(plant)});
    if (delay <= 30) beyond_30 = std::max(beyond_30, std::abs(measured / formula - 1));
  }
  const auto& points = lecture.points;
  const Point &none = points.front(), &felt = points[6], &most = points.back();
  lecture.sentences = {
      format(
          "Without delay the wall may have %.0f N/m, after 10 ms %.0f N/m, after 30 ms %.1f N/m and after 100 ms %.1f "
          "N/m; b / ((n + 1/2) h) is %.0f, %.0f, %.1f and %.1f N/m.",
          none.measured, points[4].measured, felt.measured, most.measured, none.oracle, points[4].oracle, felt.oracle,
          most.oracle),
      format(
          "The limit is within %.2g %% of the eigenvalues of the sampled loop at all %zu delays, of %.2g %% allowed.",
          100 * lecture.largestOff(), points.size(), 100 * lecture.tolerance),
      format("b / ((n + 1/2) h) holds for delays that are short against m / b = %g s: it is within %.2g %% up to 30 ms "
             "and %.2g %% below the limit at 100 ms.",
             kMass / kDamping, 100 * beyond_30, 100 * (1 - most.oracle / most.measured))};
  return lecture;
}

}  // namespace presa::lectures
