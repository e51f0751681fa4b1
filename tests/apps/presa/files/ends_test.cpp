#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/presa/files/program.h"

// How the program ends on outside events: signals, closed or full outputs.
namespace presa {
namespace {

namespace fs = std::filesystem;
using test::Bench;
using test::kProgram;
using test::Outcome;

const std::string kCube = test::kSource + "/config/scenes/cube.xml";
const std::string kLift = test::kSource + "/tests/apps/experiment/fixtures/lift.xml";

/// Sends a signal once the run has installed its handlers. A command that runs ten seconds longer is killed (status
/// 137).
Outcome signalled(const Bench& bench, const std::string& signal, const std::string& arguments) {
  return bench.shell(
      kProgram + " " + arguments +
      " & run=$!; for i in $(seq 600); do caught=$(awk '/SigCgt/ {print $2}' /proc/$run/status); "
      "[ $((0x$caught & 0x4000)) -ne 0 ] && break; sleep 0.1; done; sleep 1; kill -" +
      signal + " $run; (sleep 10; kill -KILL $run) & killer=$!; wait $run; status=$?; kill $killer; exit $status");
}

// With each of these signals (HUP: a closed terminal) the recording is completed and the summary written.
TEST(Signal, EndsARunWithAllItsFiles) {
  for (const std::string signal : {"INT", "TERM", "HUP"}) {
    const Bench bench;
    const Outcome outcome =
        signalled(bench, signal,
                  "run " + kCube + " --realtime --view none --quiet --for 600 --record run.h5 --summary summary.json");
    EXPECT_EQ(outcome.status, 130) << signal << outcome.text;
    ASSERT_TRUE(fs::exists(bench.file("summary.json"))) << signal;
    EXPECT_EQ(nlohmann::json::parse(contentsOf(bench.file("summary.json"))).at("interrupted"), true);
    EXPECT_TRUE(recordPlugin().read(bench.file("run.h5")).complete) << signal;
  }
}

TEST(Signal, OfAClosedTerminalIsIgnoredUnderNohup) {
  const Bench bench;
  const Outcome outcome = bench.shell("trap '' HUP; " + kProgram + " run " + kCube +
                                      " --realtime --view none --quiet --for 2 & sleep 1; kill -HUP $!; wait $!");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
}

/// 256 boxes in one place: each dynamics step takes a third of a second or more.
std::string coincidentBoxes() {
  std::string text =
      "<scene version=\"1.0\" name=\"heap\"><world gravity=\"0 0 -9.81\"/><materials><material name=\"a\" "
      "stiffness=\"1000\" damping=\"1\"/></materials>";
  for (int i = 0; i < 256; ++i)
    text += "<body name=\"b" + std::to_string(i) +
            "\" pos=\"0 0 1\"><physics mass=\"1\"><box size=\"0.1 0.1 0.1\"/></physics></body>\n";
  return text + "</scene>";
}

// The signal does not wait for the force fade-out: a run stuck in a long step exits without its summary.
TEST(Signal, EndsARunInTheMiddleOfALongStep) {
  for (const std::string signal : {"INT", "TERM", "HUP"}) {
    const Bench bench;
    bench.write("scene.xml", coincidentBoxes());
    const Outcome outcome = signalled(bench, signal, "run scene.xml --lockstep --quiet --for 1000");
    EXPECT_EQ(outcome.status, 130) << signal << outcome.text;
  }
}

// Files opened by the program never replace a standard stream that was closed at the start.
TEST(Streams, ThatComeClosedAreNoFiles) {
  for (const std::string closed : {"2>&-", ">&-", "<&- >&- 2>&-"}) {
    const Bench bench;
    const Outcome run =
        bench.presa("experiment run " + kLift + " --subject S01 --lockstep --no-recording --data data " + closed);
    // with standard output closed, its last line is lost, which is reported
    EXPECT_EQ(run.status, closed == "2>&-" ? 0 : 1) << closed << run.text;
    const Outcome validated = bench.presa("experiment validate data");
    EXPECT_EQ(validated.status, 0) << closed << validated.text;
  }
}

// The status line of a run whose standard error was closed at the start.
TEST(Streams, ClosedStandardErrorIsNoRecording) {
  const Bench bench;
  const Outcome run = bench.presa("run " + kCube + " --realtime --view none --for 3 --record run.h5 2>&-");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(bench.presa("replay run.h5 --verify").status, 0);
}

TEST(FullDisk, OfStandardOutputIsAnError) {
  const Bench bench;
  for (const std::string& command : {"check " + kCube, "check --format json " + kCube, "explain " + kCube,
                                     "experiment dry-run " + kLift, "experiment dry-run --format json " + kLift}) {
    const Outcome outcome = bench.presa(command + " > /dev/full");
    EXPECT_EQ(outcome.status, 1) << command;
    EXPECT_NE(outcome.text.find("standard output could not be written: No space left on device"), std::string::npos)
        << command << outcome.text;
  }
}

// A file-size limit acts like a full disk.
TEST(FullDisk, OfReportSummaryAndExportIsAnError) {
  const Bench bench;
  const std::string limited = "ulimit -f 4; exec timeout 60 " + kProgram + " ";
  for (const std::string option : {"--report report.html", "--summary summary.json"}) {
    const Outcome outcome = bench.shell((option.starts_with("--s") ? "ulimit -f 1; exec " + kProgram + " " : limited) +
                                        "run " + kCube + " --lockstep --quiet --for 1 " + option);
    EXPECT_EQ(outcome.status, 1) << option << outcome.text;
    EXPECT_NE(outcome.text.find("File too large"), std::string::npos) << option << outcome.text;
    EXPECT_FALSE(fs::exists(bench.file(option.substr(option.find(' ') + 1)))) << "half a file";
  }
  ASSERT_EQ(bench.presa("experiment run " + kLift + " --subject S01 --lockstep --data data").status, 0);
  const Outcome exported = bench.shell(limited + "experiment export data --csv csv");
  EXPECT_EQ(exported.status, 1) << exported.text;
  EXPECT_NE(exported.text.find("File too large"), std::string::npos) << exported.text;
  EXPECT_FALSE(fs::exists(bench.file("csv")));
}

TEST(FullDisk, OfAScreenshotIsAnError) {
  const Bench bench;
  const Outcome outcome =
      bench.shell("ulimit -f 4; exec timeout 60 " + kProgram + " run " + kCube +
                  " --lockstep --quiet --for 0.1 --view offscreen --screenshot-at 0.05 --screenshot shot.png");
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  EXPECT_FALSE(fs::exists(bench.file("shot.png"))) << "half a picture";
}

// With an unreadable log it is unknown whether a session remains.
TEST(Resume, OfAnUnreadableLogIsAnError) {
  const Bench bench;
  bench.write("data/sub-S01/ses-1/journal.jsonl", "{\"damaged\"\n");
  const Outcome outcome = bench.presa("experiment resume data");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_EQ(outcome.text.find("no session is left"), std::string::npos) << outcome.text;
}

}  // namespace
}  // namespace presa
