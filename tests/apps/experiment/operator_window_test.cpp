#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/dataset.h"
#include "apps/experiment/session_log.h"
#include "tests/apps/experiment/contents.h"

// The operator's window under its own X server, with keys sent through the server.
namespace presa::experiment {
namespace {

const std::string kPresa = std::string(PRESA_BINARY_DIR) + "/bin/presa";
const std::string kLiftFile = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/lift.xml";

TEST(OperatorWindow, TakesANoteAndStops) {
  const ScratchFolder scratch;
  const std::string data = scratch.file("data");
  std::ofstream(scratch.file("operator.sh"))
      << kPresa << " experiment run " << kLiftFile << " --subject S01 --operator window --data " << data << " &\n"
      << "timeout 60 xdotool search --sync --onlyvisible --name operator\n"
      // keys sent before the window is mapped are lost: repeat until the note is in the log
      << "for i in $(seq 40); do xdotool key Escape n; xdotool type --delay 20 'hand was cold'; xdotool key Return\n"
      << "sleep 0.5; grep -q 'hand was cold' " << folderOf(data, "S01", 1).journal() << " && break; done\n"
      << "xdotool key q\n"
      << "wait $!; echo $? > " << scratch.file("status") << "\n";
  // ignore the status: xvfb-run also fails when it cannot clean up
  std::ignore = std::system(("timeout 120 xvfb-run -a -s '-screen 0 1400x900x24' bash " + scratch.file("operator.sh") +
                             " > " + scratch.file("log") + " 2>&1")
                                .c_str());
  EXPECT_EQ(contentsOf(scratch.file("status")), "130\n") << contentsOf(scratch.file("log"));
  const auto records = Journal::read(folderOf(data, "S01", 1).journal()).records;
  EXPECT_TRUE(std::any_of(records.begin(), records.end(), [](const auto& record) {
    return record.at("event") == "note" && record.at("text") == "hand was cold";
  }));
  EXPECT_EQ(records.back().at("reason"), "stopped by the operator");
}

TEST(OperatorWindow, WithoutADisplay) {
  const ScratchFolder scratch;
  const int status = std::system(("env -u DISPLAY " + kPresa + " experiment run " + kLiftFile +
                                  " --subject S01 --operator window --data " + scratch.file("data") + " > " +
                                  scratch.file("log") + " 2>&1")
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(contentsOf(scratch.file("log")),
              testing::AllOf(testing::HasSubstr("error[E703]: cannot open a window: DISPLAY is not set"),
                             testing::HasSubstr("presa experiment resume")));
}

}  // namespace
}  // namespace presa::experiment
