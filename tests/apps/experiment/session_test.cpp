#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/dataset.h"
#include "framework/core/math/random.h"
#include "tests/apps/experiment/contents.h"

// Whole sessions through the program: the files on disk after every kind of end.
namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kProgram = std::string(PRESA_BINARY_DIR) + "/bin/presa";
const std::string kLift = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/lift.xml";

const std::string kRub = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/rub.xml";

/// The program in a separate process, with its output in a file.
class Process {
 public:
  Process(std::vector<std::string> arguments, const std::string& output) {
    std::vector<char*> argv{const_cast<char*>(kProgram.c_str())};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawn(&id_, kProgram.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
  }
  void kill(int signal) const { ::kill(id_, signal); }
  /// Exit status, or 128 + the signal that ended the process.
  int wait() const {
    int status = 0;
    ::waitpid(id_, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  pid_t id_ = 0;
};

class SessionTest : public testing::Test {
 protected:
  static std::vector<std::string> runArguments(const std::string& data, const std::string& file = kLift) {
    return {"experiment", "run", file, "--subject", "S01", "--lockstep", "--data", data};
  }
  int program(std::vector<std::string> arguments) {
    const int status = Process(std::move(arguments), scratch.file("output")).wait();
    output = contentsOf(scratch.file("output"));
    return status;
  }
  static void awaitFirstTrial(const std::string& data) {
    const std::string table = folderOf(data, "S01", 1).file("trials.csv");
    for (int i = 0; i < 6000 && !fs::exists(table); ++i) ::usleep(10000);
    ASSERT_TRUE(fs::exists(table));
  }
  static SessionLog logOf(const std::string& data) {
    const SessionFolder folder = folderOf(data, "S01", 1);
    return readLog(folder.journal(), Journal::read(folder.journal()).records);
  }
  /// The part of a log that must not depend on interruptions: every uninterrupted run, without times and file names.
  static std::string essence(const SessionLog& log) {
    std::string text;
    for (const LoggedRun& run : log.runs) {
      if (run.outcome == Outcome::kInterrupted) continue;
      Json all = run.begin;
      for (const char* name : {"run", "files", "utc"}) all.erase(name);
      all["outcome"] = toString(run.outcome);
      for (const char* name : {"reason", "phases", "values", "simulated_s"}) all[name] = run.end.at(name);
      text += all.dump() + "\n";
    }
    return text;
  }
  ScratchFolder scratch;
  std::string output;
};

TEST_F(SessionTest, LeavesADatasetThatIsComplete) {
  const std::string data = scratch.file("data");
  ASSERT_EQ(program(runArguments(data)), 0) << output;
  EXPECT_THAT(output, HasSubstr("6 trials done, 3 given up, in 12 runs"));
  EXPECT_EQ(program({"experiment", "validate", data}), 0) << output;
  const SessionLog log = logOf(data);
  ASSERT_TRUE(log.complete);
  // the scripted grip of 6 N cannot lift 0.2 kg at mu = 0.1; it slips at m g / (2 mu); 0.5 % is the accuracy of the
  // study
  for (const LoggedRun& run : log.runs) {
    const bool heavy_slippery = run.begin["condition"]["mass"] == "0.2" && run.begin["condition"]["mu_s"] == "0.1";
    ASSERT_EQ(run.outcome, heavy_slippery ? Outcome::kAborted : Outcome::kDone);
    if (heavy_slippery) continue;
    const double slip = run.end["values"]["F_slip"];
    EXPECT_NEAR(run.end["values"]["F_slip_measured"], slip, 0.005 * slip);
  }
}

TEST_F(SessionTest, IsNeverOverwritten) {
  const std::string data = scratch.file("data");
  ASSERT_EQ(program(runArguments(data)), 0);
  const std::string before = contentsOf(folderOf(data, "S01", 1).journal());
  EXPECT_EQ(program(runArguments(data)), 2);
  EXPECT_THAT(output, HasSubstr("error[E920]: there is a session already"));
  EXPECT_EQ(contentsOf(folderOf(data, "S01", 1).journal()), before);
  EXPECT_EQ(program({"experiment", "resume", data}), 0);
  EXPECT_THAT(output, HasSubstr("no session is left to finish"));
}

// Resumes with a trailing slash as the shell completes it, and beside sessions that never began.
TEST_F(SessionTest, ResumesFromAnywhere) {
  const std::string data = scratch.file("data");
  const Process process(runArguments(data), scratch.file("output"));
  awaitFirstTrial(data);
  process.kill(SIGKILL);
  process.wait();
  std::ofstream(folderOf(data, "S01", 1).file("trials.csv.backup")) << "mine";
  fs::create_directories(data + "/sub-S02/ses-1");
  std::ofstream(folderOf(data, "S02", 1).journal());  // a session that never began must not interfere
  EXPECT_EQ(program({"experiment", "resume", folderOf(data, "S01", 1).path + "/"}), 0) << output;
  EXPECT_TRUE(logOf(data).complete);
  EXPECT_TRUE(fs::exists(folderOf(data, "S01", 1).file("trials.csv.backup")));
  EXPECT_EQ(program({"experiment", "resume", data}), 0) << output;
}

// Two sessions give the same numbers, even when they are killed at random moments and resumed each time. PRESA_KILLS:
// number of kills (default 12; the README cites 200).
TEST_F(SessionTest, KilledAtAnyMomentItEndsAsIfItHadNotBeen) {
  const std::string whole = scratch.file("whole");
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(program(runArguments(whole)), 0);
  // the duration of the uninterrupted run scales the times of the kills to the speed of the machine
  const double whole_us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  const std::string expected = essence(logOf(whole));
  const char* wanted = std::getenv("PRESA_KILLS");
  const int kills = wanted != nullptr ? std::atoi(wanted) : 12;
  RandomStream random(1, "kills");
  int killed = 0, interrupted = 0;
  // continue until enough kills fell into trials rather than into program starts, which take longer on a busy machine
  const auto enough = [&] { return killed >= kills && interrupted > kills / 4; };
  for (int session = 0; !enough() && session < 2 * kills; ++session) {
    int left = kills;  // kills left for this session
    const std::string data = scratch.file("data" + std::to_string(session));
    std::vector<std::string> arguments = runArguments(data);
    for (bool ended = false; !ended;) {
      const Process process(arguments, scratch.file("output"));
      ::usleep(static_cast<useconds_t>(random.uniform(0.02, 0.7) * whole_us));
      if (left-- > 0) process.kill(SIGKILL);
      const int status = process.wait();
      ended = status == 0;
      ASSERT_TRUE(ended || status == 128 + SIGKILL) << status << contentsOf(scratch.file("output"));
      if (ended) break;
      ++killed;
      // before its first record there is nothing to resume
      const std::string journal = folderOf(data, "S01", 1).journal();
      if (fs::exists(journal) && !Journal::read(journal).records.empty()) arguments = {"experiment", "resume", data};
    }
    const SessionLog log = logOf(data);
    ASSERT_EQ(essence(log), expected) << "after " << killed << " kills";
    for (const LoggedRun& run : log.runs) {
      if (run.outcome != Outcome::kInterrupted) continue;
      ++interrupted;
      ASSERT_EQ(run.end.at("reason"), "the process ended");
    }
    ASSERT_THAT(validate(folderOf(data, "S01", 1)).findings, IsEmpty());
    fs::remove_all(data);
  }
  RecordProperty("kills", killed);
  RecordProperty("interrupted_trials", interrupted);
  EXPECT_GT(interrupted, kills / 4);  // otherwise kills fell between trials only
}

// Staircases, positions of the standard and answers are restored from the log.
TEST_F(SessionTest, AMethodGoesOnAsIfItHadNotBeenKilled) {
  const std::string whole = scratch.file("whole"), data = scratch.file("data");
  ASSERT_EQ(program(runArguments(whole, kRub)), 0) << output;
  const Process process(runArguments(data, kRub), scratch.file("output"));
  awaitFirstTrial(data);
  process.kill(SIGKILL);
  process.wait();
  ASSERT_FALSE(logOf(data).complete);
  EXPECT_EQ(program({"experiment", "resume", data}), 0) << output;
  EXPECT_EQ(essence(logOf(data)), essence(logOf(whole)));
  EXPECT_THAT(validate(folderOf(data, "S01", 1)).findings, IsEmpty());
}

// Two studies of two subjects: the same command finds all of them complete; another experiment is refused.
TEST_F(SessionTest, SimulatedStudiesGoOnWithWhatIsThere) {
  const std::string out = scratch.file("studies");
  std::vector<std::string> arguments{"experiment", "simulate", kRub, "--subjects", "2", "--seeds", "2", "--out", out};
  ASSERT_EQ(program(arguments), 0) << output;
  EXPECT_THAT(output, HasSubstr("4 sessions complete, 0 of them before, 0 failed"));
  EXPECT_THAT(output, HasSubstr("scripted fingers: no person"));
  EXPECT_NE(essence(logOf(out + "/study-001")), essence(logOf(out + "/study-002")));
  EXPECT_THAT(contentsOf(out + "/power.csv"), HasSubstr("spearman_mu_felt_1"));
  EXPECT_THAT(contentsOf(out + "/power_curve.csv"), HasSubstr("1,\"spearman_mu_felt_1, all mu_s_1\","));
  EXPECT_THAT(contentsOf(out + "/power.html"), HasSubstr("Power over the number of subjects"));
  fs::remove_all(out + "/study-002/sub-S02");
  ASSERT_EQ(program(arguments), 0) << output;
  EXPECT_THAT(output, HasSubstr("4 sessions complete, 3 of them before, 0 failed"));
  arguments[2] = kLift;
  EXPECT_EQ(program(arguments), 2);
  EXPECT_THAT(output, HasSubstr("error[E951]"));
}

// The same studies with a setting of the rig's devices changed: each in a folder of its own, compared in one table.
TEST_F(SessionTest, SimulatedStudiesCompareSettingsOfTheDevices) {
  const std::string out = scratch.file("varied");
  std::vector<std::string> arguments{"experiment", "simulate", kRub,       "--subjects", "1", "--seeds",
                                     "1",          "--vary",   "mass=0.3", "--out",      out};
  ASSERT_EQ(program(arguments), 0) << output;
  EXPECT_THAT(output, HasSubstr("as the rig has it"));
  EXPECT_THAT(output, HasSubstr("mass=0.3"));
  EXPECT_THAT(contentsOf(out + "/variation-1/rig.xml"), HasSubstr("key=\"mass\" value=\"0.3\""));
  EXPECT_THAT(contentsOf(out + "/variation-0/rig.xml"), Not(HasSubstr("key=\"mass\"")));
  EXPECT_NE(essence(logOf(out + "/variation-0/study-001")), essence(logOf(out + "/variation-1/study-001")));
  EXPECT_THAT(contentsOf(out + "/variations.csv"), HasSubstr("\"mass=0.3\",\"spearman_mu_felt_1\""));
  EXPECT_THAT(contentsOf(out + "/variations.html"), HasSubstr("mass=0.3"));
  arguments[8] = "mass";
  EXPECT_EQ(program(arguments), 2);
  EXPECT_THAT(output, HasSubstr("error[E954]"));
  arguments[8] = "mas=0.3";
  EXPECT_EQ(program(arguments), 2);
  EXPECT_THAT(output, HasSubstr("error[E401]"));
}

TEST_F(SessionTest, ControlCKeepsWhatIsThere) {
  const std::string data = scratch.file("data");
  const Process process(runArguments(data), scratch.file("output"));
  awaitFirstTrial(data);
  process.kill(SIGINT);
  EXPECT_EQ(process.wait(), 130);
  EXPECT_THAT(contentsOf(scratch.file("output")), HasSubstr("continue with: presa experiment resume"));
  EXPECT_FALSE(logOf(data).complete);
  EXPECT_EQ(program({"experiment", "resume", data}), 0) << output;
  EXPECT_TRUE(logOf(data).complete);
}

// A finger's device stops sending while lifting: the trial is marked and comes again, and the message names the finger.
TEST_F(SessionTest, ALostDeviceEndsTheTrial) {
  const std::string rig = scratch.file("rig.xml"), data = scratch.file("data");
  const std::string motion = std::string(PRESA_SOURCE_DIR) + "/config/motions/pinch_cube.xml";
  std::ofstream(rig) << "<rig version=\"1.0\" name=\"desk\">\n"
                     << "<device role=\"thumb\" driver=\"scripted\"><set key=\"motion\" value=\"" << motion
                     << "\"/></device>\n<device role=\"index\" driver=\"scripted\"><set key=\"motion\" value=\""
                     << motion << "\"/><set key=\"lost_at\" value=\"2.5\"/></device>\n</rig>\n";
  std::vector<std::string> arguments = runArguments(data);
  arguments.insert(arguments.end(), {"--rig", rig});
  EXPECT_EQ(program(arguments), 1);
  EXPECT_THAT(output, HasSubstr("the device of 'index' gave no sample any more"));
  EXPECT_THAT(output, HasSubstr("the trial is marked and will be repeated: presa experiment resume"));
  const SessionLog log = logOf(data);
  ASSERT_EQ(log.runs.size(), 1U);
  EXPECT_EQ(log.runs[0].outcome, Outcome::kInterrupted);
  EXPECT_NEAR(log.runs[0].end["values"]["device_lost_s"].get<double>(), 0.1, 0.002);
  EXPECT_FALSE(log.complete);
  EXPECT_EQ(program({"experiment", "resume", data}), 1);  // not repaired: the same trial fails in a second run
  ASSERT_EQ(logOf(data).runs.size(), 2U);
  EXPECT_EQ(logOf(data).runs[0].end, log.runs[0].end);
}

TEST_F(SessionTest, ValidateFindsWhatWasTouched) {
  const std::string data = scratch.file("data");
  ASSERT_EQ(program(runArguments(data)), 0);
  const SessionFolder folder = folderOf(data, "S01", 1);
  std::fstream file(folder.file("trial-002_run-1.h5"), std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(100000);
  file.put('x');
  file.close();
  fs::remove(folder.file("trial-004_run-1.h5"));
  std::ofstream(folder.file("notes.txt")) << "mine";
  std::ofstream(folder.file("trials.csv"), std::ios::app) << " ";
  EXPECT_EQ(program({"experiment", "validate", data}), 1);
  EXPECT_THAT(output, HasSubstr("trial-002_run-1.h5: was changed"));
  EXPECT_THAT(output, HasSubstr("trial-004_run-1.h5: is missing"));
  EXPECT_THAT(output, HasSubstr("notes.txt: is not in the log"));
  EXPECT_THAT(output, HasSubstr("trials.csv: was changed"));
}

TEST_F(SessionTest, ForgetRemovesOneSubjectAndNoOther) {
  const std::string data = scratch.file("data");
  ASSERT_EQ(program(runArguments(data)), 0);
  std::vector<std::string> other = runArguments(data);
  other[4] = "S011";
  ASSERT_EQ(program(other), 0) << output;
  const auto before = allBytesOf(data + "/sub-S011");
  fs::create_directories(data + "/bids/sub-S01/beh");
  std::ofstream(data + "/bids/participants.tsv") << "participant_id\tage\nsub-S01\t30\nsub-S011\t40\n";
  EXPECT_EQ(program({"experiment", "forget", "--subject", "S01", "--data", data}), 2);
  EXPECT_TRUE(fs::exists(data + "/sub-S01"));
  EXPECT_EQ(program({"experiment", "forget", "--subject", "S01", "--data", data, "--yes"}), 0);
  EXPECT_THAT(output, HasSubstr("removed: 2 folders with"));
  EXPECT_FALSE(fs::exists(data + "/sub-S01"));
  EXPECT_FALSE(fs::exists(data + "/bids/sub-S01"));
  EXPECT_EQ(allBytesOf(data + "/sub-S011"), before);
  EXPECT_EQ(program({"experiment", "validate", data}), 0) << output;
  EXPECT_EQ(contentsOf(data + "/bids/participants.tsv"), "participant_id\tage\nsub-S011\t40\n");
}

// A file size limit stops writes as a full disk does, in the log and in a recording. Earlier data stay intact, and with
// room again the session continues to the same end.
TEST_F(SessionTest, AFullDiskStopsItAndItGoesOn) {
  const std::string whole = scratch.file("whole");
  ASSERT_EQ(program(runArguments(whole)), 0) << output;
  for (const bool recording : {false, true}) {
    const std::string data = scratch.file(recording ? "recording" : "log");
    const std::string limited = "trap '' XFSZ; ulimit -f " + std::string(recording ? "150" : "8") + "; exec " +
                                kProgram + " experiment run " + kLift + " --subject S01 --lockstep --data " + data +
                                (recording ? "" : " --no-recording") + " > " + scratch.file("output") + " 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system(("bash -c \"" + limited + "\"").c_str())), 1);
    EXPECT_THAT(contentsOf(scratch.file("output")), HasSubstr("File too large"));
    EXPECT_THAT(contentsOf(scratch.file("output")), HasSubstr("is complete up to there"));
    EXPECT_FALSE(logOf(data).complete);
    EXPECT_FALSE(validate(folderOf(data, "S01", 1)).altered);
    EXPECT_EQ(program({"experiment", "resume", data}), 0) << output;
    EXPECT_THAT(validate(folderOf(data, "S01", 1)).findings, IsEmpty());
    if (recording) {
      EXPECT_EQ(essence(logOf(data)), essence(logOf(whole)));
    }
  }
}

TEST_F(SessionTest, AFolderThatCannotBeMade) {
  std::ofstream(scratch.file("data")) << "a file";
  EXPECT_EQ(program(runArguments(scratch.file("data"))), 2);
  EXPECT_THAT(output, HasSubstr("error[E925]"));
}

TEST_F(SessionTest, NotAPseudonym) {
  EXPECT_EQ(program({"experiment", "dry-run", kLift, "--subject", "Anna Rossi"}), 2);
  EXPECT_THAT(output, HasSubstr("error[E910]"));
  EXPECT_EQ(program({"experiment", "dry-run", kLift, "--subject", "Anna"}), 2);
  EXPECT_THAT(output, HasSubstr("error[E911]"));
}

}  // namespace
}  // namespace presa::experiment
