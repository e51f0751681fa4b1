// Playback of a recording: its states, and its window under a separate X server.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "apps/presa/playback/recorded_moment.h"
#include "framework/record/record_plugin.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

/// Records 2.5 s of the cube, gripped and being lifted, in lockstep.
std::string recordedCube() {
  RunOptions options;
  options.record = test::scratch("playback.h5");
  options.overwrite = true;
  options.duration = 2.5;
  test::runScene("config/scenes/cube.xml", {}, options, 0);
  return options.record;
}

// Oracle for the fingers: the samples as the replay reads them, from another table by another reader. For the cube: it
// is held between the fingertips, with its centre half way between the proxies to 1 mm.
TEST(Playback, AMomentIsWhatWasRecorded) {
  const std::string file = recordedCube();
  const Recording recording = recordPlugin().read(file);
  const RecordedSamples samples = recordPlugin().samples(file);
  Diagnostics diagnostics;
  const Loaded loaded =
      loadWithoutDevices({recording.scene_xml, recording.scene_file, recording.rig_xml}, {}, diagnostics);
  const RecordedMoment moment(samples, *loaded.world);
  EXPECT_DOUBLE_EQ(moment.end(), recording.time.back());
  ObjectState objects;
  DeviceState device;
  ContactExchange contacts;
  ForceCommand command;
  for (const std::size_t row : {0u, 1000u, 2300u, 2499u}) {
    moment.fill(recording.time[row] + 0.5e-3, objects, device, contacts, command);  // between ticks: the earlier one
    ASSERT_EQ(device.count(), 2);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_EQ(device.fingers[f].p_WH, recording.device[row].fingers[f].p_WH);
      EXPECT_EQ(device.fingers[f].v_WH, recording.device[row].fingers[f].v_WH);
      EXPECT_EQ(command.f_H_W[f], recording.command[row].f_H_W[f]);
    }
  }
  const Pose cube = objects.bodies[1].X_WB_end;
  EXPECT_GT(cube.p.z(), 0.05);
  EXPECT_NEAR(cube.p.x(), (contacts.fingers[0].p_WP.x() + contacts.fingers[1].p_WP.x()) / 2, 1e-3);
  for (const FingerContact& contact : {contacts.fingers[0], contacts.fingers[1]}) {
    EXPECT_EQ(contact.body, 1);
    EXPECT_LT((cube * contact.p_BP - contact.p_WP).norm(), 1e-9);
    EXPECT_LT((cube.q * contact.nhat_B - contact.nhat_W).norm(), 1e-9);
    EXPECT_EQ(contact.friction_static, 0.8);
  }
  EXPECT_EQ(objects.bodies[0].X_WB_end.p, loaded.world->scene.bodies[0].X_WB.p);
}

// Real keys and a real mouse in the window of `presa replay`: the key s saves pictures named by the recording's time.
// Time stands still while paused, also by a key that is held down; Home, End and the middle of the bar go to their times.
TEST(Playback, ItsWindowMovesAboutInTime) {
  const std::string folder = test::scratch("scrub");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/user.sh") << "cd " << folder << "\n"
                                     << std::string(PRESA_BINARY_DIR) << "/bin/presa replay " << recordedCube()
                                     << R"( --view window &
run=$!
picture() {
  rm -f presa-*.png
  for i in $(seq 300); do
    kill -0 $run || exit 1
    xdotool key s; sleep 0.4
    for file in presa-*.png; do [ -e "$file" ] && { file=${file%s.png}; time=${file##*-}; return; }; done
  done
  echo "the window does not answer"; kill $run; exit 1
}
# the picture under way, one asked for meanwhile, and the frame that takes the key, may still show the time before it
moment() { picture; picture; picture; picture; echo "$1 $time" >> times; }
timeout 60 xdotool search --sync --onlyvisible --name Presa; xdotool mousemove 680 440; picture
xdotool keydown space; sleep 1; xdotool keyup space; xdotool key Home; moment start
moment still
xdotool key period; moment step
xdotool mousemove 680 681 click 1; moment middle
xdotool key End; moment end
xdotool key Escape; wait $run; echo $? > status
)";
  test::shell("timeout 250 xvfb-run -a -s '-screen 0 1400x900x24' bash " + folder + "/user.sh");
  std::map<std::string, double> times;
  std::ifstream told(folder + "/times");
  for (std::string name, time; told >> name >> time;) times[name] = std::stod(time);
  EXPECT_EQ(times["start"], 0);
  EXPECT_EQ(times["still"], 0);
  EXPECT_NEAR(times["step"], 1.0 / 60, 0.0006);   // to the millisecond
  EXPECT_NEAR(times["middle"], 2.499 / 2, 0.01);  // half a pixel of 660
  EXPECT_NEAR(times["end"], 2.499, 0.0006);
  int status = -1;
  EXPECT_TRUE(std::ifstream(folder + "/status") >> status);
  EXPECT_EQ(status, 0);
  std::filesystem::remove_all(folder);
}

/// Records a video with `ffmpeg` (the text of a script) in place of the real ffmpeg, or with none at all.
test::Outcome filmWith(const std::string& ffmpeg, const std::string& file, const std::string& more = {}) {
  const std::string folder = test::scratch("path");
  std::filesystem::create_directories(folder);
  if (!ffmpeg.empty()) {
    std::ofstream(folder + "/ffmpeg") << ffmpeg;
    std::filesystem::permissions(folder + "/ffmpeg", std::filesystem::perms::owner_all);
  }
  const test::Outcome outcome = test::shell("PATH=" + folder + " " + PRESA_BINARY_DIR + "/bin/presa run " +
                                            test::source("config/scenes/cube.xml") +
                                            " --lockstep --for 0.1 --view offscreen --quiet --video " + file + more);
  std::filesystem::remove_all(folder);
  return outcome;
}

// ffmpeg receives 30 pictures of 1280 x 720 pixels, three bytes each, per simulated second (0.1 s: at 0, 1/30 and 2/30
// s).
TEST(Video, GivesFfmpegThirtyPicturesASecond) {
  const std::string file = test::scratch("film.mp4");
  const test::Outcome outcome = filmWith("#!/bin/sh\nfor last; do :; done\n/bin/cat > \"$last\"\n", file);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::filesystem::file_size(file), 3u * 1280 * 720 * 3);
  std::filesystem::remove(file);
}

// Ctrl-C at a terminal goes to the whole group of processes: ffmpeg is in another one, and ends when it has every frame.
TEST(Video, EncodesInAGroupOfItsOwn) {
  const std::string file = test::scratch("group.txt");
  const test::Outcome outcome = filmWith(
      "#!/bin/sh\nfor last; do :; done\n/bin/cat > /dev/null\nread all < /proc/$$/stat\nset -- $all\necho $5 > "
      "\"$last\"\n",
      file);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  int group = 0;
  ASSERT_TRUE(std::ifstream(file) >> group);
  EXPECT_NE(group, getpgrp());
}

// 60 a second in 0.1 s, at 320 x 240 pixels.
TEST(Video, HasTheRateAndTheSizeThatAreAsked) {
  const std::string file = test::scratch("film.mp4");
  const test::Outcome outcome = filmWith("#!/bin/sh\nfor last; do :; done\n/bin/cat > \"$last\"\n", file,
                                         " --video-rate 60 --video-size 320x240");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::filesystem::file_size(file), 6u * 320 * 240 * 3);
  std::filesystem::remove(file);
  const test::Outcome still =
      test::presa("run " + test::source("config/scenes/cube.xml") + " --lockstep --video-rate 60");
  EXPECT_EQ(still.status, 2);
  EXPECT_NE(still.err.find("--video-rate: error[E123]: says nothing without a video"), std::string::npos) << still.err;
}

TEST(Video, WithoutFfmpegNothingIsRun) {
  const test::Outcome outcome = filmWith("", test::scratch("film.mp4"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("error[E705]"), std::string::npos) << outcome.err;
}

// When ffmpeg dies only the video is lost: the run goes to its end and reports it.
TEST(Video, OutlivesAnFfmpegThatDies) {
  const test::Outcome outcome = filmWith("#!/bin/sh\nexit 1\n", test::scratch("film.mp4"));
  EXPECT_EQ(outcome.status, 1);
}

}  // namespace
}  // namespace presa
