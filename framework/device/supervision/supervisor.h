#pragma once
#include <cstdint>
#include <memory>

#include "framework/core/schedule/executor.h"
#include "framework/device/device.h"
#include "framework/device/supervision/command_keeper.h"
#include "framework/device/supervision/share.h"

namespace presa {

/// Returns the number of allocations in this process so far.
using CountAllocations = std::uint64_t (*)();

/// Holds one device for a program in another process. In every cycle it passes the sample to the program and the
/// program's force to the device; when commands stop, it takes the force to zero.
/// Thread: one; cycle() neither allocates, locks nor throws.
class Supervisor {
 public:
  /// `device` is open. `rating`: the driver's, loaded by this process; the limits of scene and rig do not reach it.
  Supervisor(SupervisorShare& share, std::unique_ptr<Device> device, const DeviceRating& rating,
             CountAllocations count);

  /// `alone`: the program is gone. `elapsed`: since the end of the last cycle [s]. False: the device may be closed.
  bool cycle(bool alone, double elapsed) noexcept;
  void close() noexcept { device_->close(); }  ///< closes the device; after cycle() has returned false

  /// Zero force is sent for this long before the device is closed [s].
  static constexpr double kZeroForceTime = 0.05;

 private:
  SupervisorShare& share_;
  std::unique_ptr<Device> device_;
  CommandKeeper keeper_;
  CountAllocations count_;
  std::uint64_t allocated_before_;
  SupervisorReport report_;
  double time_ = 0;             // since the start [s]
  double zero_force_time_ = 0;  // time at zero force since the program left [s]
};

/// Main function of the process: opens the device of the share's task and runs cycles until the program dies or closes
/// the device. `share_fd`: the shared memory; `life_fd`: a pipe that reads end of file when the program has died.
/// Returns the exit status: 0, or 2 when the device does not open.
int superviseDevice(int share_fd, int life_fd, CountAllocations count);

}  // namespace presa
