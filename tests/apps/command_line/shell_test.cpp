#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "apps/common/file_text.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using test::scratch;
using test::shell;
using test::source;
using testing::HasSubstr;
using testing::Not;

/// What bash offers for the last of these words.
std::string completed(const std::string& words) {
  return shell("bash -c 'source " + source("config/shell/presa.bash") + "; COMP_WORDS=(" PRESA_BINARY_DIR "/bin/" +
               words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _presa; printf \"%s \" \"${COMPREPLY[@]}\"'")
      .out;
}

// Completion knows the commands and options that the program itself lists.
TEST(Shell, CompletesCommandsAndOptions) {
  EXPECT_EQ(completed("presa exp"), "explain experiment ");
  EXPECT_EQ(completed("presa device doc"), "doctor ");
  EXPECT_THAT(completed("presa run config/scenes/cube.xml --lo"), HasSubstr("--lockstep"));
  EXPECT_THAT(completed("presa experiment run --sim"), HasSubstr("--simulated"));
  EXPECT_THAT(completed("presa run --no-such-option"), Not(HasSubstr("--lockstep")));
}

// There is a page for every command; what it says is what --help says.
TEST(Shell, WritesAManPageOfEveryCommand) {
  const std::string folder = scratch("man");
  const auto made = shell(source("config/shell/man_pages.sh") + " " PRESA_BINARY_DIR "/bin/presa " + folder + " 1.2.3");
  ASSERT_EQ(made.status, 0) << made.err;
  for (const char* page : {"presa.1", "presa-run.1", "presa-device-doctor.1", "presa-experiment-analyse.1"})
    EXPECT_TRUE(std::filesystem::exists(folder + "/" + page)) << page;
  const std::string run = contentsOf(folder + "/presa-run.1");
  EXPECT_THAT(run, HasSubstr(".TH \"PRESA-RUN\" 1 \"\" \"Presa 1.2.3\""));
  EXPECT_THAT(run, HasSubstr("presa-run \\- Run a scene, live or as fast as the machine goes"));
  EXPECT_THAT(run, HasSubstr("\\-\\-lockstep"));
}

}  // namespace
}  // namespace presa
