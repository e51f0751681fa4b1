#pragma once
#include <cstdint>

#include "devices/percro_arm/calibration/linked_bases.h"
#include "framework/plugin/plugin_loader.h"

namespace presa {

/// The functions that a driver provides for `presa device calibrate`.
struct CalibrationPlugin {
  int abi = kPluginAbi;
  /// Centre of the link in the frame of the base, from the reported position; `link`: distance from the tip to the
  /// centre [m].
  Vec3 (*centre)(const Vec3& p_DH, double link) = nullptr;
  /// Model only: two devices are homed, linked, and led along a path chosen by `seed`; X_WA is base A in the world,
  /// X_AB base B in A. Empty when the devices cannot reach the path. Null: the driver has no model.
  std::vector<LinkedSample> (*rehearse)(const Pose& X_WA, const Pose& X_AB, double link, std::uint64_t seed) = nullptr;
};
inline constexpr const char* kCalibrationSymbol = "presaDeviceCalibration";

}  // namespace presa

#define PRESA_DEVICE_CALIBRATION(table)                                                                        \
  extern "C" __attribute__((visibility("default"))) const presa::CalibrationPlugin* presaDeviceCalibration() { \
    return &(table);                                                                                           \
  }
