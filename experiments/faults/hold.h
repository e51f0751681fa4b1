#pragma once
#include <array>
#include <functional>
#include <limits>
#include <memory>

#include "experiments/faults/fault.h"
#include "framework/device/wrapped_device.h"
#include "experiments/study/study_run.h"
#include "experiments/study/yielding_finger.h"

namespace presa::faults {

/// A finger whose device may be made to fail.
class FailingDevice final : public WrappedDevice {
 public:
  /// Changes the sample that is due at that time [s] before anybody sees it.
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

/// What a run holds while the fault comes: thumb and index close on a cube, lift it and hold it.
struct Hold {
  std::string scene = "faults/hold.xml";                   ///< below experiments, or a path of its own
  std::vector<std::string> sets{};                         ///< PATH=VALUE
  double force_share = 1;                                  ///< of the limits
  double end = 3;                                          ///< [s]
  double closed = 0.9;                                     ///< fingers press from then on [s]
  double deep = 0;                                         ///< fingers start this deep in the object [m]
  FailingDevice::Failure thumb;                            ///< on the thumb's device
  std::function<bool(RateGroup, double)> held_up;          ///< groups that do not run
  double rearm = std::numeric_limits<double>::infinity();  ///< [s]
  StudyRun::MakeModule more;                               ///< a module that runs with it
};

/// What passed at the devices, tick by tick.
struct Traffic {
  std::array<Vec3, 2> force{Vec3::Zero(), Vec3::Zero()};
  std::array<double, 2> energy{};
  double step = 0;
  double slew_energy = 0;  ///< K/2 dx^2 of this tick: what sampling a spring may add [J]
};

using AtTick = std::function<void(double time, const Traffic& traffic)>;

using AfterRun = std::function<void(StudyRun& run)>;

/// Runs it; `at_tick` sees the traffic after every haptic tick, `after` the run when it is over. Throws InputError for a scene that
/// cannot be used.
void runHold(const Hold& hold, const AtTick& at_tick, const AfterRun& after = {});

/// What carries the fingers in its place: `fingers` fill in their `transports`; `clock` is the time in the world. Both outlive
/// the fingers.
struct HoldDevices {
  DeviceList fingers;
  std::array<Transport, 2>& transports;
  double& clock;
};
void runHold(const Hold& hold, HoldDevices devices, const AtTick& at_tick, const AfterRun& after = {});

/// Where the hand of a finger goes; `side`: -1 thumb, 1 index.
PrescribedFinger::State handAt(const Hold& hold, const HandImpedance& hand, double side, double time);

/// What must hold of every force that is written, whatever fails: finite, at most the limit.
void requireBounded(const Traffic& traffic, double limit, Outcome& outcome);

/// Judges the usual: when the forces answered, when they were zero and stayed so until `until`, the steps, the energy.
class Judge {
 public:
  /// `begin`: of the fault; `until`: of its end, infinity when it stays [s]. `fingers`: bits of those that have to go to zero.
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
