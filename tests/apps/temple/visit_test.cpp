// A killed visit can be continued with the blocks that were placed.
#include "apps/temple/visit.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "framework/core/math/random.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;

KeptSession someSession() {
  KeptSession kept{
      .size = "column", .parameters = "", .seed = 9007199254740993, .elapsed = 12.3, .placed = 2, .X_WB = {}};
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
  EXPECT_EQ(read->elapsed, kept.elapsed);
  ASSERT_EQ(read->X_WB.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(read->X_WB[i].p, kept.X_WB[i].p);
    EXPECT_EQ(read->X_WB[i].q.coeffs(), kept.X_WB[i].q.coeffs());
  }
}

// Every truncated file is refused, and so are invalid poses.
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

/// Starts the program in a separate process.
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

/// Number of lines of the log with this event.
int count(const std::string& folder, const std::string& event) {
  std::ifstream stream(logFile(folder));
  int lines = 0;
  for (std::string line; std::getline(stream, line);) lines += nlohmann::json::parse(line).at("event") == event ? 1 : 0;
  return lines;
}

/// Waits for the end of the process, with a time limit.
bool endsWithin(pid_t child, int milliseconds) {
  const int process = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  pollfd end{process, POLLIN, 0};
  const bool ended = poll(&end, 1, milliseconds) == 1;
  close(process);
  return ended;
}

/// Waits until the saved session has more blocks than `stood` or has existed for 0.8 s; true: the process ended before.
bool endsBeforeMoreStands(pid_t child, const std::string& folder, int stood) {
  for (int looks = 0; looks < 400; looks += fs::exists(sessionFile(folder)) ? 1 : 0) {
    if (endsWithin(child, 2)) return true;
    if (!fs::exists(sessionFile(folder))) continue;
    Diagnostics diagnostics;
    const auto kept = readKept(sessionFile(folder), diagnostics);
    if (kept && kept->placed > stood) return false;
  }
  return false;
}

// Killed up to eight times, at a random moment after another block was placed: every process continues with at least
// the blocks placed before, until all are. A finished visit deletes its session.
TEST(Visit, KilledAtAnyMomentItGoesOnWithWhatStood) {
  const std::string folder = test::scratch("killed");
  std::vector<std::string> arguments{"temple", "--auto", "--lockstep", "--seed", "7", "--session", folder};
  RandomStream random(3, "kills");
  int stood = 0, went_on = 0;
  bool finished = false;
  for (int kills = 0; kills < 8 && !finished; ++kills) {
    const pid_t child = start(arguments);
    const auto later = static_cast<int>(random.uniform(0, 60));
    if (!endsBeforeMoreStands(child, folder, stood) && !endsWithin(child, later)) kill(child, SIGKILL);
    const int status = await(child);
    EXPECT_TRUE(status == 0 || status == 128 + SIGKILL) << status;
    finished = !fs::exists(sessionFile(folder));
    if (finished) continue;
    Diagnostics diagnostics;
    const auto kept = readKept(sessionFile(folder), diagnostics);
    ASSERT_TRUE(kept) << diagnostics.text();
    EXPECT_GE(kept->placed, stood);
    stood = kept->placed;
    ++went_on;
    arguments = {"temple", "--auto", "--lockstep", "--session", folder, "--continue"};
  }
  EXPECT_GE(went_on, 2);
  if (!finished) {
    EXPECT_EQ(await(start(arguments)), 0);
  }
  EXPECT_EQ(count(folder, "finished"), 1);
  EXPECT_FALSE(fs::exists(sessionFile(folder)));
}

}  // namespace
}  // namespace presa::temple
