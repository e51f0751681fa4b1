#pragma once
#include <cstdint>

#include "devices/percro_arm/calibration/linked_bases.h"
#include "framework/core/plugin/plugin_loader.h"

namespace presa {

/// What a driver lends to `presa device calibrate`.
struct CalibrationPlugin {
  int abi = kPluginAbi;
  /// Centre of the link in the base's frame, from the position that the device reports there; `link`: how far beyond it [m].
  Vec3 (*centre)(const Vec3& p_DH, double link) = nullptr;
  /// Model: two devices homed, linked, and led along a path that `seed` names; base A in the world, B seen from A. Empty when they
  /// cannot meet along it. Null: the driver has no model.
  std::vector<LinkedSample> (*rehearse)(const Pose& X_WA, const Pose& X_AB, double link, std::uint64_t seed) = nullptr;
};
inline constexpr const char* kCalibrationSymbol = "presaDeviceCalibration";

}  // namespace presa

#define PRESA_DEVICE_CALIBRATION(table)                                                                        \
  extern "C" __attribute__((visibility("default"))) const presa::CalibrationPlugin* presaDeviceCalibration() { \
    return &(table);                                                                                           \
  }
