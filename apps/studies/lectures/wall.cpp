#include "apps/studies/lectures/wall.h"

#include <algorithm>
#include <cmath>

#include "experiments/stability/case.h"

namespace presa::lectures {
namespace {

/// A finger that is free along x and moves along y at a prescribed speed.
class SlidingDevice final : public Device {
 public:
  SlidingDevice(const stability::WallDevice::Setup& setup, double speed) : free_(setup), speed_(speed) {}
  FingerInput read(const Tick& tick) noexcept override {
    FingerInput input = free_.read(tick);
    const double moved = std::max(0.0, tick.time - kBegin);
    input.p_WH.y() += speed_ * moved;
    if (moved > 0) input.v_WH.y() += speed_;
    return input;
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override { free_.write(F_H_W, tick); }

 private:
  stability::WallDevice free_;
  double speed_;
};

}  // namespace

Leant lean(const Leaning& leaning) {
  constexpr double kDepth = 0.002;       // at rest [m]
  constexpr double kDisturbance = 1e-4;  // [m]: contact lasts until it has grown to kDepth
  constexpr double kTime = 60;           // [s]
  const double stiffness = leaning.stiffness;
  const stability::WallDevice::Setup setup{leaning.plant,
                                           stiffness * kDepth,
                                           -kRadius + kDepth + kDisturbance,
                                           kBegin,
                                           {0, -leaning.slide * kTime / 2, 0.1}};
  DeviceList devices;
  devices.push_back(std::make_unique<SlidingDevice>(setup, leaning.slide));
  std::vector<std::string> sets = leaning.sets;
  sets.push_back("material/glass/stiffness=" + stability::number(stiffness));
  StudyRun run(stability::specOf("haptic_wall.xml", std::move(sets), kBegin + kTime), std::move(devices));
  double first = 0, last = 0, force = 0, ticks = 0;
  run.observe([&](const HapticSample& sample) {
    const double time = sample.tick.time - kBegin;
    const double away = std::abs(sample.device.fingers[0].p_WH.x() + kRadius - kDepth);
    if (time > 0 && time < kTime / 4) first = std::max(first, away);
    if (time < 0.75 * kTime) return;
    last = std::max(last, away);
    force -= sample.command.f_H_W[0].y();
    ++ticks;
  });
  run.run();
  return {last < first && last < 2 * kDisturbance, force / ticks};
}

double threshold(double low, double high, double step, const std::function<bool(double)>& below) {
  while (high - low > step * high) {
    const double middle = (low + high) / 2;
    (below(middle) ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace presa::lectures
