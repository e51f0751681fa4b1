#include <gtest/gtest.h>

#include <semaphore>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/record/record_plugin.h"
#include "framework/record/record_plugin/reader.h"
#include "tests/framework/record/recording_fixture.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa::record {
namespace {

// A replay starts from these bits; one wrong bit makes every later tick differ.
TEST(Recording, RestoresEveryBitOfInputsForcesAndSchedule) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  RecordedRun run(recordedSetup(file, false));
  run.step(5000);  // several blocks, the last one not full
  run.recorder->finish();

  const Recording recording = readRecording(file);
  ASSERT_EQ(recording.time.size(), 5000u);
  EXPECT_EQ(recording.schedule[0].size(), 5000u);
  EXPECT_EQ(recording.schedule[static_cast<std::size_t>(RateGroup::kDynamics)].size(), 1000u);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// The scene is stored with the data, whatever its length: an attribute would be limited to 64 kB.
TEST(Recording, CarriesSceneRigSeedAndMode) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  auto setup = recordedSetup(file, true);
  RecordedRun run(setup);
  run.step(10);
  run.recorder->finish();

  const Recording recording = readRecording(file);
  EXPECT_EQ(recording.scene_xml, setup.world->scene.resolved_xml);
  EXPECT_EQ(recording.rig_xml, "<rig/>");
  EXPECT_EQ(recording.scene_file, "scenes/cube.xml");
  EXPECT_EQ(recording.seed, setup.options.seed);
  EXPECT_TRUE(recording.realtime);
  EXPECT_TRUE(recording.complete);
  EXPECT_EQ(recording.dropped, 0u);
  EXPECT_EQ(recording.haptic_period, 0.001);  // 1e6 ns * 1e-9: exact as the nearest double
  EXPECT_FALSE(recording.program_version.empty());
}

// In lockstep there is no deadline, so the run waits for the disk. The writer is held until the ring is full, so the
// next step must wait, and the schedule rows of that time must fit too.
TEST(Recorder, LosesNothingInLockstepWhenTheDiskIsBehind) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  std::atomic<FileRecorder*> recorder{nullptr};
  WriterSettings settings;
  settings.before_round = [&] {
    while (recorder == nullptr) std::this_thread::yield();
    while (recorder.load()->status().rows < recorder.load()->capacity()) std::this_thread::yield();
  };
  RecordedRun run(recordedSetup(file, false), settings);
  recorder = run.recorder;
  const std::uint64_t ticks = 5 * run.recorder->capacity() + 17;
  run.step(ticks);
  run.recorder->finish();

  EXPECT_EQ(run.recorder->status().rows, ticks);
  EXPECT_EQ(run.recorder->status().dropped, 0u);
  const Recording recording = readRecording(file);
  EXPECT_EQ(recording.time.size(), ticks);
  EXPECT_EQ(recording.schedule[0].size(), ticks);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// In real time the haptic loop has priority: a full ring drops rows and counts them.
TEST(Recorder, DropsAndCountsInRealTimeWhenTheRingIsFull) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  std::binary_semaphore go(0);
  WriterSettings settings;
  settings.before_round = [&] {
    go.acquire();
    go.release();
  };
  RecordedRun run(recordedSetup(file, true), settings);
  const std::size_t capacity = run.recorder->capacity();
  EXPECT_EQ(capacity, 4000u);  // 4 s at 1 kHz
  run.step(capacity + 37);
  EXPECT_EQ(run.recorder->status().rows, capacity);
  EXPECT_EQ(run.recorder->status().dropped, 37u);
  go.release();
  run.recorder->finish();

  const Recording recording = readRecording(file);
  EXPECT_EQ(recording.time.size(), capacity);
  EXPECT_EQ(recording.dropped, 37u);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// The recorder's step runs in the haptic loop of every recorded run.
TEST(Recorder, StepNeitherAllocatesNorLocksNorCallsTheSystem) {
  const ScratchFolder folder;
  std::binary_semaphore go(0);
  WriterSettings settings;
  settings.before_round = [&] {
    go.acquire();
    go.release();
  };
  RecordedRun run(recordedSetup(folder.file("run.h5"), true), settings);
  if (!RealTimeGuard::active()) {
    go.release();
    GTEST_SKIP() << "the sanitizers own these functions";
  }
  {
    RealTimeGuard guard;
    run.step(run.recorder->capacity() + 10);  // covers both an open and a full ring
    EXPECT_EQ(guard.violations(), 0) << guard.first();
  }
  if (syscallTrapWorks()) {
    EXPECT_EQ(runUnderSyscallTrap([&] { run.step(100); }), "");
  }
  go.release();
}

// A recorder destroyed by an exception leaves a readable file that is marked incomplete.
TEST(Recorder, LeavesAReadableFileWhenItIsDestroyedWithoutFinish) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  {
    RecordedRun run(recordedSetup(file, true));
    run.step(300);
  }
  const Recording recording = readRecording(file);
  EXPECT_EQ(recording.time.size(), 300u);
  EXPECT_FALSE(recording.complete);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// At 4 kHz the schedule rings hold the four seconds that a disk may stall.
TEST(ScheduleLog, HoldsFourSecondsOfTheFastestRun) {
  ScheduleLog log;
  for (auto& ring : log.rings) {
    for (int i = 0; i < 4 * 4000; ++i) ring->push({});
    EXPECT_EQ(ring->dropped(), 0u);
  }
}

// The program uses HDF5 only through this function table.
TEST(RecordPlugin, LoadsBesideTheFrameworkAndMakesRecorders) {
  const ScratchFolder folder;
  EXPECT_EQ(recordPlugin().abi, kPluginAbi);
  auto setup = recordedSetup(folder.file("run.h5"), false);
  setup.world->scene.devices.clear();  // ports stay unconnected
  const auto recorder = recordPlugin().create(setup.world, setup.options, {});
  EXPECT_EQ(recorder->group(), RateGroup::kHaptic);
  ScheduleLog schedule;
  recorder->attach(schedule);
  recorder->step({0, 0.0, 0.001});
  schedule.rings[0]->push({});
  recorder->finish();
  EXPECT_EQ(recordPlugin().read(folder.file("run.h5")).time.size(), 1u);
}

}  // namespace
}  // namespace presa::record
