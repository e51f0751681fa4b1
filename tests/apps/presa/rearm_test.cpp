#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>

#include "framework/core/schedule/clock.h"
#include "framework/record/record_plugin.h"
#include "framework/session/load_world.h"
#include "tests/apps/support/support.h"
#include "tests/support/on_terminal.h"

namespace presa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A rig whose thumb jumps faster than any hand can move.
std::string jumpingRig(const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/jump.csv") << "time_s,role,x_m,y_m,z_m,phase\n"
                                         "0,thumb,-0.1,0,0.03,press\n0,index,0.1,0,0.03,press\n"
                                         "0.3,thumb,-0.1,0,0.006,press\n0.3,index,0.1,0,0.006,press\n"
                                         "2.6,thumb,-0.1,0,0.006,press\n"
                                         "2.601,thumb,0.5,0,0.006,press\n2.602,thumb,1.5,0,0.006,press\n"
                                         "6,thumb,1.5,0,0.006,press\n6,index,0.1,0,0.006,press\n";
  std::ofstream(folder + "/rig.xml")
      << "<rig version=\"1.0\" name=\"jump\">"
         "<device role=\"thumb\" driver=\"scripted\"><set key=\"motion\" value=\"jump.csv\"/></device>"
         "<device role=\"index\" driver=\"scripted\"><set key=\"motion\" value=\"jump.csv\"/></device></rig>";
  return folder + "/rig.xml";
}

/// Largest |z component| of the commanded force [N] from `begin` [s] on.
double forceAfter(const RecordedSamples& samples, const RecordedTable& finger, double begin) {
  double max = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    if (samples.time[i] >= begin) max = std::max(max, std::abs(finger.values("f_command_W_z")[i]));
  }
  return max;
}

// The user's view of a latched fault: the force vanishes, the terminal gives the reason, the key r brings the force
// back softly, and the run replays bit-exactly.
TEST(Rearm, AKeyForgivesALatchedFault) {
  const std::string folder = test::scratch("rearm"), recording = folder + "/run.h5";
  test::OnTerminal presa({PRESA_BINARY_DIR "/bin/presa", "run", test::source("config/scenes/cube.xml"), "--rig",
                          jumpingRig(folder), "--realtime", "--view", "none", "--for", "6", "--record", recording});
  ASSERT_TRUE(presa.says("Check the device, then press r to re-arm.")) << presa.seen();
  EXPECT_THAT(presa.seen(), HasSubstr("thumb: device disconnected or reporting implausible samples"));
  EXPECT_TRUE(presa.says("index: the device of another finger is lost")) << presa.seen();
  ASSERT_TRUE(presa.says("]  4.")) << presa.seen();  // the motion has ended by then
  presa.press('r');
  EXPECT_TRUE(presa.says("re-armed: forces come back softly")) << presa.seen();
  EXPECT_EQ(presa.status(), 1) << presa.seen();  // there was a fault

  const RecordedSamples samples = recordPlugin().samples(recording);
  ASSERT_EQ(samples.faults.size(), 2u);
  const Recording run = recordPlugin().read(recording);
  double rearmed = -1;
  for (std::size_t i = 0; i < run.time.size() && rearmed < 0; ++i)
    if (run.device[i].rearms > 0) rearmed = run.time[i];
  ASSERT_GT(rearmed, 2.6);
  EXPECT_GT(forceAfter(samples, samples.fingers[1], rearmed + 0.1), 0.1);  // the index presses again
  const test::Outcome replayed = test::presa("replay " + recording + " --verify");
  EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
}

// A real-time program that was stopped, as at a breakpoint, keeps its forces off until the user re-arms: the situation
// may have changed. Only the clock reveals such a gap, of Executor::kGap or longer.
TEST(Rearm, AProgramThatStoodStillWaitsForAKey) {
  test::OnTerminal presa({PRESA_BINARY_DIR "/bin/presa", "run", test::source("config/scenes/cube.xml"), "--realtime",
                          "--view", "none", "--for", "6"});
  ASSERT_TRUE(presa.says("]  2.")) << presa.seen();
  kill(presa.pid(), SIGSTOP);
  sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(1.2e9 * Executor::kGap));
  kill(presa.pid(), SIGCONT);
  ASSERT_TRUE(presa.says("the program or the whole machine was suspended. Check the device, then press r to re-arm."))
      << presa.seen();
  presa.press('r');
  EXPECT_TRUE(presa.says("re-armed: forces come back softly")) << presa.seen();
  EXPECT_EQ(presa.status(), 1) << presa.seen();
}

// Without --record the flight record still holds the time before a fault.
TEST(FlightRecord, IsWrittenAtAFaultAndShown) {
  const std::string folder = test::scratch("flight"), flight = folder + "/flight.h5", page = folder + "/flight.html";
  const test::Outcome run = test::presa("run " + test::source("config/scenes/cube.xml") + " --rig " +
                                        jumpingRig(folder) + " --lockstep --view none --for 4 --flight " + flight);
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("the seconds around the fault: " + flight));
  const RecordedSamples samples = recordPlugin().samples(flight);
  EXPECT_TRUE(samples.complete);
  EXPECT_GT(samples.first_tick, 0u);
  EXPECT_LE(samples.time.front(), 1.0);
  EXPECT_GE(samples.time.back(), 3.0);
  const test::Outcome shown = test::presa("replay " + flight + " --page " + page);
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("thumb: device disconnected or reporting implausible samples"));
  EXPECT_GT(std::filesystem::file_size(page), 50'000u);
  EXPECT_FALSE(std::filesystem::exists(folder + "/flight-2.h5"));
}

}  // namespace
}  // namespace presa
