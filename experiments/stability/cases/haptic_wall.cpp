#include <algorithm>
#include <cmath>

#include "experiments/stability/cases.h"
#include "experiments/stability/wall_loop.h"

namespace presa::stability::haptic_wall {
namespace {

constexpr double kRelease = 0.6;       // [s]: after the soft start of the output stage
constexpr double kRadius = 0.008;      // of the fingertip: contact begins this far before the wall [m]
constexpr double kDepth = 0.002;       // at rest [m]
constexpr double kDisturbance = 1e-4;  // [m]: contact persists while it grows by less than kDepth

struct Wall {
  WallPlant plant;
  double share = 1;   ///< of the max stable stiffness
  bool late = false;  ///< the force is one sample later than the analysed loop assumes
};

/// Time for a disturbance to grow or shrink by this factor, at most two minutes.
double observedTime(double radius, double period) {
  constexpr double kFactor = 8;
  return std::min(120.0, period * std::log(kFactor) / std::abs(std::log(radius)));
}

/// The limit of a delay that is short against m / b [Gil2009].
double shortDelayLimit(const WallPlant& plant) { return plant.damping / ((plant.delay + 0.5) * plant.period); }

/// Max |depth - rest| in a time interval.
double amplitude(const Curve& depth, double rest, double from, double to) {
  double largest = 0;
  for (std::size_t i = 0; i < depth.x.size(); ++i) {
    if (depth.x[i] >= from && depth.x[i] < to) largest = std::max(largest, std::abs(depth.y[i] - rest));
  }
  return largest;
}

std::vector<Finding> lean(const Wall& wall) {
  const double limit = largestStableStiffness(wall.plant), stiffness = wall.share * limit;
  const double radius = spectralRadius(wall.plant, stiffness);
  const double time = observedTime(radius, wall.plant.period);
  WallDevice::Setup setup{wall.plant, stiffness * kDepth, -kRadius + kDepth + kDisturbance, kRelease, {0, 0, 0.1}};
  if (wall.late) ++setup.plant.delay;
  DeviceList devices;
  devices.push_back(std::make_unique<WallDevice>(setup));
  char set[64];
  std::snprintf(set, sizeof set, "material/glass/stiffness=%.17g", stiffness);
  StudyRun run(specOf("haptic_wall.xml", {set, "rates/haptic=" + number(1 / wall.plant.period)}, kRelease + time),
               std::move(devices));
  Curve depth{"depth in the wall", {}, {}};
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.time < kRelease) return;
    depth.x.push_back(sample.tick.time - kRelease);
    depth.y.push_back(1000 * (sample.device.fingers[0].p_WH.x() + kRadius));
  });
  run.run();

  // a window of many periods at each end: the resonance is above 8 Hz in all trials
  const double window = std::min(0.25, time / 4);
  const double first = amplitude(depth, 1000 * kDepth, 0, window);
  const double last = amplitude(depth, 1000 * kDepth, time - window, time);
  const double rate = std::log(last / first) / (time - window), wanted = std::log(radius) / wall.plant.period;
  const bool decays = wall.share < 1;
  const double grown = last / (1000 * kDisturbance);
  Finding verdict =
      finding(decays ? "amplitude, end over start" : "amplitude, start over end", decays ? grown : 1 / grown, "", 1,
              "limit " + number(limit) + " N/m (b / ((n + 1/2) T) = " + number(shortDelayLimit(wall.plant)) +
                  " N/m): it " + (decays ? "settles" : "grows"));
  verdict.plot_x = "time [s]";
  verdict.plot_y = "depth of the fingertip [mm]";
  verdict.curves.push_back(decimated(std::move(depth)));
  return {verdict,
          finding("growth rate", 100 * (rate / wanted - 1), "% off", 5, number(wanted) + " 1/s by eigenvalues")};
}

}  // namespace

Case make() {
  Case result;
  result.name = "haptic_wall";
  result.title = "A finger leans on a wall at the stability limit of a sampled loop, with up to 100 ms of delay";
  result.source =
      "Stability of a sampled spring on a mass with damping [Colgate 1997, Gil 2009: about b / ((d + 1/2) T)]; "
      "the limit is computed exactly from the eigenvalues of the discrete loop.";
  result.oracle =
      "At 0.98 times the limit a disturbance dies away, at 1.02 times it grows, at the rate of the eigenvalues.";
  result.scene = "haptic_wall.xml";
  struct Device {
    double mass, damping, period;
  };
  for (const Device& device : {Device{0.1, 1, 0.001}, {0.05, 5, 0.001}, {0.3, 2, 0.001}, {0.1, 2, 0.00025}}) {
    for (const int delay : {0, 1, 2, 10, 30, 100}) {
      for (const double share : {0.98, 1.02}) {
        for (const bool late : {false, true}) {
          if (late && share > 1) continue;  // this loop grows without the extra delay
          const Wall wall{{device.mass, device.damping, device.period, delay}, share, late};
          Trial trial;
          trial.parameters = {{"mass", number(1000 * device.mass) + " g"},
                              {"damping", number(device.damping) + " N s/m"},
                              {"rate", number(0.001 / device.period) + " kHz"},
                              {"delay", std::to_string(delay)},
                              {"stiffness", number(share) + " x limit"}};
          trial.method = late ? "force one tick late" : kPresa;
          if (late) trial.expected = Verdict::kUnstable;
          trial.run = [=] { return lean(wall); };
          trial.quick = device.damping > 4;
          result.trials.push_back(std::move(trial));
        }
      }
    }
  }
  return result;
}

}  // namespace presa::stability::haptic_wall
