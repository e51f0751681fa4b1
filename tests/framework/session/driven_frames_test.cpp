// Frames that their user moves, in whole runs: what the hand gets while a clutch, a zoom and a walk are used at random.
// The device that measures it is the driver `restless`, below all of the framework.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

#include "framework/device/frame_watch.h"
#include "framework/device/wrapped_device.h"
#include "framework/record/record_plugin.h"
#include "framework/session/replay.h"
#include "framework/session/run.h"
#include "framework/session/stiffness_bound.h"

namespace presa {
namespace {

constexpr double kRate = 1000, kForce = 8;  // limits of the rig [N/s], [N]

std::string write(const std::string& name, const std::string& text) {
  const std::string file = testing::TempDir() + "presa_frames_" + std::to_string(getpid()) + "_" + name;
  std::ofstream(file) << text;
  return file;
}

std::string device(const std::string& role, const std::string& motion, double from, double until, int seed) {
  return "<device role=\"" + role + "\" driver=\"restless\" in=\"desk\"><set key=\"motion\" value=\"" + motion +
         "\"/><set key=\"from\" value=\"" + std::to_string(from) + "\"/><set key=\"until\" value=\"" +
         std::to_string(until) + "\"/><set key=\"seed\" value=\"" + std::to_string(seed) +
         "\"/><limits force=\"8\" force_rate=\"1000\" passivity=\"true\"/></device>";
}

std::string rig(const std::string& devices) {
  return "<rig version=\"1.0\" name=\"restless\"><frame name=\"user\" moves=\"fly\" speed=\"0.3\"/>"
         "<frame name=\"desk\" in=\"user\"><clutch button=\"1\"/><zoom min=\"0.5\" max=\"2\" in=\"2\" "
         "out=\"3\"/></frame>" +
         devices + "</rig>";
}

std::string scene(const std::string& bodies, const std::string& roles) {
  return "<scene version=\"1.0\" name=\"frames\"><world gravity=\"0 0 -9.81\"/><materials><material name=\"rubber\" "
         "stiffness=\"1000\" damping=\"1\"><friction static=\"0.8\" dynamic=\"0.6\"/></material></materials>" +
         bodies + "<devices>" + roles + "</devices></scene>";
}

/// The user at the window, who walks, clutches and zooms at random: in front of every device, as the window's port.
class WindowUser final : public WrappedDevice {
 public:
  WindowUser(std::unique_ptr<Device> device, double from, double until)
      : WrappedDevice(std::move(device)), from_(from), until_(until) {}
  FingerInput read(const Tick& tick) noexcept override {
    const auto share = [this] { return static_cast<double>(random_() % 3) - 1; };
    if (tick.index % 20 == 0) {
      wish_ = {.walk = {share(), share(), share()}, .turn = share(), .zoom = share(), .clutch = random_() % 3 == 0};
      if (random_() % 2 == 0) wish_ = {};
    }
    PointerState pointer;
    if (tick.time >= from_ && tick.time < until_) pointer.frames = wish_;
    inner().point(pointer, tick);
    return inner().read(tick);
  }

 private:
  double from_, until_;
  std::mt19937 random_{7};
  FrameWish wish_;
};

struct Outcome {
  std::vector<std::map<std::string, double>> hand;  ///< facts of each device
  std::vector<FrameNow> frames;
  std::uint64_t hash = 0;
  double rise = 0;  ///< of the first body [m]
};

/// Runs for `duration`; the user at the window is restless from the second `from` until the second `until`.
Outcome runOf(const std::string& scene_file, const std::string& rig_file, double from, double until, double duration) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = duration;
  Loaded loaded = loadWorld({scene_file, rig_file, {}}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  RunControl control;
  Session::Options run_options;
  run_options.wrap = [&](DeviceList devices) {
    devices[0] = std::make_unique<WindowUser>(std::move(devices[0]), from, until);
    return devices;
  };
  Run run(std::move(loaded), control, std::move(run_options));
  run.execute();
  Outcome outcome;
  for (const auto& each : run.session().devices()) {
    auto& facts = outcome.hand.emplace_back();
    for (const DeviceFact& fact : each->facts()) facts[fact.name] = fact.value;
  }
  outcome.frames = run.session().frames()->last().frames;
  outcome.hash = run.monitor().hash();
  const ObjectSummary& object = run.monitor().objects()[0];
  outcome.rise = object.highest.z() - object.start.z();
  return outcome;
}

const std::string kCube = R"(<body name="cube" pos="0 0 0.035"><haptic><box size="0.07 0.07 0.07"/></haptic>
  <physics mass="0.2"><box size="0.07 0.07 0.07"/></physics></body>
  <body name="table" fixed="true" pos="0 0 -0.02"><haptic><box size="4 4 0.04"/></haptic>
  <physics><box size="4 4 0.04"/></physics></body>)";
const std::string kTwo =
    R"(<device role="thumb" fingertip_radius="0.008"/><device role="index" fingertip_radius="0.008"/>)";

std::string graspMotion() {
  return write("grasp.xml", R"(<motion version="1.0" name="hold"><grasp point="0 0 0.04" axis="1 0 0" width="0.07"/>
    <phase name="reach" duration="0.8" open="0.002"/><phase name="squeeze" duration="0.8" grip="3"/>
    <phase name="lift" intent="lift" duration="1.4" move="0 0 0.1"/><phase name="hold" intent="hold" duration="40"/>
    <phase name="sway" intent="hold" duration="10" move="0.05 0.03 0"/>
    <phase name="loosen" intent="release" duration="1" grip="0"/>
    <phase name="release" intent="release" duration="0.5" open="0.03"/></motion>)");
}

// The issue's figure. In the hand every wish waits: the run is the same to the bit as one without any.
TEST(DrivenFrames, AThousandUsesWhileTwoFingersHoldACubeWaitAndChangeNothing) {
  const std::string motion = graspMotion(), scene_file = write("cube.xml", scene(kCube, kTwo));
  const auto rigFor = [&](double until, const std::string& name) {
    return write(name, rig(device("thumb", motion, 2, until, 1) + device("index", motion, 2, until, 2)));
  };
  const Outcome busy = runOf(scene_file, rigFor(52, "busy.xml"), 2, 52, 54);
  const Outcome calm = runOf(scene_file, rigFor(2, "calm.xml"), 2, 2, 54);
  std::uint32_t uses = 0, refusals = 0;
  for (const FrameNow& frame : busy.frames) uses += frame.uses, refusals += frame.refusals;
  EXPECT_GE(uses, 1000U);
  EXPECT_EQ(refusals, uses) << "all of them while the fingers hold the cube";
  EXPECT_EQ(busy.hash, calm.hash);
  EXPECT_GT(busy.rise, 0.09);
  double energy = 0;  // of both fingers: one may push the other through the cube
  for (const auto& hand : busy.hand) {
    EXPECT_LE(hand.at("force_rate"), kRate * (1 + 1e-9));
    energy += hand.at("energy");
  }
  EXPECT_LE(energy, 0);
}

/// Walls, floor and ceiling, a metre thick, around 0.4 m x 0.3 m x 0.12 m of air, and a light cube in it.
std::string room() {
  std::string bodies = R"(<body name="cube" pos="0 0 0.02"><haptic><box size="0.04 0.04 0.04"/></haptic>
    <physics mass="0.05"><box size="0.04 0.04 0.04"/></physics></body>)";
  for (const char* pos : {"0 0 -0.5", "0 0 0.62", "0.7 0 0", "-0.7 0 0", "0 0.65 0", "0 -0.65 0"})
    bodies += std::string("<body name=\"wall") + std::to_string(bodies.size()) + "\" fixed=\"true\" pos=\"" + pos +
              "\"><haptic><box size=\"1 1 1\"/></haptic><physics><box size=\"1 1 1\"/></physics></body>";
  return bodies;
}

/// Two fingers that go down to whatever is there, and up again, 60 times.
std::string pokes() {
  std::string text = "time_s,role,x_m,y_m,z_m\n";
  for (int n = 0; n <= 120; ++n)
    for (const bool thumb : {true, false})
      text += std::to_string(n * 0.5) + (thumb ? ",thumb,-0.06,0," : ",index,0.06,0,") +
              (n % 2 == 0 ? "0.09" : "0.01") + "\n";
  return write("pokes.csv", text);
}

// Walks, clutches and zooms at every moment, free and in contact: the hand never gets a step above the slew limit, never more
// than the force limit at any scale, and no energy.
TEST(DrivenFrames, ARestlessUserGetsNoStepAndNoEnergy) {
  const std::string motion = pokes(), scene_file = write("room.xml", scene(room(), kTwo));
  const std::string rig_file =
      write("pokes.xml", rig(device("thumb", motion, 0, 60, 3) + device("index", motion, 0, 60, 4)));
  const Outcome run = runOf(scene_file, rig_file, 0, 60, 62);
  std::uint32_t uses = 0, refusals = 0;
  for (const FrameNow& frame : run.frames) uses += frame.uses, refusals += frame.refusals;
  EXPECT_GT(uses, 1000U);
  EXPECT_GT(refusals, 100U);
  EXPECT_LT(refusals, uses) << "some of them while the fingers are free";
  for (const auto& hand : run.hand) {
    EXPECT_GT(hand.at("touches"), 20);
    EXPECT_LE(hand.at("force_rate"), kRate * (1 + 1e-9));
    EXPECT_LE(hand.at("force"), kForce * (1 + 1e-9));
    EXPECT_LE(hand.at("energy"), 0);
  }
}

// A finger presses on a table from a desk on a tool, whose tracker is lost for a second, in which the tool goes 100 mm
// along the table and 1 mm down: the desk stands still, then follows without a jump, and the finger keeps touching.
// What the hand gets in a tick is within the slew limit, and no sample is rejected.
TEST(DrivenFrames, AFingerInContactFeelsNoStepWhenTheToolOfItsFrameIsLostAndFound) {
  const std::string tool = write("lost_tool.csv",
                                 "time_s,role,x_m,y_m,z_m\n0,index,0,0,0.4\n1.5,index,0,0,0.4\n2.2,index,0.1,0,0.399\n"
                                 "5,index,0.1,0,0.399\n");
  const std::string hand =
      write("lost_hand.csv", "time_s,role,x_m,y_m,z_m\n0,thumb,0,0,-0.37\n0.5,thumb,0,0,-0.394\n5,thumb,0,0,-0.394\n");
  const auto on = [](const std::string& role, const std::string& in, const std::string& motion,
                     const std::string& lost) {
    return "<device role=\"" + role + "\" driver=\"restless\" in=\"" + in + "\"><set key=\"motion\" value=\"" + motion +
           "\"/>" + lost + "<limits force=\"8\" force_rate=\"1000\"/></device>";
  };
  const std::string lost = "<set key=\"lost_from\" value=\"1.4\"/><set key=\"lost_until\" value=\"2.4\"/>";
  const std::string rig_file =
      write("lost_rig.xml", "<rig version=\"1.0\" name=\"r\"><frame name=\"desk\" in=\"index\"/>" +
                                on("thumb", "desk", hand, "") + on("index", "world", tool, lost) + "</rig>");
  const std::string table =
      "<body name=\"table\" fixed=\"true\" material=\"rubber\" pos=\"0 0 -0.02\"><haptic><box size=\"4 4 "
      "0.04\"/></haptic>"
      "</body>";
  const Outcome run = runOf(write("lost_scene.xml", scene(table, kTwo)), rig_file, 9, 9, 4);
  const auto& thumb = run.hand[0];
  EXPECT_LE(thumb.at("force_rate"), kRate * (1 + 1e-9));
  EXPECT_EQ(thumb.at("touches"), 1);
  EXPECT_GT(thumb.at("felt"), 3550) << "from 0.4 s to the end: nothing stopped it";
  EXPECT_EQ(run.frames[0].losses, 1U);
  EXPECT_NEAR(run.frames[0].X_WF.p.x(), 0.1, 1e-6);
}

// A rig without frames, in which one device stands on the tool of another: its samples are turned into the world all the
// same. Both hands rest, the second 10 mm along x of the first tool, which has the world's axes.
TEST(DrivenFrames, ADeviceOnAToolNeedsNoFrame) {
  const std::string motion = write("rest.csv",
                                   "time_s,role,x_m,y_m,z_m\n0,thumb,0.1,0.2,0.3\n1,thumb,0.1,0.2,0.3\n"
                                   "0,index,0.01,0,0\n1,index,0.01,0,0\n");
  const auto on = [&](const std::string& role, const std::string& in) {
    return "<device role=\"" + role + "\" driver=\"scripted\"" + in + "><set key=\"motion\" value=\"" + motion +
           "\"/></device>";
  };
  const std::string rig_file = write(
      "tool_rig.xml", "<rig version=\"1.0\" name=\"r\">" + on("thumb", "") + on("index", " in=\"thumb\"") + "</rig>");
  const std::string scene_file = write(
      "tool_scene.xml",
      scene("<body name=\"floor\" fixed=\"true\" material=\"rubber\" pos=\"0 0 -1\"><haptic><box size=\"1 1 "
            "0.1\"/></haptic></body>",
            "<device role=\"thumb\" fingertip_radius=\"0.008\"/><device role=\"index\" fingertip_radius=\"0.008\"/>"));
  Diagnostics diagnostics;
  Loaded loaded = loadWorld({scene_file, rig_file, {}}, {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  RunControl control;
  Session session(std::move(loaded), control, {});
  ASSERT_EQ(session.devices().size(), 2u);
  const Tick tick{1, 1e-3, 1e-3};
  const Vec3 thumb = session.devices()[0]->read(tick).p_WH;
  const Vec3 index = session.devices()[1]->read(tick).p_WH;
  EXPECT_LT((index - thumb - Vec3(0.01, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(thumb.y(), 0.2, 1e-9);
}

// A button that no device of the frame has; a device in another frame does not count.
TEST(DrivenFrames, AButtonThatNoDeviceHasIsAnErrorAtItsPlace) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  const std::string scene_file = write("button.xml", scene(kCube, kTwo)), motion = graspMotion();
  std::string text = rig(device("thumb", motion, 0, 1, 1) + device("index", motion, 0, 1, 2));
  text.replace(text.find("<clutch button=\"1\"/>"), 20, "\n<clutch button=\"4\"/>");
  const std::string rig_file = write("button_rig.xml", text);
  Diagnostics diagnostics;
  loadWorld({scene_file, rig_file, {}}, {}, diagnostics);
  EXPECT_NE(diagnostics.text().find(rig_file + ":2:9: error[E467]: no device in frame 'desk' has a button 4"),
            std::string::npos)
      << diagnostics.text();
}

// The force limit of the device holds at the largest scale, and a spring is felt with its square.
TEST(DrivenFrames, LimitsAndStiffnessAreThoseOfTheLargestScale) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  const std::string scene_file = write("limits.xml", scene(kCube, kTwo)), motion = graspMotion();
  const std::string rig_file =
      write("limits_rig.xml", rig(device("thumb", motion, 0, 1, 1) + device("index", motion, 0, 1, 2)));
  Diagnostics diagnostics;
  const Loaded loaded = loadWorld({scene_file, rig_file, {}}, {}, diagnostics);
  std::vector<std::string> notes;
  const auto safety = safetyOf(*loaded.world, {}, notes, diagnostics);
  EXPECT_NEAR(safety[0].limits.force, kForce / 2, 1e-12);
  EXPECT_NEAR(safety[0].limits.force_rate, kRate / 2, 1e-9);
  const StiffnessBound bound = stiffnessBound(loaded.devices, loaded.plan, loaded.world->scene);
  EXPECT_NEAR(bound.stiffness, loaded.devices[0]->damping() / 4 / (0.5 * 1e-3), 1e-9) << "K_max = b / (s^2 T / 2)";
}

// A recording has the frames of the rig, at every tick, and replays to the bit without them.
TEST(DrivenFrames, AreRecordedAndReplayed) {
  setenv("PRESA_PLUGIN_PATH", PRESA_BINARY_DIR "/tests/plugins", 1);
  const std::string motion = pokes(), file = testing::TempDir() + "presa_frames_" + std::to_string(getpid()) + ".h5";
  const std::string scene_file = write("recorded.xml", scene(room(), kTwo));
  const std::string rig_file =
      write("recorded_rig.xml", rig(device("thumb", motion, 0, 60, 3) + device("index", motion, 0, 60, 4)));
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 5;
  options.record = file;
  options.overwrite = true;
  RunControl control;
  presa::Run run(loadWorld({scene_file, rig_file, {}}, options, diagnostics), control);
  run.execute();
  const RecordedSamples samples = recordPlugin().samples(file);
  ASSERT_EQ(samples.frames.size(), 2U);
  EXPECT_EQ(samples.frames[1].name, "desk");
  const FrameNow& last = run.session().frames()->last().frames[1];
  EXPECT_NE(last.zoom, 1);
  EXPECT_EQ(samples.frames[1].values("zoom").back(), last.zoom);
  EXPECT_EQ(samples.frames[1].values("p_WF_x").back(), last.X_WF.p.x());
  EXPECT_EQ(samples.frames[1].values("uses").back(), last.uses);
  const Recording recording = recordPlugin().read(file);
  RecordedRun again(recording, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_TRUE(again.run().verified());
  std::remove(file.c_str());
}

}  // namespace
}  // namespace presa
