#include <gtest/gtest.h>
#include <stdio.h>

#include <cctype>
#include <cmath>
#include <cstdlib>

#include "framework/record/record_plugin/reader.h"
#include "framework/record/record_plugin/samples.h"
#include "tests/framework/record/recording_fixture.h"

namespace presa::record {
namespace {

/// Output of a command line.
std::string outputOf(const std::string& command) {
  std::string text;
  FILE* stream = popen((command + " 2>/dev/null").c_str(), "r");
  if (stream == nullptr) return text;
  char buffer[4096];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, stream)) > 0;) text.append(buffer, n);
  pclose(stream);
  return text;
}

/// Numbers after "DATA {".
std::vector<double> dataNumbers(const std::string& text) {
  std::vector<double> numbers;
  const std::size_t data = text.find("DATA {");
  if (data == std::string::npos) return numbers;
  for (const char* at = text.c_str() + data; *at != '\0';) {
    char* end = nullptr;
    const bool starts = *at == '-' || std::isdigit(static_cast<unsigned char>(*at)) != 0;
    const double number = starts ? std::strtod(at, &end) : 0;
    if (starts && end != at) numbers.push_back(number);
    at = starts && end != at ? end : at + 1;
  }
  return numbers;
}

/// A finished recording as read by HDF5's own tool, which shares no code with Presa's reader.
class RecordingTables : public testing::Test {
 protected:
  void SetUp() override {
    if (outputOf("h5dump --version").empty()) GTEST_SKIP() << "h5dump (hdf5-tools) is not installed";
    RecordedRun run(recordedSetup(folder_.file("run.h5"), false));
    run.step(20);
    run.recorder->finish();
  }
  std::string dump(const std::string& options) const {
    return outputOf("h5dump " + options + " " + folder_.file("run.h5"));
  }
  const ScratchFolder folder_;
};

// People read a subject's data with other tools: each column states its meaning and unit.
TEST_F(RecordingTables, NameTheirColumnsAndUnits) {
  const std::string columns = dump("-a /haptic/bodies/cube/columns");
  for (const char* name : {"index", "time", "p_WB_x", "p_WB_z", "q_WB_w", "q_WB_z", "v_WB_y", "w_WB_z"}) {
    EXPECT_NE(columns.find(name), std::string::npos) << name;
  }
  const std::string units = dump("-a /haptic/bodies/cube/units");
  for (const char* unit : {"\"s", "\"m", "\"m/s", "\"rad/s"}) EXPECT_NE(units.find(unit), std::string::npos) << unit;
  const std::string finger = dump("-H -d /haptic/fingers/index");
  for (const char* column :
       {"H5T_IEEE_F64LE \"depth\"", "H5T_IEEE_F64LE \"f_command_W_z\"", "H5T_STD_I32LE \"mode\""}) {
    EXPECT_NE(finger.find(column), std::string::npos) << column;
  }
}

// A recorded pose is that of its tick, not of the end of the step: here a quarter of the way from start to end.
TEST_F(RecordingTables, HoldThePoseAtTheTick) {
  const auto numbers = dataNumbers(dump("-y -d /haptic/bodies/cube -m %.17g"));
  constexpr std::size_t kRowColumns = 15;
  ASSERT_GE(numbers.size(), 20 * kRowColumns);
  const double* row = &numbers[7 * kRowColumns];
  // times of about 0.01 s subtract with an error of 2e-18, 5e-16 of the 4 ms span; 4 m of travel and the slerp: 1e-14
  constexpr double kTolerance = 1e-14;
  const double eighth = std::acos(-1.0) / 8;  // a quarter of 180 degrees, halved by the quaternion
  EXPECT_EQ(row[0], 7);
  EXPECT_EQ(row[1], 0.007);
  EXPECT_NEAR(row[4], 8, kTolerance);
  EXPECT_NEAR(row[5], std::cos(eighth), kTolerance);
  EXPECT_NEAR(row[8], std::sin(eighth), kTolerance);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(row[9 + i], static_cast<double>(i + 1));
}

std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }

// Columns equal the recorded values bit by bit, fingers in the order of the roles, bodies as HDF5's own tool reads
// them.
TEST_F(RecordingTables, ComeBackByColumn) {
  const RecordedSamples samples = readSamples(folder_.file("run.h5"));
  ASSERT_EQ(samples.time.size(), 20U);
  ASSERT_EQ(samples.fingers.size(), 2U);
  ASSERT_EQ(samples.bodies.size(), 1U);
  EXPECT_TRUE(samples.complete);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(samples.fingers[f].name, recordedSetup("", false).world->scene.devices[f].role);
    const auto& x = samples.fingers[f].values("p_WH_x");
    const auto& force_z = samples.fingers[f].values("f_command_W_z");
    for (std::size_t i = 0; i < 20; ++i) {
      ASSERT_EQ(bitsOf(x.at(i)), bitsOf(deviceAt(i).fingers[f].p_WH.x())) << i;
      ASSERT_EQ(bitsOf(force_z.at(i)), bitsOf(commandAt(i).f_H_W[f].z())) << i;
    }
  }
  const auto numbers = dataNumbers(dump("-y -d /haptic/bodies/cube -m %.17g"));
  const RecordedTable& cube = samples.bodies.front();
  EXPECT_EQ(cube.name, "cube");
  ASSERT_EQ(cube.columns.size(), 13U);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(samples.time[i], numbers.at(i * 15 + 1));
    for (std::size_t c = 0; c < 13; ++c) ASSERT_EQ(cube.columns[c].values.at(i), numbers.at(i * 15 + 2 + c));
  }
  EXPECT_EQ(cube.columns[1].unit, "m");
  EXPECT_THROW(cube.values("none"), std::out_of_range);
}

// The names of a scripted motion's phases stay with the column that counts them, under the checksum of the file. A file
// without any keeps the format that older programs read (record_faults_test: kToolsSince - 1).
TEST(RecordedPhases, HaveTheirNames) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  const std::vector<std::string> names{"reach", "lift \xc3\xa0 deux"};
  RecordedRun run(recordedSetup(file, false), {}, {.tools = {}, .phases = {{}, names}});
  run.step(20);
  run.recorder->finish();
  const RecordedSamples samples = readSamples(file);
  EXPECT_TRUE(samples.checksum);
  EXPECT_EQ(samples.fingers[0].phases, std::vector<std::string>{});
  EXPECT_EQ(samples.fingers[1].phases, names);
  EXPECT_EQ(differenceFromPrefix(readRecording(file)), "");
}

}  // namespace
}  // namespace presa::record
