#include "apps/experiment/forget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/journal.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "tests/apps/experiment/contents.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

/// Two subjects, an export of each kind, and a folder beside the dataset.
class ForgetTest : public testing::Test {
 protected:
  ForgetTest() {
    for (const char* subject : {"S01", "S02"}) {
      const std::string session = data + "/sub-" + subject + "/ses-1";
      write(session + "/trials.csv", std::string("subject,reason\n") + subject + ",\"dropped\nS01,twice\"\n");
      Journal::create(session + "/journal.jsonl").append({{"event", "start"}, {"subject", subject}});
      write(data + "/bids/sub-" + subject + "/ses-1/beh/x_beh.tsv", "trial\tF\n1\t2\n");
      write(data + "/csv/timeseries/sub-" + subject + "_ses-1_trial-001_run-1.csv", "time [s]\n0\n");
    }
    write(data + "/bids/participants.tsv", "participant_id\tnumber\nsub-S01\t1\nsub-S02\t2\n");
    write(data + "/csv/trials.csv", "subject,reason\nS01,\"a\nS02,b\"\nS02,\"c\nS01,d\"\nS02,end\n");
    write(data + "/analysis/report.html", "<td>S01</td>");
    write(data + "/analysis/notes.txt", "S010 and XS01 are others");
    write(outside + "/sub-S01/private.txt", "S01");
    write(outside + "/table.csv", "subject\nS01\n");
  }
  static void write(const std::string& file, const std::string& text) {
    fs::create_directories(fs::path(file).parent_path());
    std::ofstream(file, std::ios::binary) << text;
  }
  ScratchFolder scratch;
  const std::string data = scratch.file("data"), outside = scratch.file("outside");
};

TEST_F(ForgetTest, RemovesSessionsExportsAndRows) {
  const Traces traces = tracesOf(data, "S01");
  EXPECT_EQ(traces.folders.size(), 2U);
  EXPECT_EQ(traces.files_in_folders, 3U);
  EXPECT_THAT(traces.files, ElementsAre(data + "/csv/timeseries/sub-S01_ses-1_trial-001_run-1.csv"));
  EXPECT_THAT(traces.mentions, ElementsAre(data + "/analysis/report.html"));
  forget(traces, "S01");
  EXPECT_TRUE(tracesOf(data, "S01").empty());
  EXPECT_EQ(contentsOf(data + "/bids/participants.tsv"), "participant_id\tnumber\nsub-S02\t2\n");
  // a row is a record, not a line: the reason in S02's first row contains a line that begins with S01
  EXPECT_EQ(contentsOf(data + "/csv/trials.csv"), "subject,reason\nS02,\"c\nS01,d\"\nS02,end\n");
}

TEST_F(ForgetTest, LeavesTheOthersBitByBit) {
  const auto session = allBytesOf(data + "/sub-S02"), bids = allBytesOf(data + "/bids/sub-S02");
  forget(tracesOf(data, "S01"), "S01");
  EXPECT_EQ(allBytesOf(data + "/sub-S02"), session);
  EXPECT_EQ(allBytesOf(data + "/bids/sub-S02"), bids);
}

TEST_F(ForgetTest, RemovesALinkNeverItsTarget) {
  const auto before = allBytesOf(outside);
  fs::create_directory_symlink(outside + "/sub-S01", data + "/bids/sub-S01/link");
  fs::create_directories(data + "/more");
  fs::create_directory_symlink(outside + "/sub-S01", data + "/more/sub-S01");
  fs::create_directory_symlink(outside, data + "/linked");
  fs::create_symlink(outside + "/table.csv", data + "/linked.csv");
  const Traces traces = tracesOf(data, "S01");
  EXPECT_THAT(traces.links, ElementsAre(data + "/more/sub-S01"));
  forget(traces, "S01");
  EXPECT_EQ(allBytesOf(outside), before);
  EXPECT_FALSE(fs::is_symlink(data + "/more/sub-S01"));
  EXPECT_TRUE(fs::is_symlink(data + "/linked.csv"));
}

TEST_F(ForgetTest, NotWhileTheSessionIsBeingRun) {
  const Journal running = Journal::hold(data + "/sub-S01/ses-1/journal.jsonl");
  const auto before = allBytesOf(data);
  EXPECT_THROW(forget(tracesOf(data, "S01"), "S01"), InputError);
  EXPECT_EQ(allBytesOf(data), before);
}

TEST_F(ForgetTest, TheFolderOfTheSubjectItself) {
  EXPECT_THAT(tracesOf(data + "/sub-S01/", "S01").folders, ElementsAre(data + "/sub-S01/"));
  EXPECT_TRUE(tracesOf(data + "/sub-S02", "S01").empty());
}

TEST_F(ForgetTest, ANumberIsNoPseudonym) { EXPECT_THAT(tracesOf(data, "1").mentions, IsEmpty()); }

}  // namespace
}  // namespace presa::experiment
