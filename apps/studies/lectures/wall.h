#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/stability/wall_loop.h"
#include "experiments/study/prescribed_finger.h"

/// A finger at the wall of haptic_wall.xml: the wall is x > 0, a fingertip of kRadius touches it at x = -kRadius.
namespace presa::lectures {

inline constexpr double kRadius = 0.008;  // [m]
inline constexpr double kBegin = 0.6;     // experiments begin after the soft start of the output stage [s]

/// A finger on a prescribed path that tells the force which it holds, from each write to the next.
class HeldFinger final : public Device {
 public:
  /// `held`: called with the force held since `from` when it ends at `to` [s].
  using Held = std::function<void(const Vec3& force, double from, double to)>;
  HeldFinger(PrescribedFinger::Path path, Held held) : path_(std::move(path)), held_(std::move(held)) {}

  FingerInput read(const Tick& tick) noexcept override { return path_.read(tick); }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    if (since_ >= 0 && tick.time > since_) held_(force_, since_, tick.time);
    force_ = F_H_W.f;
    since_ = tick.time;
  }

 private:
  PrescribedFinger path_;
  Held held_;
  Vec3 force_ = Vec3::Zero();
  double since_ = -1;
};

/// A finger of mass and damping that leans on the wall and is disturbed a little.
struct Leaning {
  stability::WallPlant plant;
  double stiffness = 0;             ///< of the wall [N/m]
  double slide = 0;                 ///< prescribed speed along the wall [m/s]
  std::vector<std::string> sets{};  ///< in addition
};
struct Leant {
  bool settles = false;   ///< the disturbance is smaller in the last quarter of the run than in the first
  double tangential = 0;  ///< mean force against the slide in the last quarter [N]
};
/// One run of a minute.
Leant lean(const Leaning& leaning);

/// The value between `low` and `high` at which `below` turns from true to false, to the relative `step`.
double threshold(double low, double high, double step, const std::function<bool(double)>& below);
/// Step of a threshold of runs.
inline constexpr double kStep = 0.0005;

}  // namespace presa::lectures
