#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "framework/record/record_plugin/samples.h"
#include "tests/framework/record/recording_fixture.h"

namespace presa::record {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

RecordedSetup flownSetup(const std::string& flight) {
  auto setup = recordedSetup("", false);
  setup.options.flight = flight;
  return setup;
}

/// Waits until the writer has created the file, at most five seconds.
bool appears(const std::string& file) {
  for (int i = 0; i < 500 && !fs::exists(file); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return fs::exists(file);
}

class Flight : public testing::Test {
 protected:
  ScratchFolder folder_;
  std::string file_ = folder_.file("flight.h5"), second_ = folder_.file("flight-2.h5");
};

TEST_F(Flight, WithoutAFaultNothingIsWritten) {
  RecordedRun run(flownSetup(file_));
  run.step(3000);
  run.recorder->finish();
  EXPECT_THAT(run.recorder->files(), ElementsAre());
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Flight, AFaultWritesTwoSecondsBeforeItAndHalfASecondAfter) {
  RecordedRun run(flownSetup(file_));
  run.step(3000);
  run.recorder->fault(3.0, "thumb: its device is gone");
  ASSERT_TRUE(appears(file_));
  run.step(2000);
  run.recorder->finish();
  EXPECT_THAT(run.recorder->files(), ElementsAre(file_));
  EXPECT_FALSE(run.recorder->status().failed);

  const RecordedSamples samples = readSamples(file_);
  EXPECT_TRUE(samples.complete);
  EXPECT_EQ(samples.first_tick, 1000u);
  ASSERT_EQ(samples.time.size(), 2500u);
  EXPECT_THAT(samples.faults, ElementsAre("3.000 s: thumb: its device is gone"));
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const std::uint64_t tick = 1000 + i;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(samples.fingers[1].values("f_command_W_y")[i]),
              std::bit_cast<std::uint64_t>(commandAt(tick).f_H_W[1].y()));
    EXPECT_EQ(samples.status[i], commandAt(tick).status);
  }
}

TEST_F(Flight, AnEarlyFaultHasWhatThereIs) {
  RecordedRun run(flownSetup(file_));
  run.step(700);
  run.recorder->fault(0.7, "one");
  ASSERT_TRUE(appears(file_));
  run.recorder->finish();
  const RecordedSamples samples = readSamples(file_);
  EXPECT_EQ(samples.first_tick, 0u);
  EXPECT_EQ(samples.time.size(), 700u);
  EXPECT_TRUE(samples.complete);
}

TEST_F(Flight, FaultsInARowShareAFileALaterOneGetsItsOwn) {
  RecordedRun run(flownSetup(file_));
  run.step(1000);
  run.recorder->fault(1.0, "one");
  run.recorder->fault(1.0, "two");
  ASSERT_TRUE(appears(file_));
  run.step(3000);
  run.recorder->fault(4.0, "three");
  ASSERT_TRUE(appears(second_));
  run.recorder->finish();
  EXPECT_THAT(run.recorder->files(), ElementsAre(file_, second_));
  EXPECT_THAT(readSamples(file_).faults, ElementsAre("1.000 s: one", "1.000 s: two"));
  EXPECT_THAT(readSamples(second_).faults, ElementsAre("4.000 s: three"));
  EXPECT_EQ(readSamples(second_).first_tick, 2000u);
}

TEST_F(Flight, NeverReplacesAFile) {
  { RecordedRun(recordedSetup(file_, false)).step(10); }
  const auto size = fs::file_size(file_);
  RecordedRun run(flownSetup(file_));
  run.step(100);
  run.recorder->fault(0.1, "one");
  ASSERT_TRUE(appears(second_));
  run.recorder->finish();
  EXPECT_EQ(fs::file_size(file_), size);
}

TEST_F(Flight, AFolderThatIsNotThereIsSaidAtTheStart) {
  try {
    const RecordedSetup setup = flownSetup(folder_.file("none/flight.h5"));
    FileRecorder recorder(setup.world, setup.options, {});
    FAIL() << "it started";
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics().all().front().code, 602);
  }
}

}  // namespace
}  // namespace presa::record
