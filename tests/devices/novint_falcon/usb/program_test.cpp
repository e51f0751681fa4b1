// The program in a separate process on emulated Falcons. Not under the sanitizers, whose libraries would have to be
// loaded before umockdev's.
#ifndef PRESA_SANITIZE
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "devices/novint_falcon/usb_bus.h"
#include "tests/devices/novint_falcon/usb/drivers.h"
#include "tests/support/on_terminal.h"

namespace presa::falcon_model::test {
namespace {

using testing::HasSubstr;

struct Outcome {
  int status = -1;  ///< exit status
  std::string out;  ///< stdout and stderr
};

Outcome presa(const std::string& arguments) {
  const std::string command = std::string(PRESA_BINARY_DIR) + "/bin/presa " + arguments + " 2>&1";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return outcome;
  char part[256];
  while (std::fgets(part, sizeof part, pipe) != nullptr) outcome.out += part;
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

std::string rig() {
  const auto file = std::filesystem::temp_directory_path() / ("presa_falcons_" + std::to_string(::getpid()) + ".xml");
  std::ofstream out(file);
  out << "<rig version=\"1.0\" name=\"falcons\">\n"
         "<device role=\"thumb\" driver=\"novint_falcon\" serial=\"1-1\"/>\n"
         "<device role=\"index\" driver=\"novint_falcon\" serial=\"1-2\"/>\n</rig>\n";
  return file.string();
}

TEST(FalconProgram, ListCheckAndDoctorSeeTheEmulatedDevices) {
  EmulatedBus bus;
  bus.add(ready());
  bus.add({});  // without firmware
  const auto list = presa("device list");
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out, HasSubstr("serial FALCON1, port 1-1"));
  EXPECT_THAT(list.out, HasSubstr("serial FALCON2, port 1-2"));
  EXPECT_THAT(list.out, HasSubstr("its firmware runs, the grip is homed"));
  const std::string file = rig();
  const auto check = presa("device check " + file);
  std::filesystem::remove(file);
  EXPECT_NE(check.status, 0);
  EXPECT_THAT(check.out, HasSubstr("no firmware yet"));
  EXPECT_THAT(presa("device doctor").out, HasSubstr("FALCON1"));
}

/// The grip moves in and out of a soft block, by up to 25 mm at 80 N/m.
std::string pressedRun(const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::vector<std::uint8_t> bytes = firmware();
  std::ofstream(folder + "/falcon.bin", std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), 700);
  std::ofstream(folder + "/rig.xml")
      << "<rig version=\"1.0\" name=\"falcon\"><device role=\"thumb\" driver=\"novint_falcon\" serial=\"1-1\">"
         "<set key=\"firmware\" value=\"falcon.bin\"/></device></rig>";
  std::ofstream(folder + "/scene.xml")
      << "<scene version=\"1.0\" name=\"block\" rig=\"rig.xml\"><world gravity=\"0 0 -9.81\"/>"
         "<materials><material name=\"foam\" stiffness=\"80\"/></materials>"
         "<body name=\"block\" fixed=\"true\" material=\"foam\" pos=\"0 0 0.0725\">"
         "<haptic><box size=\"0.3 0.3 0.145\"/></haptic></body>"
         "<devices><device role=\"thumb\"/></devices></scene>";
  return folder + "/scene.xml";
}

// Row 1 as a user meets it: the program, a supervisor that holds the device, real threads. The Falcon is unplugged, and
// the program reports it. While it is away a re-arm has no effect; plugged in again it is opened, with firmware and
// references, and pushes.
TEST(FalconProgram, APulledOutFalconComesBackAfterARearm) {
  EmulatedBus bus;
  EmulatedFalcon& falcon = bus.add(ready());
  falcon.with([](FalconModel& model, double) {
    model.limits({.force = 8, .force_rate = 1000, .jitter = 1e-3});
    model.grip().hand([](double time) -> Vec3 { return {0, 0, 0.145 + 0.025 * std::sin(6 * time)}; });
  });
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("presa_falcon_" + std::to_string(getpid()))).string();
  presa::test::OnTerminal program({PRESA_BINARY_DIR "/bin/presa", "run", pressedRun(folder), "--realtime", "--view",
                                   "none", "--for", "200", "--allow-no-rt", "--flight", folder + "/flight.h5"});
  const auto pushes = [&] {
    for (int i = 0; i < 2000; ++i) {
      if (falcon.with([](FalconModel& model, double) { return model.received().meant_D.norm() > 0.4; })) return true;
      program.listen(0.01);
    }
    return false;
  };
  // the number of late samples is not visible from outside
  const bool pushed = pushes();
  if (!pushed && !whyLate().empty()) GTEST_SKIP() << "no force was felt; " << whyLate();
  ASSERT_TRUE(pushed) << program.seen();
  falcon.unplug();
  ASSERT_TRUE(program.says("Check the device, then press r to re-arm.")) << program.seen();
  EXPECT_THAT(program.seen(), HasSubstr("thumb: device disconnected"));
  program.press('r');
  EXPECT_TRUE(program.says("not re-armed.")) << program.seen();
  falcon.plug();
  program.press('r');
  ASSERT_TRUE(program.says("re-armed: forces come back softly")) << program.seen();
  const bool pushed_again = pushes();
  if (!pushed_again && !whyLate().empty()) GTEST_SKIP() << "no force was felt again; " << whyLate();
  ASSERT_TRUE(pushed_again) << program.seen();
  program.press('\x03');
  EXPECT_EQ(program.status(), 130) << program.seen();  // interrupted
  EXPECT_THAT(program.seen(), HasSubstr("the seconds around the fault: "));
  falcon.with([](FalconModel& model, double) {
    EXPECT_FALSE(model.holdsForce());
    EXPECT_THAT(model.violations(), testing::IsEmpty());
  });
  std::filesystem::remove_all(folder);
}

// Row 19 between processes.
TEST(FalconProgram, ASecondProgramIsToldThatAnotherHoldsTheDevice) {
  EmulatedBus bus;
  bus.add(ready());
  falcon::UsbFailure failure;
  const auto first = falcon::openFalcon("", failure);
  ASSERT_TRUE(first);
  EXPECT_THAT(presa("device list").out, HasSubstr("another program holds /dev/bus/usb/001/002"));
}

}  // namespace
}  // namespace presa::falcon_model::test
#endif
