#pragma once
#include <functional>
#include <string>
#include <vector>

#include "framework/device/device.h"

namespace presa {

/// A fingertip that follows a function of time exactly, regardless of forces; for tests with an analytic solution.
/// `path` gives position [m] and velocity [m/s] in W at a simulated time [s].
class PrescribedFinger final : public Device {
 public:
  struct State {
    Vec3 p_WH = Vec3::Zero(), v_WH = Vec3::Zero();
  };
  using Path = std::function<State(double time)>;
  explicit PrescribedFinger(Path path) : path_(std::move(path)) {}

  FingerInput read(const Tick& tick) noexcept override {
    const State now = path_(tick.time);
    return {now.p_WH, now.v_WH, -1, true};
  }
  void write(const Wrench&, const Tick&) noexcept override {}

 private:
  Path path_;
};

}  // namespace presa
