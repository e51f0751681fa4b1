#include <cmath>

#include "apps/common/terminal/text.h"
#include "apps/studies/lectures/lecture.h"
#include "apps/studies/lectures/wall.h"
#include "experiments/stability/case.h"
#include "framework/core/math/random.h"

namespace presa::lectures {
namespace {

constexpr double kSpring = 1000, kDeep = 0.002, kSpeed = 0.05;  // [N/m], [m], [m/s]
constexpr double kBefore = 0.002017;  // turning point before the wall [m]: a visit is no whole number of periods
constexpr int kVisits = 400;
constexpr double kGrid = 10000;          // haptic ticks fall on this grid [Hz]
constexpr int kOnTime = 10, kLate = 50;  // periods on the grid: 1 ms, 5 ms

struct Gained {
  double visit = 0;                        ///< mean energy given to the hand in a visit [J]
  double count = 0;                        ///< of the periods
  double sum = 0, squares = 0, cubes = 0;  ///< of the periods [s, s^2, s^3]
};

/// The hand goes in and out at a constant speed; one tick in 1 / `share` comes late, at random.
Gained goInAndOut(double share) {
  const double way = kDeep + kBefore, lap = 2 * way / kSpeed, end = kBegin + kVisits * lap;
  const auto placeAt = [=](double time) {
    const double along = kSpeed * std::fmod(std::max(0.0, time - kBegin), lap);
    return -kRadius - kBefore + (along < way ? along : 2 * way - along);
  };
  Gained gained;
  DeviceList devices;
  devices.push_back(std::make_unique<HeldFinger>(
      [=](double time) {
        return PrescribedFinger::State{Vec3(placeAt(time), 0, 0.1), Vec3::Zero()};
      },
      [&](const Vec3& force, double from, double to) {
        // exact for a held force, wherever the hand turns meanwhile
        gained.visit += force.x() * (placeAt(to) - placeAt(from)) / kVisits;
        ++gained.count;
        gained.sum += to - from;
        gained.squares += (to - from) * (to - from);
        gained.cubes += (to - from) * (to - from) * (to - from);
      }));
  StudyRun run(
      stability::specOf(
          "haptic_wall.xml",
          {"rates/haptic=" + stability::number(kGrid), "material/glass/stiffness=" + stability::number(kSpring)}, end),
      std::move(devices));
  RandomStream random(1, "jitter");
  run.delay([&random, share, waited = 0, period = 1](RateGroup group, double) mutable {
    if (group != RateGroup::kHaptic) return false;
    if (++waited < period) return true;
    waited = 0;
    period = random.uniform() < share ? kLate : kOnTime;
    return false;
  });
  run.run();
  return gained;
}

}  // namespace

Lecture jitter() {
  using terminal::format;
  Lecture lecture;
  lecture.name = "jitter";
  lecture.title = "Jitter: what late ticks give to the hand";
  lecture.description =
      "A hand goes 2 mm into a wall of 1000 N/m and out again at 50 mm/s, 400 times. The haptic tick comes after 1 ms, "
      "or, in a share of the ticks drawn at random, after 5 ms. Because the force is held meanwhile, the wall gives "
      "the hand energy.";
  lecture.knob = "late ticks";
  lecture.x_label = "mean(h²) / mean(h) [ms]";
  lecture.y_label = "energy given to the hand in a visit [mJ]";
  lecture.oracle = "k D v mean(h²) / mean(h)";
  // a force that is late by tau gives k v (2 D tau - v tau^2); tau is anything from 0 to h
  lecture.exact = "the same less k v² mean(h³) / (3 mean(h))";
  // the periods within the wall are a sample of all: with one tick in 50 late, standard deviation 1.4 %
  lecture.tolerance = 0.03;
  std::vector<double> mean;  // of the periods [ms]
  for (const double share : {0.0, 0.02, 0.05, 0.1, 0.2, 0.4}) {
    const Gained gained = goInAndOut(share);
    const double period = gained.squares / gained.sum;
    mean.push_back(1e3 * gained.sum / gained.count);
    const double first = kSpring * kDeep * kSpeed * period;
    const double second = kSpring * kSpeed * kSpeed * gained.cubes / (3 * gained.sum);
    lecture.points.push_back(
        {1e3 * period, format("%g %%", 100 * share), 1e3 * gained.visit, 1e3 * first, 1e3 * (first - second)});
  }
  const Point &regular = lecture.points.front(), &few = lecture.points[3], &many = lecture.points.back();
  lecture.sentences = {
      format("With every tick after 1 ms a visit gives the hand %.4f mJ; k D v h is %.4f mJ.", regular.measured,
             regular.oracle),
      format("With %s of the ticks after 5 ms it gives %.4f mJ, %.2f times as much, though the mean period is only "
             "%.2f times as long; k D v mean(h²) / mean(h) is %.4f mJ.",
             few.knob.c_str(), few.measured, few.measured / regular.measured, mean[3] / mean[0], few.oracle),
      format("The closed form is the first term in v h / D and too large by %.2g to %.2g %%; with the next term, "
             "k v² mean(h³) / (3 mean(h)), the energy is within %.2g %% of it, of %.2g %% allowed.",
             100 * (regular.oracle / regular.measured - 1), 100 * (many.oracle / many.measured - 1),
             100 * lecture.largestOff(), 100 * lecture.tolerance)};
  return lecture;
}

}  // namespace presa::lectures
