// `presa device list | check | doctor` as a user runs them, on a computer with or without a Falcon.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/presa/device/findings.h"
#include "tests/apps/support/support.h"

namespace presa::device {
namespace {

using test::presa;
using test::scratch;
using test::source;

const nlohmann::json& reportOf(const nlohmann::json& reports, const std::string& name) {
  for (const auto& report : reports)
    if (report.at("name") == name) return report;
  throw std::runtime_error("nothing about " + name);
}

TEST(DeviceList, NamesEveryDriverAndWhatItFinds) {
  const auto outcome = presa("device list --format json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto reports = nlohmann::json::parse(outcome.out);
  std::size_t drivers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source("devices"))) {
    // only folders that build a plug-in are drivers
    if (!std::filesystem::exists(PRESA_BINARY_DIR "/lib/presa/presa_" + entry.path().filename().string() + ".so"))
      continue;
    ++drivers;
    const auto& report = reportOf(reports, entry.path().filename());
    EXPECT_FALSE(report.at("summary").get<std::string>().empty()) << entry.path();
    EXPECT_FALSE(report.at("findings").empty()) << entry.path();
  }
  EXPECT_GE(drivers, 6u);
  EXPECT_EQ(reports.size(), drivers);
}

TEST(DeviceList, AnUnknownDriverIsAProblemInItsPlace) {
  const auto outcome = presa("device list novint_flacon");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("[E590] there is no plug-in 'novint_flacon'"), std::string::npos) << outcome.out;
}

TEST(DeviceCheck, ASimulatedRigIsReady) {
  const auto outcome = presa("device check " + source("config/rigs/pinch_cube.xml"));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("thumb: scripted\n  good    simulated: needs no hardware\n"), std::string::npos)
      << outcome.out;
}

// Serial number and firmware come from the rig; a missing device of the rig is reported as a problem.
TEST(DeviceCheck, AFalconThatIsNotThereIsAProblem) {
  const std::string rig = scratch("rig.xml");
  std::ofstream(rig)
      << R"(<rig version="1.0" name="desk"><device role="thumb" driver="novint_falcon" serial="none such">
    <set key="firmware" value="falcon.bin"/></device></rig>)";
  const auto outcome = presa("device check --format json " + rig);
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const auto findings = nlohmann::json::parse(outcome.out).at(0).at("findings");
  ASSERT_GE(findings.size(), 2U);
  EXPECT_EQ(findings[0].at("code"), 481);
  EXPECT_NE(findings[0].at("message").get<std::string>().find("falcon.bin"), std::string::npos);
  EXPECT_EQ(findings.back().at("verdict"), "problem");
  EXPECT_TRUE(findings.back().at("code") == 487 || findings.back().at("code") == 488) << outcome.out;
}

TEST(DeviceCheck, ABadRigIsBadInput) { EXPECT_EQ(presa("device check /nowhere/rig.xml").status, 2); }

TEST(DeviceDoctor, WritesTheRulesThatTheDriversAskFor) {
  const std::string folder = scratch("rules");
  std::filesystem::create_directories(folder);
  const std::string file = folder + "/60-presa-novint_falcon.rules";
  const auto before = presa("device doctor --udev-folder " + folder);
  EXPECT_NE(before.out.find("warning there is no udev rule of novint_falcon"), std::string::npos) << before.out;
  EXPECT_FALSE(std::filesystem::exists(file));
  const auto after = presa("device doctor --install-udev --udev-folder " + folder);
  EXPECT_NE(after.out.find("good    the udev rule of novint_falcon is installed"), std::string::npos) << after.out;
  std::ifstream in(file);
  std::string comment, rule;
  std::getline(in, comment), std::getline(in, rule);
  EXPECT_EQ(comment.substr(0, 2), "# ");
  EXPECT_EQ(rule, R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0664", GROUP="plugdev")");
}

TEST(DeviceDoctor, RulesThatCannotBeWrittenAreRefused) {
  const auto outcome = presa("device doctor --install-udev --udev-folder /nowhere/rules.d");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("error[E477]"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("sudo presa device doctor --install-udev"), std::string::npos);
}

TEST(DeviceFindings, SayVerdictDeviceCodeAndRemedy) {
  using Verdict = DeviceFinding::Verdict;
  const std::vector<Report> reports{
      {"a", "one", {{Verdict::kFine, 0, "A7", "ready", ""}, {Verdict::kWarning, 12, "", "not so good", "do this"}}},
      {"b", "", {{Verdict::kProblem, 480, "port 1-2", "bad", "do that"}}}};
  EXPECT_EQ(text(reports, false),
            "a: one\n  good    A7: ready\n  warning [W12] not so good\n          do this\n"
            "b\n  problem [E480] port 1-2: bad\n          do that\n");
  EXPECT_TRUE(hasProblem(reports));
  EXPECT_FALSE(hasProblem({reports[0]}));
}

}  // namespace
}  // namespace presa::device
