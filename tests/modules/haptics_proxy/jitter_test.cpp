// The lectures' "jitter": what a hand gains when it goes into a wall and out again, because the force is held between ticks.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "framework/core/math/random.h"
#include "tests/support/rendered_body.h"

namespace presa::jitter {
namespace {

constexpr double kStiffness = 1000, kDeep = 0.002, kSpeed = 0.05, kTop = 0.058;  // [N/m], [m], [m/s], [m]
constexpr int kVisits = 400;

struct Gained {
  double mean = 0;      ///< energy of a visit [J]
  double expected = 0;  ///< k D v mean(h^2) / mean(h) [J]
};

/// The hand goes in and out at a constant speed, visit after visit; `period` gives the time to the next tick [s].
Gained visits(const std::function<double()>& period) {
  test::RenderedBody box("", "<box size=\"0.1 0.1 0.1\"/>");
  const double way = kDeep + 0.002, lap = 2 * way / kSpeed;  // 2 mm above the wall to D below it
  const auto heightAt = [&](double time) {
    const double along = kSpeed * std::fmod(time, lap);
    return kTop + 0.002 - (along < way ? along : 2 * way - along);
  };
  double energy = 0, held = 0, time = 0, last = heightAt(0), sum = 0, squares = 0;
  constexpr int kFine = 64;  // the path turns within a tick
  while (time < kVisits * lap) {
    const double h = period();
    sum += h;
    squares += h * h;
    for (int i = 1; i <= kFine; ++i) {
      const double next = heightAt(time + h * i / kFine);
      energy += held * (next - last);
      last = next;
    }
    time += h;
    held = box.force({0, 0, heightAt(time)}).z();
  }
  return {energy / kVisits, kStiffness * kDeep * kSpeed * squares / sum};
}

// Leading order in v h / D, here at most 0.075; begin and turn fall anywhere in a tick, so that its first power averages
// out over the visits and the second stays.
TEST(Jitter, ALateTickGivesEnergyByTheSquareOfItsLength) {
  RandomStream random(1, "jitter", 0);
  const Gained regular = visits([] { return 0.97e-3; });
  EXPECT_NEAR(regular.mean / regular.expected, 1, 0.03);
  const Gained irregular = visits([&] { return random.uniform() < 0.1 ? 5e-3 : 0.5e-3; });
  EXPECT_NEAR(irregular.mean / irregular.expected, 1, 0.05);
  EXPECT_NEAR(irregular.expected / regular.expected, (0.9 * 0.25 + 0.1 * 25) / (0.9 * 0.5 + 0.1 * 5) / 0.97, 0.1);
}

}  // namespace
}  // namespace presa::jitter
