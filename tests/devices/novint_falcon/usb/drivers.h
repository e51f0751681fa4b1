#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/falcon_device.h"
#include "framework/session/realtime_rights.h"
#include "tests/devices/novint_falcon/usb/emulated_bus.h"

/// Drivers for the tests of the emulated bus.
namespace presa::falcon_model::test {

/// Synthetic; starts like the real firmware.
inline std::vector<std::uint8_t> firmware() {
  std::vector<std::uint8_t> bytes(700);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
  bytes[0] = 0xAA, bytes[1] = 0x08, bytes[2] = bytes[3] = 0;
  return bytes;
}

inline ModelSettings ready() {
  ModelSettings settings;
  settings.has_firmware = settings.homed = true;
  settings.loader.firmware = firmware();
  return settings;
}

inline falcon::FalconSettings settingsOf(const std::string& serial) {
  falcon::FalconSettings settings;
  settings.role = "thumb";
  settings.serial = serial;
  settings.firmware = firmware();
  settings.where = {"desk.xml", 3, 1};
  settings.realtime = true;
  return settings;
}

inline falcon::FalconDevice driverOf(const std::string& serial) {
  return {settingsOf(serial), [serial] { return falcon::connectOverUsb(serial, {"desk.xml", 3, 1}); }};
}

/// Number of late samples that excuses a missing force. Late replies take the force away, and after a long gap it
/// returns softly, within half a second; without SCHED_FIFO or under a sanitizer this may happen repeatedly while a
/// test waits for a force.
constexpr int kManyLate = 20;
inline std::string whyLate() {
#ifdef PRESA_SANITIZE
  return "a sanitizer slows all of it down";
#else
  const std::string refused = realtimeRights().fifo;
  return refused.empty() ? "" : "SCHED_FIFO: " + refused;
#endif
}

/// Opens the device; false: its replies were irregular because of a slow machine.
inline bool opensInTime(falcon::FalconDevice& driver) try {
  driver.open();
  return true;
} catch (const InputError& error) {
  if (error.diagnostics().all().at(0).code != falcon::kUnevenReplies || whyLate().empty()) throw;
  return false;
}

}  // namespace presa::falcon_model::test

/// Continues when a force was reached; skips the test when `late` samples explain its absence; fails otherwise.
#define REACHED_OR_LATE(reached, late)                                       \
  if (!(reached)) {                                                          \
    if ((late) < kManyLate || whyLate().empty())                             \
      FAIL() << "no force was felt, and " << (late) << " samples were late"; \
    GTEST_SKIP() << (late) << " samples were late; " << whyLate();           \
  }

/// Continues when the device was opened (by opensInTime, or here).
#define SKIP_UNLESS_OPENED(opened) \
  if (!(opened)) GTEST_SKIP() << "its replies leave gaps; " << whyLate();
#define OPENED_OR_LATE(driver) SKIP_UNLESS_OPENED(opensInTime(driver))
