#include "devices/novint_falcon/settings.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "devices/novint_falcon/codes.h"
#include "devices/novint_falcon/diagnose.h"
#include "devices/novint_falcon/firmware.h"
#include "framework/device/device_plugin.h"
#include "framework/scene/load.h"
#include "framework/session/session.h"

namespace presa::falcon {
namespace {

std::vector<int> codesOf(const Diagnostics& diagnostics) {
  std::vector<int> codes;
  for (const Diagnostic& found : diagnostics.all()) codes.push_back(found.code);
  return codes;
}

Rig rigWith(const std::string& settings) {
  Diagnostics findings;
  Rig rig = parseRig("<rig version=\"1.0\" name=\"desk\">\n<device role=\"thumb\" driver=\"novint_falcon\">" +
                         settings + "</device></rig>",
                     "desk.xml", "/lab/rigs", findings);
  EXPECT_TRUE(findings.all().empty()) << findings.text();
  return rig;
}

FalconSettings settingsOf(const std::string& xml, Diagnostics& diagnostics) {
  return readSettings(rigWith(xml).devices.at(0), {.realtime = true}, diagnostics);
}

std::string set(const std::string& key, const std::string& value) {
  return "<set key=\"" + key + "\" value=\"" + value + "\"/>";
}

TEST(FalconSettings, AllOfThem) {
  Diagnostics diagnostics;
  const FalconSettings settings =
      settingsOf(set("serial", "A7") + set("pos", "0.1 0.2 -0.3") + set("quat", "2 0 0 2") + set("scale", "1.5") +
                     set("counts_per_torque", "9000") + set("max_speed", "2") + set("homing_wait", "4"),
                 diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  EXPECT_EQ(settings.serial, "A7");
  EXPECT_EQ(settings.X_WD.p, Vec3(0.1, 0.2, -0.3));
  EXPECT_NEAR((settings.X_WD.q * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 1e-12);
  EXPECT_EQ(settings.scale, 1.5);
  EXPECT_EQ(settings.link.counts_per_torque, 9000);
  EXPECT_EQ(settings.link.max_speed, 2);
  EXPECT_EQ(settings.homing_wait, 4);
  EXPECT_EQ(settings.link.rating.force_rate, 1000);  // the driver's own, whatever the scene says
  EXPECT_EQ(settings.link.rating.force, 8);
  EXPECT_TRUE(settings.realtime);
  EXPECT_TRUE(settings.firmware.empty());
}

TEST(FalconSettings, EverythingWrongIsSaidAtOnce) {
  Diagnostics diagnostics;
  settingsOf(set("pos", "0.1 0.2") + set("quat", "0 0 0 0") + set("scale", "-1") + set("counts_per_torque", "nan") +
                 set("max_speed", "fast") + set("homing_wait", "0"),
             diagnostics);
  EXPECT_EQ(diagnostics.errorCount(), 6U) << diagnostics.text();
  for (const Diagnostic& found : diagnostics.all()) EXPECT_EQ(found.where.line, 2);
}

// A larger motor constant would give forces above the rating; a larger max speed would disable the check of samples.
TEST(FalconSettings, ARigWidensNothing) {
  Diagnostics diagnostics;
  settingsOf(set("counts_per_torque", "12501") + set("max_speed", "3.01"), diagnostics);
  EXPECT_EQ(diagnostics.errorCount(), 2U) << diagnostics.text();
  EXPECT_NE(diagnostics.text().find("counts_per_torque must be a number above 0, at most 12500, found '12501'"),
            std::string::npos)
      << diagnostics.text();
}

// The path is relative to the rig file, as for motions.
TEST(FalconSettings, FirmwareIsAPathFromTheRig) {
  EXPECT_EQ(rigWith(set("firmware", "../falcon.bin")).devices[0].settings.at("firmware").value, "/lab/falcon.bin");
}

std::vector<int> findingsOfFirmware(const std::string& bytes, std::vector<std::uint8_t>* read = nullptr) {
  const auto file = std::filesystem::path(testing::TempDir()) / "presa_falcon_firmware.bin";
  std::ofstream(file, std::ios::binary) << bytes;
  Diagnostics diagnostics;
  const auto firmware = readFirmware(file.string(), {"desk.xml", 2, 5}, diagnostics);
  EXPECT_EQ(firmware.empty(), diagnostics.hasErrors());
  if (read != nullptr) *read = firmware;
  std::filesystem::remove(file);
  return codesOf(diagnostics);
}

TEST(FalconFirmware, WhatCannotBeFirmwareIsRefused) {
  EXPECT_EQ(findingsOfFirmware(""), (std::vector<int>{kFirmwareEmpty}));
  EXPECT_EQ(findingsOfFirmware("\xAA"), (std::vector<int>{kFirmwareForeign}));
  EXPECT_EQ(findingsOfFirmware("\x7F"
                               "ELF"),
            (std::vector<int>{kFirmwareForeign}));
  EXPECT_EQ(findingsOfFirmware("\xAA\x08" + std::string(65535, 'x')), (std::vector<int>{kFirmwareTooLarge}));
  for (const char* file : {"/nowhere/falcon.bin", "/"}) {
    Diagnostics diagnostics;
    EXPECT_TRUE(readFirmware(file, {}, diagnostics).empty());
    EXPECT_EQ(codesOf(diagnostics), (std::vector<int>{kFirmwareUnreadable})) << diagnostics.text();
  }
}

// The checksum is that of `printf '\xaa\x08\x00\x00' | sha256sum`.
TEST(FalconFirmware, AnUnknownFileIsLoadedWithAWarning) {
  std::vector<std::uint8_t> read;
  EXPECT_EQ(findingsOfFirmware(std::string("\xAA\x08\0\0", 4), &read), (std::vector<int>{kFirmwareUnknown}));
  EXPECT_EQ(read, (std::vector<std::uint8_t>{0xAA, 0x08, 0x00, 0x00}));
  EXPECT_EQ(findingsOfFirmware("\xAA\x08" + std::string(65534, 'x')), (std::vector<int>{kFirmwareUnknown}));
}

// Through the plug-in's table, as the program calls it: each finding has a text, whatever is plugged into this
// computer.
TEST(FalconDiagnose, EveryProblemComesWithItsRemedy) {
  DeviceBinding binding;
  binding.driver = "novint_falcon";
  binding.settings["firmware"] = {"nowhere.bin", {"desk.xml", 2, 5}};
  const auto findings = devicePlugin("novint_falcon").diagnose(binding);
  ASSERT_GE(findings.size(), 2U);
  EXPECT_EQ(findings[0].code, kFirmwareUnreadable);
  for (const DeviceFinding& finding : findings) {
    EXPECT_FALSE(finding.message.empty());
    if (finding.verdict == DeviceFinding::Verdict::kProblem) {
      EXPECT_FALSE(finding.help.empty()) << finding.message;
    }
  }
}

TEST(FalconDiagnose, ADriverWithoutHardwareIsNotAsked) {
  EXPECT_EQ(devicePlugin("scripted").diagnose, nullptr);
  EXPECT_EQ(devicePlugin("scripted").udev_rule, nullptr);
  EXPECT_STREQ(devicePlugin("novint_falcon").udev_rule,
               R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0664", GROUP="plugdev")");
}

TEST(FalconPlugin, MakesADeviceFromARig) {
  auto world = std::make_shared<World>();
  world->scene.devices.emplace_back().role = "thumb";
  world->rig = rigWith(set("scale", "2"));
  Plan plan;
  plan.devices.emplace_back();
  plan.devices.back().role = "thumb";
  plan.devices.back().driver = "novint_falcon";
  Diagnostics diagnostics;
  const DeviceList devices = createDevices(world, {}, plan, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  ASSERT_EQ(devices.size(), 1U);
  EXPECT_TRUE(devices[0]->model().empty());  // a person
  EXPECT_FALSE(devices[0]->read({}).valid);  // not open
}

}  // namespace
}  // namespace presa::falcon
