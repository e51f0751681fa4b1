#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/device/device.h"

namespace presa {

/// A fingertip, or the handle of a tool, that follows a function of time exactly, regardless of forces; for tests with an
/// analytic solution. `path` gives position [m] and velocity [m/s] in W at a simulated time [s], and for a tool its
/// orientation and angular velocity [rad/s].
class PrescribedFinger final : public Device {
 public:
  struct State {
    Vec3 p_WH = Vec3::Zero(), v_WH = Vec3::Zero();
    std::optional<Quat> q_WT{};  // none: the device measures no orientation
    Vec3 w_WT = Vec3::Zero();
  };
  using Path = std::function<State(double time)>;
  explicit PrescribedFinger(Path path) : path_(std::move(path)) {}

  FingerInput read(const Tick& tick) noexcept override {
    const State now = path_(tick.time);
    FingerInput input{now.p_WH, now.v_WH, -1, true};
    input.oriented = now.q_WT.has_value();
    input.q_WT = now.q_WT.value_or(Quat(Quat::Identity()));
    input.w_WT = now.w_WT;
    return input;
  }
  void write(const Wrench&, const Tick&) noexcept override {}

 private:
  Path path_;
};

}  // namespace presa
