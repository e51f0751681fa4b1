// When the system refuses real-time scheduling, hardware is refused before any force, or runs at half the force if
// allowed; simulated devices run as usual.
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "framework/session/load_world.h"
#include "framework/session/realtime_policy.h"
#include "tests/apps/support/support.h"

namespace presa::test {
namespace {

/// Denies SCHED_FIFO and locked memory to this process and to programs that it executes, even as root.
void dropRights() {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_RTPRIO, &none);
  setrlimit(RLIMIT_MEMLOCK, &none);
  __user_cap_header_struct head{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[2]{};
  ::syscall(SYS_capget, &head, sets);
  for (const int cap : {CAP_SYS_NICE, CAP_IPC_LOCK, CAP_SYS_RESOURCE}) {
    prctl(PR_CAPBSET_DROP, cap);  // needed, and allowed, for root only
    const unsigned bit = 1U << (cap % 32);
    sets[cap / 32].effective &= ~bit;
    sets[cap / 32].permitted &= ~bit;
    sets[cap / 32].inheritable &= ~bit;
  }
  ::syscall(SYS_capset, &head, sets);
}

/// Runs `act` in a child process without rights; returns its result as exit status.
template <class Act>
int withoutRights(const Act& act) {
  const pid_t child = fork();
  if (child == 0) {
    dropRights();
    _exit(act());
  }
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string falconRig() {
  const std::string file = scratch("falcon.xml");
  std::ofstream(file) << "<?xml version=\"1.0\"?>\n<rig version=\"1.0\" name=\"desk\">\n"
                         "<device role=\"thumb\" driver=\"novint_falcon\" serial=\"A\"/>\n"
                         "<device role=\"index\" driver=\"novint_falcon\" serial=\"B\"/>\n</rig>\n";
  return file;
}

TEST(RealTimeRights, AreSeenToBeRefused) {
#ifdef PRESA_SANITIZE
  GTEST_SKIP() << "the sanitizer's mlock does nothing, and is never refused";
#endif
  EXPECT_EQ(withoutRights([] {
              const RealtimeRights rights = realtimeRights();
              return rights.granted() || rights.fifo.empty() || rights.memory.empty() ? 1 : 0;
            }),
            0);
}

// The supervisor removes the force after 5 ms without a command: at least two commands must come in that time, or the
// force would vanish between them. Virtual time has no such limit.
TEST(CommandRate, BelowTwoCommandsInTheSupervisorsPatienceIsRefused) {
  const std::string rig = falconRig();
  const auto refusals = [&](const char* haptic, bool realtime) {
    Diagnostics findings;
    RunOptions options;
    options.realtime = realtime;
    loadWorld({source("config/scenes/cube.xml"), rig, {std::string("rates/haptic=") + haptic}}, options, findings);
    std::size_t count = 0;
    for (const Diagnostic& finding : findings.all()) {
      if (finding.code != 410) continue;
      ++count;
      EXPECT_EQ(format(finding).rfind(rig + ":3:", 0) == 0 || format(finding).rfind(rig + ":4:", 0) == 0, true)
          << format(finding);
      EXPECT_NE(finding.message.find("after 5 ms without a command, and the haptic rate is 200 Hz"), std::string::npos)
          << finding.message;
      EXPECT_EQ(finding.help, "rates/haptic=\"400\" or more");
    }
    return count;
  };
  EXPECT_EQ(refusals("200", true), 2u);
  EXPECT_EQ(refusals("200", false), 0u);
  EXPECT_EQ(refusals("400", true), 0u);
}

TEST(RealTimeRights, HardwareIsRefusedWithoutThem) {
  const std::string rig = falconRig();
  const std::string file = scratch("outcome");  // named by this process, written by its child
  const auto run = [&](const std::string& arguments) {
    withoutRights([&] {
      const Outcome outcome = presa("run " + source("config/scenes/cube.xml") + " --realtime --for 0.2 " + arguments);
      std::ofstream(file) << outcome.status << '\n' << outcome.err;
      return 0;
    });
    std::ifstream in(file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string refused = run("--rig " + rig);
  EXPECT_TRUE(refused.starts_with("2\n")) << refused;
  for (const char* word : {"E463", "SCHED_FIFO", "limits.d", "ulimit -r", "--allow-no-rt"})
    EXPECT_NE(refused.find(word), std::string::npos) << refused;
  // when allowed, the run fails later: there is no Falcon
  const std::string allowed = run("--allow-no-rt --rig " + rig);
  EXPECT_EQ(allowed.find("E463"), std::string::npos) << allowed;
  EXPECT_NE(allowed.find("E48"), std::string::npos) << allowed;
  // simulated fingers run
  const std::string models = run("--quiet --view none");
  EXPECT_TRUE(models.starts_with("0\n")) << models;
}

TEST(RealTimeRights, HalveTheForceWhereTheUserAllowsIt) {
  const auto refuses = [] { return RealtimeRights{"Operation not permitted", ""}; };
  const auto grants = [] { return RealtimeRights{}; };
  const auto unasked = []() -> RealtimeRights { throw std::logic_error("asked"); };
  RunOptions options;
  options.realtime = true;
  std::vector<std::string> notes;
  EXPECT_THROW(forceShare(true, options, refuses, notes), InputError);
  EXPECT_EQ(forceShare(true, options, grants, notes), 1);
  EXPECT_EQ(forceShare(false, options, unasked, notes), 1);
  EXPECT_TRUE(notes.empty());
  options.allow_no_rt = true;
  EXPECT_EQ(forceShare(true, options, refuses, notes), 0.5);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("halved"), std::string::npos);
  options.realtime = false;
  EXPECT_EQ(forceShare(true, options, unasked, notes), 1);
}

}  // namespace
}  // namespace presa::test
