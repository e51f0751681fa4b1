// A recording names the values whose versions its schedule holds; a replay finds its inputs by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "apps/common/scratch_folder.h"
#include "framework/core/graph/port.h"
#include "framework/record/record_plugin.h"
#include "framework/scene/surface_change.h"
#include "framework/session/replay.h"
#include "framework/session/run.h"

namespace presa {
namespace {

constexpr double kDuration = 2.5;  // [s] the cube is in the air

/// Sorts before every other value by name.
constexpr const char* kFirst = "a_brake_state";

/// At another rate than the dynamics, so that its versions are not those of the object state.
class Brake final : public Module {
 public:
  explicit Brake(const char* port) : Module("brake", RateGroup::kCollision), out(*this, port) {}
  void step(const Tick&) noexcept override {}
  Out<SurfaceChange> out;
};

class BrakeReader final : public Module {
 public:
  BrakeReader() : Module("brake_reader", RateGroup::kHaptic) {}
  void step(const Tick&) noexcept override {}
  In<SurfaceChange> in{*this, kFirst};
};

class RecordedInputs : public testing::Test {
 protected:
  /// The cube, with modules of a program that a replay does not have.
  Recording record(std::vector<std::unique_ptr<Module>> more, const std::vector<std::string>& sets = {}) {
    Diagnostics diagnostics;
    RunOptions options;
    options.record = file_;
    options.duration = kDuration;
    Loaded loaded = loadWorld({PRESA_SOURCE_DIR "/config/scenes/cube.xml", "", sets}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    RunControl control;
    Session::Options session_options;
    session_options.more = std::move(more);
    presa::Run(std::move(loaded), control, std::move(session_options)).execute();
    return recordPlugin().read(file_);
  }
  Recording recordWithBrake() {
    std::vector<std::unique_ptr<Module>> more;
    more.push_back(std::make_unique<Brake>(kFirst));
    more.push_back(std::make_unique<BrakeReader>());
    return record(std::move(more));
  }
  /// The same file with the number of an older format, whose readers know neither names nor a checksum.
  Recording readAsOld() {
    std::fstream bytes(file_, std::ios::in | std::ios::out | std::ios::binary);
    const std::string all((std::istreambuf_iterator<char>(bytes)), {});
    // attribute message: name in 16 bytes, number type in 16, scalar space in 8, then the value
    bytes.seekp(static_cast<std::streamoff>(all.find(std::string("format_version\0", 15)) + 40));
    bytes << '\x05' << std::flush;
    return recordPlugin().read(file_);
  }
  static ReplayResult again(const Recording& recording) {
    Diagnostics diagnostics;
    RecordedRun run(recording, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    return run.run();
  }
  static std::string refusal(const Recording& recording) {
    Diagnostics diagnostics;
    const RecordedRun run(recording, diagnostics);
    EXPECT_EQ(diagnostics.errorCount(), 1u) << diagnostics.text();
    return diagnostics.text();
  }
  static std::vector<std::string>& haptic(Recording& recording) {
    return recording.inputs->at(static_cast<std::size_t>(RateGroup::kHaptic));
  }

  const ScratchFolder folder_;
  const std::string file_ = folder_.file("run.h5");
};

// The order alone is not enough: the same file, read in a format without names, gives another run.
TEST_F(RecordedInputs, AValueThatComesFirstByNameLeavesTheReplayExact) {
  Recording recording = recordWithBrake();
  ASSERT_TRUE(recording.inputs);
  EXPECT_EQ(haptic(recording).front(), kFirst);
  const ReplayResult result = again(recording);
  EXPECT_TRUE(result.verified()) << result.problem << ' ' << result.differing;
  EXPECT_EQ(result.ticks, 2500u);

  const Recording old = readAsOld();
  EXPECT_FALSE(old.inputs);
  EXPECT_FALSE(again(old).verified());
}

TEST_F(RecordedInputs, AnOlderFormatIsReplayedByTheOrderOfNames) {
  const Recording recording = record({});
  EXPECT_TRUE(again(recording).verified());
  const Recording old = readAsOld();
  EXPECT_FALSE(old.inputs);
  EXPECT_TRUE(again(old).verified());
}

TEST_F(RecordedInputs, ColumnsMayStandInAnyOrder) {
  Recording recording = recordWithBrake();
  std::vector<std::string>& names = haptic(recording);
  ASSERT_EQ(names, (std::vector<std::string>{kFirst, "object_state"}));
  std::swap(names[0], names[1]);
  for (ScheduleRow& row : recording.schedule.front()) std::swap(row.versions[0], row.versions[1]);
  EXPECT_TRUE(again(recording).verified());
}

TEST_F(RecordedInputs, WhatAReplayMissesIsNamed) {
  const Recording recording = record({});
  Recording lacks = recording;
  const auto at = std::find(haptic(lacks).begin(), haptic(lacks).end(), "object_state");
  ASSERT_NE(at, haptic(lacks).end());
  *at = "pointer_state";
  const std::string text = refusal(lacks);
  for (const std::string& word : {file_ + ": error[E678]", std::string("schedule/haptic"),
                                  std::string("'object_state'"), recording.program_version})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\nin: " << text;
}

// A recorded value that a module of the replay has a port for, and that nothing writes in the replay, is an error.
TEST_F(RecordedInputs, WhatNobodyWritesInAReplayIsMissedWhereItIsRead) {
  std::vector<std::unique_ptr<Module>> more;
  more.push_back(std::make_unique<Brake>("surface_change"));
  const std::string text = refusal(record(std::move(more), {"material/rubber/friction/changed/static=0.2"}));
  EXPECT_NE(text.find("error[E678]"), std::string::npos) << text;
  EXPECT_NE(text.find("'surface_change'"), std::string::npos) << text;
}

}  // namespace
}  // namespace presa
