#include "apps/experiment/dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/inputs.h"
#include "apps/experiment/session.h"
#include "experiments/runner/definition/read.h"
#include "framework/record/checksum/checksum.h"
#include "tests/apps/experiment/contents.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

void write(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// A session's folder with a handwritten log and files, without a run.
class VerdictTest : public testing::Test {
 protected:
  VerdictTest() {
    write(folder.file("experiment.xml"), "<experiment/>");
    SessionStart start;
    start.subject = {"S01", 1};
    Json record = toJson(start);
    record["sha256"]["experiment.xml"] = sha256OfFile(folder.file("experiment.xml"));
    journal.append(record);
  }
  void trial(int number, int attempt, const char* outcome, const char* reason = "", const char* excluded = "") {
    const std::string file = "trial-" + std::to_string(number) + "_run-" + std::to_string(attempt) + ".h5";
    write(folder.file(file), "rows");
    journal.append({{"event", "trial_begin"},
                    {"trial", number},
                    {"attempt", attempt},
                    {"run", attempt},
                    {"practice", false},
                    {"files", {file}}});
    journal.append({{"event", "trial_end"},
                    {"outcome", outcome},
                    {"reason", reason},
                    {"excluded", excluded},
                    {"sha256", {{file, sha256OfFile(folder.file(file))}}}});
  }
  ScratchFolder scratch;
  const SessionFolder folder{scratch.path().string()};
  Journal journal = Journal::create(folder.journal());
};

// A trial that was given up is data: the session is valid, with a note on the trial.
TEST_F(VerdictTest, TellsOfTrialsGivenUpAndExcluded) {
  trial(1, 1, "done");
  trial(2, 1, "aborted", "dropped");
  trial(2, 2, "aborted", "dropped");
  trial(3, 1, "done", "", "not held");
  trial(4, 1, "aborted", "dropped");
  trial(4, 2, "done");
  trial(5, 1, "aborted", "dropped");
  journal.append({{"event", "end"}});
  const Verdict verdict = validate(folder);
  EXPECT_THAT(verdict.findings, IsEmpty());
  EXPECT_FALSE(verdict.altered);
  EXPECT_THAT(verdict.notes, ElementsAre("excluded, not held: trial 3", "given up, dropped: trial 2 5"));
  EXPECT_EQ(verdict.trials, 2U);
  EXPECT_EQ(verdict.runs, 7U);
  EXPECT_EQ(verdict.seal, Journal::read(folder.journal()).sum);
}

TEST_F(VerdictTest, UnfinishedIsNotAltered) {
  trial(1, 1, "aborted", "dropped");
  EXPECT_THAT(validate(folder).findings, ElementsAre(HasSubstr("not finished")));
  EXPECT_THAT(validate(folder).notes, IsEmpty());  // no note: the trial comes again
  EXPECT_FALSE(validate(folder).altered);
  write(folder.file("notes.txt"), "mine");
  EXPECT_FALSE(validate(folder).altered);
  write(folder.file("trial-1_run-1.h5"), "other");
  EXPECT_TRUE(validate(folder).altered);
}

/// An experiment whose rig names a motion and whose scene names a mesh per level.
class InputsTest : public testing::Test {
 protected:
  InputsTest() {
    const fs::path config = fs::path(PRESA_SOURCE_DIR) / "config";
    fs::copy_file(config / "meshes/amphora.obj", scratch.file("amphora.obj"));
    fs::copy_file(config / "meshes/amphora.obj", scratch.file("other.obj"));
    fs::copy_file(config / "motions/pinch_cube.xml", scratch.file("pinch.xml"));
    write(
        scratch.file("rig.xml"),
        R"(<rig version="1.0" name="r"><device role="thumb" driver="scripted"><set key="motion" value="pinch.xml"/></device>
             <device role="index" driver="scripted"><set key="motion" value="pinch.xml"/></device></rig>)");
    write(scratch.file("scene.xml"), R"(<scene version="1.0" name="s"><world gravity="0 0 -9.81"/>
      <materials><material name="clay" stiffness="1000"/></materials>
      <body name="jar" fixed="true"><haptic><mesh file="amphora.obj"/></haptic></body>
      <devices><device role="thumb"/><device role="index"/></devices></scene>)");
    write(scratch.file("experiment.xml"),
          R"xml(<experiment version="1.0" name="e" scene="scene.xml" rig="rig.xml" title="t">
      <factor name="jar"><column name="jar" path="body/jar/haptic/mesh/file"/>
        <level values="amphora.obj"/><level values="other.obj"/></factor>
      <design/><phase name="hold" seconds="1"/><measure name="held" unit="s" value="seconds(hold)"/></experiment>)xml");
  }
  Experiment read() const {
    Diagnostics diagnostics;
    auto experiment = readExperiment(scratch.file("experiment.xml"), "", diagnostics);
    EXPECT_EQ(diagnostics.text(), "");
    return std::move(experiment).value();
  }
  std::string resumed(const SessionFolder& folder) const {
    try {
      const Experiment experiment = read();
      SubjectSession::resume(experiment, folder);
    } catch (const InputError& error) {
      return error.diagnostics().text();
    }
    return "goes on";
  }
  ScratchFolder scratch;
};

TEST_F(InputsTest, EveryFileOfEveryConditionIsInTheLog) {
  const Json sums = inputSums(read(), 1);
  ASSERT_EQ(sums.size(), 3U);
  for (const char* name : {"amphora.obj", "other.obj", "pinch.xml"})
    EXPECT_EQ(sums.at(name), sha256OfFile(scratch.file(name)));
}

TEST_F(InputsTest, ASessionGoesOnWithTheFilesItBeganWith) {
  SessionFolder folder;
  {
    const Experiment experiment = read();
    folder = SubjectSession::begin(experiment, {scratch.file("experiment.xml"), "", {"S01", 1}}, scratch.file("data"))
                 .folder();
  }
  EXPECT_EQ(resumed(folder), "goes on");
  const std::string motion = contentsOf(scratch.file("pinch.xml"));
  write(scratch.file("pinch.xml"), motion + "<!-- -->");
  std::ofstream(scratch.file("other.obj"), std::ios::app) << "# scratched\n";
  const std::string refusal = resumed(folder);
  EXPECT_THAT(refusal, HasSubstr(scratch.file("pinch.xml") + ": error[E936]"));
  EXPECT_THAT(refusal, HasSubstr(scratch.file("other.obj") + ": error[E936]"));
  EXPECT_THAT(refusal, testing::Not(HasSubstr("amphora")));
}

}  // namespace
}  // namespace presa::experiment
