// The participant's window under an X server of its own: open before the first trial, and answers typed into it count.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <tuple>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/dataset.h"
#include "apps/experiment/session_log.h"
#include "tests/apps/experiment/contents.h"

namespace presa::experiment {
namespace {

const std::string kCommand = std::string(PRESA_BINARY_DIR) + "/bin/presa";
const std::string kAsking = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/ask.xml";

TEST(ParticipantWindow, OpensBeforeTheFirstTrialAndTakesTheAnswer) {
  const ScratchFolder scratch;
  const std::string data = scratch.file("data"), journal = folderOf(data, "S01", 1).journal();
  std::ofstream(scratch.file("rig.xml")) << "<rig version=\"1.0\" name=\"desk\">"
                                            "<device role=\"index\" driver=\"pointer\"/></rig>";
  std::ofstream(scratch.file("people.sh"))
      // The pointer stands outside of both windows, so that none takes the focus: xdotool sends keys to a window without
      // the focus alone. A key that is pressed for the focus is also seen by a window that comes under the pointer.
      << "xdotool mousemove 1399 899 sleep 250 & pointer=$!; sleep 1\n"
      << kCommand << " experiment run " << kAsking << " --rig " << scratch.file("rig.xml")
      << " --subject S01 --operator window --window --data " << data << " & presa=$!\n"
      << "participant=$(timeout 60 xdotool search --sync --onlyvisible --name '^Presa$')\n"
      << "operator=$(timeout 60 xdotool search --sync --onlyvisible --name operator)\n"
      << "grep -c trial_begin " << journal << " > " << scratch.file("trials_before")
      << "\n"
      // what the participant types before the question is no answer and stops nothing
      << "xdotool key --window $participant q 2\n"
      << "for i in $(seq 60); do xdotool key --window $operator space\n"
      << "sleep 0.5; grep -q trial_begin " << journal << " && break; done\n"
      << "for i in $(seq 120); do xdotool key --window $participant 2\n"
      << "sleep 0.5; grep -q trial_end " << journal << " && break; done\n"
      << "while kill -0 $presa 2> /dev/null; do xdotool key --window $operator q; sleep 0.5; done\n"
      << "kill $pointer; wait $presa; echo $? > " << scratch.file("status") << "\n";
  // ignore the status: xvfb-run also fails when it cannot clean up
  std::ignore = std::system(("timeout 200 xvfb-run -a -s '-screen 0 1400x900x24' bash " + scratch.file("people.sh") +
                             " > " + scratch.file("log") + " 2>&1")
                                .c_str());
  EXPECT_EQ(contentsOf(scratch.file("status")), "130\n") << contentsOf(scratch.file("log"));
  EXPECT_EQ(contentsOf(scratch.file("trials_before")), "0\n");
  const auto records = Journal::read(journal).records;
  const auto end = std::ranges::find_if(records, [](const auto& r) { return r.at("event") == "trial_end"; });
  ASSERT_NE(end, records.end()) << contentsOf(scratch.file("log"));
  EXPECT_EQ(end->at("outcome"), "done") << *end;
  EXPECT_EQ(end->at("response").at("chosen"), 2) << *end;
}

}  // namespace
}  // namespace presa::experiment
