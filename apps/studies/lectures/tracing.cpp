#include <algorithm>
#include <cmath>

#include "apps/common/terminal/text.h"
#include "apps/studies/lectures/lecture.h"
#include "apps/studies/lectures/rates.h"
#include "apps/studies/lectures/wall.h"

namespace presa::lectures {

Lecture tracing() {
  using terminal::format;
  constexpr double kHard = 10000, kViscosity = 1000;  // as printed [N/m, N s/m]
  constexpr double kHand = 2;                         // mass, large against b h: 2 g to 180 g [kg]
  constexpr double kSlide = 0.002;                    // [m/s]
  Lecture lecture;
  lecture.name = "tracing";
  lecture.title = "Tracing: a hard, viscous plane";
  lecture.description =
      "A hand of 2 kg draws a pen at 2 mm/s along a plane of 10 000 N/m with a viscosity of 1000 N/(m/s) and leans on "
      "it: which damping of the hand keeps it from being shaken? Bisection, one run of a minute for each step.";
  lecture.knob = "haptic rate";
  lecture.x_label = "haptic period h [ms]";
  lecture.y_label = "smallest damping b that is stable [N s/m]";
  lecture.oracle = "b = K h / 2";
  lecture.exact = "eigenvalues of the sampled loop";
  lecture.tolerance = 0.005;  // against the eigenvalues: ten times the step of the bisection
  std::vector<double> drag;   // at each rate [N]
  for (const double rate : kLectureRates) {
    const double formula = kHard / rate / 2;
    Leaning leaning{{kHand, 0, 1 / rate, 0}, kHard, kSlide, ratesOf(rate)};
    leaning.sets.emplace_back("material/glass/friction/dynamic=0");
    leaning.sets.push_back("material/glass/friction/viscous/damping=" + stability::number(kViscosity));
    const double measured = threshold(0.5 * formula, 1.5 * formula, kStep, [&](double damping) {
      leaning.plant.damping = damping;
      return !lean(leaning).settles;
    });
    const double exact = threshold(0.5 * formula, 1.5 * formula, 1e-9, [&](double damping) {
      return stability::spectralRadius({kHand, damping, 1 / rate, 0}, kHard) >= 1;
    });
    lecture.points.push_back({1000 / rate, format("%g Hz", rate), measured, formula, exact});
    leaning.plant.damping = 1.2 * formula;
    drag.push_back(lean(leaning).tangential);
  }
  const auto& points = lecture.points;
  const auto drags = std::minmax_element(drag.begin(), drag.end());
  double beyond = 0;
  for (const Point& point : points) beyond = std::max(beyond, std::abs(point.measured / point.oracle - 1));
  lecture.sentences = {
      format("The plane of 10 000 N/m is stable from a damping of %.2f, %.2f, %.2f and %.2f N s/m on at 1000, 500, 250 "
             "and 167 Hz; K h / 2 is %.2f, %.2f, %.2f and %.2f N s/m.",
             points[0].measured, points[1].measured, points[2].measured, points[3].measured, points[0].oracle,
             points[1].oracle, points[2].oracle, points[3].oracle),
      format("The limit is within %.2g %% of the eigenvalues of the sampled loop and within %.2g %% of K h / 2, which "
             "holds for a mass that is large against b h.",
             100 * lecture.largestOff(), 100 * beyond),
      format("The viscosity draws with %.3f to %.3f N at 2 mm/s, where B v is %.3f N; held over a tick, as printed, it "
             "would need a mass above B h / 2 = %.2g, %.2g, %.2g and %.2g kg.",
             *drags.first, *drags.second, kViscosity * kSlide, kViscosity * 0.0005 * points[0].x,
             kViscosity * 0.0005 * points[1].x, kViscosity * 0.0005 * points[2].x, kViscosity * 0.0005 * points[3].x)};
  return lecture;
}

}  // namespace presa::lectures
