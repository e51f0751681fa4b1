#pragma once
#include <array>
#include <functional>
#include <limits>
#include <memory>

#include "experiments/faults/fault.h"
#include "experiments/study/compliant_finger.h"
#include "experiments/study/study_run.h"
#include "framework/device/wrapped_device.h"

namespace presa::faults {

/// A wrapper that makes a device fail.
class FailingDevice final : public WrappedDevice {
 public:
  /// Modifies the sample that is due at `time` [s].
  using Failure = std::function<void(double time, FingerInput& sample)>;
  FailingDevice(std::unique_ptr<Device> device, Failure failure)
      : WrappedDevice(std::move(device)), failure_(std::move(failure)) {}
  FingerInput read(const Tick& tick) noexcept override {
    FingerInput sample = inner().read(tick);
    if (failure_) failure_(tick.time, sample);
    return sample;
  }

 private:
  Failure failure_;
};

inline constexpr double kHoldLimit = 8;  ///< force limit of faults/hold.xml [N]

/// The hold scenario: thumb and index close on a cube, lift it and hold it while the fault occurs.
struct Hold {
  std::string scene = "faults/hold.xml";                   ///< file below experiments, or an absolute path
  std::vector<std::string> sets{};                         ///< PATH=VALUE
  double force_share = 1;                                  ///< scale of the force limits
  double end = 3;                                          ///< [s]
  double closed = 0.9;                                     ///< the fingers press from this time on [s]
  double deep = 0;                                         ///< initial penetration of the fingers [m]
  FailingDevice::Failure thumb;                            ///< failure of the thumb's device
  std::function<bool(RateGroup, double)> held_up;          ///< stalled groups, asked before each tick
  double rearm = std::numeric_limits<double>::infinity();  ///< time of the re-arm [s]
  StudyRun::MakeModule more;                               ///< an additional module
};

/// Forces and energies at the devices in one tick, index 0 thumb, 1 index.
struct Traffic {
  std::array<Vec3, 2> force{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> energy{};
  double step = 0;
  double slew_energy = 0;  ///< K/2 dx^2 of this tick: the energy that sampling a spring may add [J]
};

using AtTick = std::function<void(double time, const Traffic& traffic)>;

using AfterRun = std::function<void(StudyRun& run)>;

/// Runs the scenario; `at_tick` is called after every haptic tick, `after` at the end of the run. Throws InputError for
/// an unusable scene.
void runHold(const Hold& hold, const AtTick& at_tick, const AfterRun& after = {});

/// Replacement devices for the fingers: `fingers` write to `transports`; `clock` is the world time [s]. Both must
/// outlive the fingers.
struct HoldDevices {
  DeviceList fingers;
  std::array<Transport, 2>& transports;
  double& clock;
};
void runHold(const Hold& hold, HoldDevices devices, const AtTick& at_tick, const AfterRun& after = {});

/// Target of the hand behind a finger; `side`: -1 thumb, 1 index.
PrescribedFinger::State handAt(const Hold& hold, const HandImpedance& hand, double side, double time);

/// Requirement on every written force: finite and within the limit [N].
void requireBounded(const Traffic& traffic, double limit, Outcome& outcome);

/// Standard judge: time to the first reduced force, time to zero force, force steps, energy.
class Judge {
 public:
  /// `begin`: time of the fault; `until`: its end, infinity when it persists [s]. `fingers`: bit set of the fingers
  /// that must go to zero.
  Judge(double begin, double until, unsigned fingers = 3) : begin_(begin), until_(until), fingers_(fingers) {}
  void see(double time, const Traffic& traffic);
  Outcome outcome() const;

 private:
  double force(const Traffic& traffic) const;
  double begin_, until_;
  unsigned fingers_;
  double before_ = 0, energy_before_ = 0;
  double answered_ = -1, last_force_ = -1;
  Outcome outcome_;
};

}  // namespace presa::faults
