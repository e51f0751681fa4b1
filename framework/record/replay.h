#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/device/device.h"
#include "framework/device/device_modules.h"
#include "framework/plan/session.h"
#include "framework/record/recording.h"

namespace presa {

/// A finger of a recording: gives the recorded samples, ignores forces.
class RecordedFinger final : public Device {
 public:
  RecordedFinger(const Recording& recording, std::size_t finger) : recording_(recording), finger_(finger) {}
  FingerInput read(const Tick&) noexcept override { return recording_.device[row_++].fingers[finger_]; }
  void write(const Vec3&, const Tick&) noexcept override {}

 private:
  const Recording& recording_;
  std::size_t finger_;
  std::size_t row_ = 0;
};

/// One device per recorded finger, for Session::Options::devices.
DeviceList recordedDevices(const Recording& recording);

/// What changed the surfaces in the recorded run does so again, for Session::Options::more; null where nothing did.
std::unique_ptr<Module> recordedSurfaces(const Recording& recording);

/// What commands set in the recorded run is set again, for Session::Options::more; null where nothing was. The world has to have
/// RunOptions::bus_commands then.
std::unique_ptr<Module> recordedCommands(const Recording& recording);

/// Result of running a recording again.
struct ReplayResult {
  std::uint64_t ticks = 0;        ///< haptic ticks replayed
  std::uint64_t differing = 0;    ///< of these, with a commanded force that is not the same to the bit
  double first_difference = -1;   ///< time of the first [s]
  double largest_difference = 0;  ///< [N]
  std::string problem;            ///< why the replay could not go to the end; empty when it did
};

/// Runs every recorded tick of every rate group again on this thread, each reading exactly the versions that it
/// read then, and compares the commanded forces bit by bit. `session` was built with recordedDevices().
ReplayResult replay(const Recording& recording, Session& session, const RateTable& rates, RunControl& control);

}  // namespace presa
