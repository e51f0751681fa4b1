#pragma once
#include <cstdint>
#include <memory>

#include "framework/core/schedule/executor.h"
#include "framework/device/device.h"
#include "framework/device/supervision/command_keeper.h"
#include "framework/device/supervision/share.h"

namespace presa {

/// How often memory was taken in this process so far.
using CountAllocations = std::uint64_t (*)();

/// One device, kept for a program in another process: passes samples to it and forces from it in every cycle, and takes the
/// force to zero when no more come.
/// Thread: one; cycle() neither allocates, locks nor throws.
class Supervisor {
 public:
  /// `device` is open. `rating`: of its driver, as this process knows it; what scene and rig say does not come here.
  Supervisor(SupervisorShare& share, std::unique_ptr<Device> device, const DeviceRating& rating,
             CountAllocations count);

  /// `alone`: the program is gone. `elapsed`: since the cycle before ended [s]. False: there is nothing left to do.
  bool cycle(bool alone, double elapsed) noexcept;
  void close() noexcept { device_->close(); }

  /// Zero force is sent for as long before the device is let go [s].
  static constexpr double kFarewell = 0.05;

 private:
  SupervisorShare& share_;
  RunControl control_;  // of the watched device, in tests
  std::unique_ptr<Device> device_;
  CommandKeeper keeper_;
  CountAllocations count_;
  std::uint64_t allocated_before_;
  SupervisorReport report_;
  double time_ = 0;      // since the start [s]
  double farewell_ = 0;  // zero for so long with nobody to command [s]
};

/// The process: opens what the share's task names, runs cycles until the program is gone or closes it. `share_fd`: the shared
/// memory; `life_fd`: reads end of file when the program has died. Returns the exit status.
int superviseDevice(int share_fd, int life_fd, CountAllocations count);

}  // namespace presa
