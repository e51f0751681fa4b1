#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "tests/apps/support/support.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using test::scratch;
using test::source;

/// `presa run` in real time as a child process, inspected from outside while it runs.
class RunningChild {
 public:
  explicit RunningChild(const std::vector<std::string>& options) {
    std::vector<std::string> words{
        std::string(PRESA_BINARY_DIR) + "/bin/presa", "run", "--realtime", "--quiet", "--view", "none", "--for", "60"};
    words.insert(words.end(), options.begin(), options.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (::posix_spawn(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) pid_ = 0;
  }
  ~RunningChild() {
    if (pid_ == 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  RunningChild(const RunningChild&) = delete;
  RunningChild& operator=(const RunningChild&) = delete;

  /// Waits until its haptic thread has slept between ticks several times: all groups have started by then. False when
  /// the child ended before that.
  bool waitUntilItRuns() const {
    while (pid_ != 0 && ::waitpid(pid_, nullptr, WNOHANG) == 0) {
      if (hapticSleeps() >= 50) return true;
      std::this_thread::yield();
    }
    return false;
  }
  std::set<std::string> threads() const {
    std::set<std::string> names;
    std::error_code gone;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task", gone)) {
      std::string name;
      std::getline(std::ifstream(task.path() / "comm") >> std::ws, name);
      names.insert(name);
    }
    return names;
  }
  std::string maps() const {
    std::stringstream text;
    text << std::ifstream("/proc/" + std::to_string(pid_) + "/maps").rdbuf();
    return text.str();
  }

 private:
  long hapticSleeps() const {
    std::error_code gone;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task", gone)) {
      std::ifstream status(task.path() / "status");
      bool haptic = false;
      for (std::string line; std::getline(status, line);) {
        if (line == "Name:\tpresa-haptic") haptic = true;
        if (haptic && line.starts_with("voluntary_ctxt_switches:")) return std::stol(line.substr(24));
      }
    }
    return 0;
  }

  pid_t pid_ = 0;
};

std::string fixedScene() {
  const std::string scene = scratch("fixed.xml");
  std::ofstream(scene) << R"(<scene version="1.0" name="fixed" rig=")" << source("config/rigs/hover.xml") << R"(">
    <world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="2000"/></materials>
    <body name="table" fixed="true"><haptic><box size="1 1 0.02"/></haptic></body>
    <devices><device role="thumb"/><device role="index"/></devices></scene>)";
  return scene;
}

// Fixed objects only: no dynamics thread and no libode; no mesh and no free body: no libfcl; no view: no libosg; no
// recording: no libhdf5. Read from /proc of the running process.
TEST(RunningProcess, HasOnlyTheThreadsAndLibrariesOfItsScene) {
  const RunningChild child({fixedScene()});
  ASSERT_TRUE(child.waitUntilItRuns());
  EXPECT_FALSE(child.threads().contains("presa-dynamics"));
  EXPECT_FALSE(child.threads().contains("presa-collision"));
  EXPECT_FALSE(child.threads().contains("presa-view"));
  const std::string maps = child.maps();
  EXPECT_NE(maps.find("presa_haptics_proxy.so"), std::string::npos);
  for (const char* absent : {"libode", "libfcl", "libosg", "libOpenThreads", "libhdf5", "libassimp"})
    EXPECT_EQ(maps.find(absent), std::string::npos) << absent;
}

std::set<std::string> pluginsIn(const std::string& maps) {
  std::set<std::string> names;
  std::istringstream lines(maps);
  for (std::string line; std::getline(lines, line);) {
    const std::string file = fs::path(line.substr(line.find_last_of(' ') + 1)).filename().string();
    if (file.starts_with("presa_") && file.ends_with(".so")) names.insert(file.substr(6, file.size() - 9));
  }
  return names;
}

// Of everything that is installed, of any kind, a process has what its scene calls for and no more. All names, so that a
// plug-in that comes to the tree and loads itself is found.
TEST(RunningProcess, HasNoOtherPlugIn) {
  {
    const RunningChild child({fixedScene()});
    ASSERT_TRUE(child.waitUntilItRuns());
    EXPECT_EQ(pluginsIn(child.maps()), (std::set<std::string>{"god_object", "haptics_proxy", "scripted"}));
  }
  const RunningChild child({source("config/scenes/cube.xml")});
  ASSERT_TRUE(child.waitUntilItRuns());
  EXPECT_EQ(pluginsIn(child.maps()),
            (std::set<std::string>{"dynamics_ode", "friction_cone", "god_object", "haptics_proxy", "scripted"}));
}

// The check is sensitive: a full scene has all of these threads and libraries.
TEST(RunningProcess, HasWhatAFullSceneCallsFor) {
  const std::string file = scratch("full.h5");
  const RunningChild child({source("config/scenes/pinch_and_lift.xml"), "--record", file, "--overwrite"});
  ASSERT_TRUE(child.waitUntilItRuns());
  EXPECT_TRUE(child.threads().contains("presa-dynamics"));
  EXPECT_TRUE(child.threads().contains("presa-collision"));
  const std::string maps = child.maps();
  for (const char* present : {"libode", "libfcl", "libhdf5"})
    EXPECT_NE(maps.find(present), std::string::npos) << present;
  EXPECT_EQ(maps.find("libosg"), std::string::npos);
}

// The program is linked with none of the engines: only plug-ins can load them.
TEST(Program, IsLinkedWithNoEngine) {
  const auto linked = test::shell("readelf -d " + std::string(PRESA_BINARY_DIR) + "/bin/presa");
  ASSERT_EQ(linked.status, 0) << linked.err;
  ASSERT_NE(linked.out.find("NEEDED"), std::string::npos);
  const auto reached = test::shell("ldd " + std::string(PRESA_BINARY_DIR) + "/bin/presa");
  ASSERT_EQ(reached.status, 0) << reached.err;
  for (const char* engine : {"libode", "libfcl", "libosg", "libhdf5", "libassimp", "libOpenThreads"}) {
    EXPECT_EQ(linked.out.find(engine), std::string::npos) << engine;
    EXPECT_EQ(reached.out.find(engine), std::string::npos) << engine;
  }
}

}  // namespace
}  // namespace presa
