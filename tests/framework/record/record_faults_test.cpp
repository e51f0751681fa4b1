#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/reader.h"
#include "tests/framework/record/recording_fixture.h"
#include "tests/support/effort.h"

namespace presa::record {
namespace {

/// A child process that sends numbers to the parent. It ends with _exit, so that no test clean-up runs twice.
class Child {
 public:
  template <class Work>
  explicit Child(const Work& work) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("pipe");
    id_ = fork();
    if (id_ == 0) {
      close(ends[0]);
      work(ends[1]);
      _exit(0);
    }
    close(ends[1]);
    from_ = ends[0];
  }
  ~Child() {
    close(from_);
    if (id_ > 0) killNow();
  }
  /// False when the child has ended.
  bool next(std::uint64_t& number) const { return read(from_, &number, sizeof number) == sizeof number; }
  void killNow() {
    kill(id_, SIGKILL);
    wait();
  }
  int wait() {
    int status = 0;
    waitpid(id_, &status, 0);
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
  int from_ = -1;
};

void send(int to, std::uint64_t number) {
  if (write(to, &number, sizeof number) != sizeof number) _exit(1);
}

int codeOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.diagnostics().all().front().code;
  }
  return 0;
}

int readCode(const std::string& file) {
  return codeOf([&] { readRecording(file); });
}

std::string bytesOf(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void writeBytes(const std::string& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

void recordTicks(const std::string& file, std::uint64_t ticks) {
  RecordedRun run(recordedSetup(file, false));
  run.step(ticks);
  run.recorder->finish();
}

// Flushed data survive a kill (power strip, Ctrl-\, OOM killer). The child flushes after every block and reports it,
// without pause, so that the kill falls between or inside writes.
TEST(KilledRun, IsReadableUpToItsLastFlush) {
  std::mt19937 random(7);
  for (int repeat = 0; repeat < unlessSanitized(12, 3); ++repeat) {
    const ScratchFolder folder;
    const std::string file = folder.file("run.h5");
    Child child([&](int to_parent) {
      WriterSettings settings;
      settings.look_every = std::chrono::milliseconds(0);
      settings.flush_every = std::chrono::milliseconds(0);
      settings.after_flush = [&](std::uint64_t ticks) { send(to_parent, ticks); };
      RecordedRun run(recordedSetup(file, false), settings);
      run.step(1'000'000);
    });
    std::uint64_t flushed = 0;
    const auto flushes = 1 + random() % 40;
    for (std::uint32_t i = 0; i < flushes || flushed == 0; ++i) ASSERT_TRUE(child.next(flushed));
    // a delay that differs from kill to kill, without sleeping
    for (volatile std::uint32_t spin = random() % 2'000'000; spin > 0;) spin = spin - 1;
    child.killNow();

    const Recording recording = readRecording(file);
    EXPECT_GE(recording.time.size() + 1, flushed);  // the newest tick may lack its schedule row, written after its step
    EXPECT_FALSE(recording.complete);
    EXPECT_EQ(differenceFromPrefix(recording), "");
  }
}

/// Records until the file cannot grow; sends rows, dropped and failed to the parent.
void recordUntilFull(const std::string& file, int to_parent) {
  WriterSettings settings;
  settings.flush_every = std::chrono::milliseconds(0);
  RecordedRun run(recordedSetup(file, false), settings);
  run.step(30'000);  // about 25 MB
  run.recorder->finish();
  const RecorderStatus status = run.recorder->status();
  for (const std::uint64_t number : {status.rows, status.dropped, std::uint64_t{status.failed}})
    send(to_parent, number);
}

void expectFailedButReadable(const Child& child, const std::string& file) {
  std::uint64_t rows = 0, dropped = 0, failed = 0;
  ASSERT_TRUE(child.next(rows) && child.next(dropped) && child.next(failed));
  EXPECT_EQ(failed, 1u);
  EXPECT_GT(rows, 0u);
  EXPECT_GE(rows + dropped, 30'000u);  // discarded schedule rows are counted too
  const Recording recording = readRecording(file);
  EXPECT_LE(recording.time.size(), rows);
  EXPECT_GE(recording.time.size() + 1, rows);  // the newest tick may lack its schedule row, written after its step
  EXPECT_FALSE(recording.complete);
  EXPECT_EQ(differenceFromPrefix(recording), "");
}

// A file-size limit raises SIGXFSZ, whose default action would end the program with a force still on the finger.
TEST(FullDisk, FileSizeLimitEndsTheRecordingNotTheRun) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  Child child([&](int to_parent) {
    const rlimit limit{9'000'000, 9'000'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    recordUntilFull(file, to_parent);
  });
  expectFailedButReadable(child, file);
  EXPECT_EQ(child.wait(), 0);
}

// A full file system of 8 MB, mounted in a mount namespace of the child, which copies the file out.
TEST(FullDisk, FullFileSystemEndsTheRecordingNotTheRun) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  const std::string disk = folder.file("disk");
  std::filesystem::create_directory(disk);
  Child child([&](int to_parent) {
    const bool mounted = unshare(CLONE_NEWNS) == 0 && mount("", "/", "", MS_REC | MS_PRIVATE, nullptr) == 0 &&
                         mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=8m") == 0;
    send(to_parent, mounted ? 1 : 0);
    if (!mounted) return;
    int numbers[2];
    if (pipe(numbers) != 0) _exit(1);
    recordUntilFull(disk + "/run.h5", numbers[1]);
    std::filesystem::copy_file(disk + "/run.h5", file);
    for (int i = 0; i < 3; ++i) {
      std::uint64_t number = 0;
      if (read(numbers[0], &number, sizeof number) != sizeof number) _exit(1);
      send(to_parent, number);
    }
  });
  std::uint64_t mounted = 0;
  ASSERT_TRUE(child.next(mounted));
  if (mounted == 0) GTEST_SKIP() << "mounting a small file system needs more rights";
  expectFailedButReadable(child, file);
  EXPECT_EQ(child.wait(), 0);
}

// A second run with the same file name must not destroy the first one's data because an option was forgotten.
TEST(Recorder, ReplacesAFileOnlyWhenAsked) {
  const ScratchFolder folder;
  const std::string file = folder.file("run.h5");
  recordTicks(file, 10);
  auto setup = recordedSetup(file, false);
  EXPECT_EQ(codeOf([&] { FileRecorder recorder(setup.world, setup.options, {}); }), 601);
  EXPECT_EQ(readRecording(file).time.size(), 10u);
  setup.options.overwrite = true;
  {
    RecordedRun run(setup);
    run.step(20);
    run.recorder->finish();
  }
  EXPECT_EQ(readRecording(file).time.size(), 20u);
}

// Every refusal gives its reason before the run starts.
TEST(Recorder, RefusesWhatCannotBeWritten) {
  const ScratchFolder folder;
  const auto nowhere = recordedSetup(folder.file("none/run.h5"), false);
  EXPECT_EQ(codeOf([&] { FileRecorder recorder(nowhere.world, nowhere.options, {}); }), 602);
  auto setup = recordedSetup(folder.path().string(), false);
  setup.options.overwrite = true;
  EXPECT_EQ(codeOf([&] { FileRecorder recorder(setup.world, setup.options, {}); }), 602);
}

// While a run writes a file, no reader and no other run may open it.
TEST(Recorder, KeepsOthersAwayWhileItWrites) {
  const ScratchFolder folder;
  auto setup = recordedSetup(folder.file("run.h5"), true);
  RecordedRun run(setup);
  EXPECT_EQ(readCode(folder.file("run.h5")), 603);
  RunOptions second = setup.options;
  second.overwrite = true;
  EXPECT_EQ(codeOf([&] { FileRecorder recorder(setup.world, second, {}); }), 602);
  run.step(5);
  run.recorder->finish();
  EXPECT_EQ(readRecording(folder.file("run.h5")).time.size(), 5u);
}

// A reader distinguishes the ways in which a file can be wrong.
TEST(Reader, RefusesEveryWrongFileWithItsReason) {
  const ScratchFolder folder;
  const std::string good = folder.file("good.h5"), bad = folder.file("bad.h5");
  recordTicks(good, 2000);
  const std::string bytes = bytesOf(good);

  EXPECT_EQ(readCode(folder.file("none.h5")), 603);
  EXPECT_EQ(readCode(folder.path().string()), 603);
  writeBytes(bad, "time,x,y,z\n0,1,2,3\n");
  EXPECT_EQ(readCode(bad), 604);

  std::string other = bytes;
  const std::size_t format = other.find("presa-recording");
  ASSERT_NE(format, std::string::npos);
  other.replace(format, 5, "other");
  writeBytes(bad, other);
  EXPECT_EQ(readCode(bad), 605);

  // attribute message: name in 16 bytes, number type in 16, scalar space in 8, then the value
  std::string newer = bytes;
  const std::size_t version = newer.find(std::string("format_version\0", 15));
  ASSERT_NE(version, std::string::npos);
  ASSERT_EQ(newer[version + 40], kToolsSince - 1);  // without tools
  newer[version + 40] = static_cast<char>(kFormatVersion + 1);
  writeBytes(bad, newer);
  EXPECT_EQ(readCode(bad), 606);

  const std::string empty = folder.file("empty.h5");
  recordTicks(empty, 0);
  EXPECT_EQ(readCode(empty), 607);

  writeBytes(bad, bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(readCode(bad), 608);
  std::string renamed = bytes;
  for (std::size_t at = renamed.find("command_count"); at != std::string::npos;
       at = renamed.find("command_count", at)) {
    renamed.replace(at, 7, "COMMAND");
  }
  writeBytes(bad, renamed);
  EXPECT_EQ(readCode(bad), 672);
}

}  // namespace
}  // namespace presa::record
