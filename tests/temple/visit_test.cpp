// A visit that is killed goes on with what stood.
#include "apps/presa/temple/visit.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/math/random.h"
#include "tests/temple/support.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;

KeptSession someSession() {
  KeptSession kept{
      .size = "column", .parameters = "", .seed = 9007199254740993, .spent = 12.3, .placed = 2, .X_WB = {}};
  for (int i = 0; i < 6; ++i)
    kept.X_WB.push_back({{0.1 * i, 1.0 / 3, -0.2}, Quat(Eigen::AngleAxisd(0.3 * i, Vec3(1, 2, 3).normalized()))});
  return kept;
}

TEST(KeptSession, ComesBackToTheBit) {
  const std::string file = test::scratch("kept") + "/session.json";
  const KeptSession kept = someSession();
  std::ofstream(file) << keptText(kept);
  Diagnostics diagnostics;
  const std::optional<KeptSession> read = readKept(file, diagnostics);
  ASSERT_TRUE(read) << diagnostics.text();
  EXPECT_EQ(read->seed, kept.seed);
  EXPECT_EQ(read->placed, 2);
  EXPECT_EQ(read->spent, kept.spent);
  ASSERT_EQ(read->X_WB.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(read->X_WB[i].p, kept.X_WB[i].p);
    EXPECT_EQ(read->X_WB[i].q.coeffs(), kept.X_WB[i].q.coeffs());
  }
}

// Every prefix of the file, and poses that are none.
TEST(KeptSession, IsReadWholeOrNotAtAll) {
  const std::string file = test::scratch("broken") + "/session.json", text = keptText(someSession());
  for (std::size_t length = 0; length + 3 < text.size(); length += 7) {
    std::ofstream(file) << text.substr(0, length);
    Diagnostics diagnostics;
    EXPECT_FALSE(readKept(file, diagnostics)) << length;
    ASSERT_EQ(diagnostics.errorCount(), 1U);
    EXPECT_EQ(diagnostics.all().front().code, 967);
  }
  KeptSession bent = someSession();
  bent.X_WB[3].q.coeffs() *= 2;
  std::ofstream(file) << keptText(bent);
  Diagnostics diagnostics;
  EXPECT_FALSE(readKept(file, diagnostics));
  EXPECT_FALSE(readKept(file + ".none", diagnostics));
}

/// The program in a process of its own.
pid_t start(const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child != 0) return child;
  const std::string program = PRESA_BINARY_DIR "/bin/presa";
  std::vector<char*> all{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) all.push_back(const_cast<char*>(argument.c_str()));
  all.push_back(nullptr);
  if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    _exit(126);
  execv(program.c_str(), all.data());
  _exit(127);
}

int await(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Lines of the log with that event.
int count(const std::string& folder, const std::string& event) {
  std::ifstream stream(logFile(folder));
  int lines = 0;
  for (std::string line; std::getline(stream, line);) lines += nlohmann::json::parse(line).at("event") == event ? 1 : 0;
  return lines;
}

// Killed whenever another block stands, and at moments in between: every process goes on with at least what stood, until all does.
TEST(Visit, KilledAtAnyMomentItGoesOnWithWhatStood) {
  const std::string folder = test::scratch("killed");
  std::vector<std::string> arguments{"temple", "--auto", "--lockstep", "--seed", "7", "--session", folder};
  RandomStream random(3, "kills");
  int stood = 0, kills = 0, went_on = 0;
  for (bool ended = false; !ended && kills < 60;) {
    const pid_t child = start(arguments);
    // as long as a machine of any speed needs to place another one, then a moment longer
    int status = -1, waited = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
      Diagnostics diagnostics;
      if (kills < 8 && fs::exists(sessionFile(folder))) {
        const auto kept = readKept(sessionFile(folder), diagnostics);
        ASSERT_TRUE(kept) << diagnostics.text();
        if (kept->placed > stood || ++waited > 400) break;
      }
      usleep(2000);
    }
    if (WIFEXITED(status) && status != -1) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      break;
    }
    usleep(static_cast<useconds_t>(random.uniform(0, 60e3)));
    kill(child, SIGKILL);
    ended = await(child) == 0;
    ++kills;
    Diagnostics diagnostics;
    const auto kept = readKept(sessionFile(folder), diagnostics);
    if (ended || !kept) break;
    EXPECT_GE(kept->placed, stood);
    stood = kept->placed;
    if (!arguments.empty() && arguments.back() != "--continue")
      arguments = {"temple", "--auto", "--lockstep", "--session", folder, "--continue"};
    ++went_on;
  }
  EXPECT_GE(went_on, 2);
  EXPECT_EQ(count(folder, "finished"), 1);
  EXPECT_FALSE(fs::exists(sessionFile(folder))) << "nothing is left to go on with";
}

}  // namespace
}  // namespace presa::temple
