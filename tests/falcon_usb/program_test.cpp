// The program in a process of its own, on emulated Falcons. Not under the sanitizers, whose libraries would have to come before umockdev's
// in that process too.
#ifndef PRESA_SANITIZE
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "devices/novint_falcon/usb_bus.h"
#include "tests/falcon_usb/drivers.h"

namespace presa::falcon_model::test {
namespace {

using testing::HasSubstr;

struct Outcome {
  int status = -1;  ///< exit status
  std::string out;  ///< and what was said of errors
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
