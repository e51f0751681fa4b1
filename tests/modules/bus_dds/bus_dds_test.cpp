#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/study/study_run.h"
#include "framework/bus/publisher.h"
#include "framework/bus/remote_picture.h"
#include "framework/core/schedule/clock.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

StudySpec cube(double duration) {
  StudySpec spec;
  spec.scene = kCube;
  spec.duration = duration;
  return spec;
}

StudyRun::MakeModule publisherOn(const BusSettings& bus) {
  return [bus](const std::shared_ptr<const World>& world) {
    return std::make_unique<Publisher>(world, RunOptions{}, [bus] { return openWriter(bus); });
  };
}

/// Stores all samples.
struct Kept final : Listener {
  void onRun(const RunInfo& run, std::int64_t) override { runs.push_back(run); }
  void onObject(const ObjectSample& sample, std::int64_t) override { objects.push_back(sample); }
  void onFinger(const FingerSample& sample, std::int64_t) override { fingers.push_back(sample); }
  void onFrame(const FrameSample& sample, std::int64_t) override { frames.push_back(sample); }
  void onHeartbeat(const Heartbeat& heartbeat, std::int64_t) override { heartbeats.push_back(heartbeat); }
  void onEvent(const Event& event, std::int64_t) override { events.push_back(event); }
  std::vector<RunInfo> runs;
  std::vector<ObjectSample> objects;
  std::vector<FingerSample> fingers;
  std::vector<FrameSample> frames;
  std::vector<Heartbeat> heartbeats;
  std::vector<Event> events;
};

template <class Done>
void takeUntil(Reader& reader, Kept& kept, const Done& done) {
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  while (!done() && monotonicNs() < end) {
    reader.wait(0.02);
    reader.take(kept);
  }
}

// Every field of every sample arrives unchanged, numbers to the bit, and a late reader receives the run information.
TEST(BusDds, CarriesEverySampleToTheBit) {
  const BusSettings bus = ownDomain();
  const auto writer = openWriter(bus);
  const double odd = std::nextafter(0.1, 1.0), tiny = std::numeric_limits<double>::denorm_min();
  RunInfo run{0xfedcba9876543210, 0x0123456789abcdef, 0.005, true, "scène", std::string(300'000, 'x')};
  run.frames = {{"Tisch", "world", true}, {"", "Tisch", false}};
  run.places = {"world", "Tisch"};
  writer->announce(run);
  const auto reader = openReader(bus);  // joins late
  Kept kept;
  takeUntil(*reader, kept, [&] { return !kept.runs.empty(); });
  ASSERT_EQ(kept.runs.size(), 1u);
  EXPECT_EQ(kept.runs[0].run, run.run);
  EXPECT_EQ(kept.runs[0].scene_hash, run.scene_hash);
  EXPECT_EQ(kept.runs[0].period, run.period);
  EXPECT_EQ(kept.runs[0].realtime, run.realtime);
  EXPECT_EQ(kept.runs[0].scene_name, run.scene_name);
  EXPECT_EQ(kept.runs[0].scene_xml, run.scene_xml);
  EXPECT_EQ(kept.runs[0].frames, run.frames);
  EXPECT_EQ(kept.runs[0].places, run.places);
  reader->expectFrames();
  reader->expectFrames();  // once is enough

  const Stamp stamp{run.run, 42, odd, 123456789012345};
  ObjectSample object{stamp, 117, {{odd, -0.0, tiny}, Quat(0.5, -0.5, 0.5, odd)}, {1, 2, odd}, {4, 5, 6}, true};
  FingerSample finger;
  finger.stamp = stamp;
  finger.finger = 3;
  finger.valid = true;
  finger.p_WH = finger.contact.p_WH = {1, odd, 3};
  finger.f_H_W = {7, 8, odd};
  finger.t_H_W = {odd, 0.25, -3};
  finger.oriented = true;
  finger.q_WT = Quat(0.5, -0.5, 0.5, -0.5);
  FingerContact& contact = finger.contact;
  contact.mode = ContactMode::kSlip;
  contact.body = 117;
  contact.p_WP = {odd, 1, 1};
  contact.p_BP = {odd, 2, 1};
  contact.p_BC = {odd, 3, 1};
  contact.nhat_B = {0, odd, 1};
  contact.friction_static = odd;
  contact.friction_dynamic = 0.25;
  contact.normal_force = 4 * odd;
  contact.tangential_force_W = {odd, 4, 1};
  contact.f_H_W = {odd, 5, 1};
  const FrameSample frame{stamp, 1, {{{odd, -2, tiny}, Quat(0.5, 0.5, -0.5, odd)}, odd, 0x80000003, 7, 6, 5}};
  const Heartbeat heartbeat{stamp, 1, 1, 0x80000001, 5, 99, true};
  // the reader of frames has just come: repeated until it is discovered
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  for (Kept first; first.frames.empty() && monotonicNs() < end; reader->wait(0.02), reader->take(first)) {
    Heartbeat none;
    none.stamp.run = 1;
    writer->publish({{}, {}, none, std::span(&frame, 1)});
  }
  for (Kept rest; monotonicNs() < end;) {  // what is still under way
    reader->wait(0.05);
    const std::size_t before = rest.heartbeats.size() + rest.frames.size();
    reader->take(rest);
    if (rest.heartbeats.size() + rest.frames.size() == before) break;
  }
  writer->publish({std::span(&object, 1), std::span(&finger, 1), heartbeat, std::span(&frame, 1)});
  writer->publish({stamp, Event::Kind::kObjectFault, 3});
  takeUntil(*reader, kept, [&] {
    return !kept.objects.empty() && !kept.fingers.empty() && !kept.heartbeats.empty() && !kept.events.empty() &&
           !kept.frames.empty();
  });
  ASSERT_EQ(kept.objects.size(), 1u);
  ASSERT_EQ(kept.fingers.size(), 1u);
  ASSERT_EQ(kept.heartbeats.size(), 1u);
  ASSERT_EQ(kept.events.size(), 1u);
  const ObjectSample& o = kept.objects[0];
  EXPECT_EQ(o.stamp.run, stamp.run);
  EXPECT_EQ(o.stamp.sequence, stamp.sequence);
  EXPECT_EQ(o.stamp.time, stamp.time);
  EXPECT_EQ(o.stamp.sent_ns, stamp.sent_ns);
  EXPECT_EQ(o.body, object.body);
  EXPECT_EQ(o.X_WB.p, object.X_WB.p);
  EXPECT_TRUE(std::signbit(o.X_WB.p.y()));
  EXPECT_EQ(o.X_WB.q.coeffs(), object.X_WB.q.coeffs());
  EXPECT_EQ(o.v_WB, object.v_WB);
  EXPECT_EQ(o.w_WB, object.w_WB);
  EXPECT_TRUE(o.asleep);
  const FingerSample& f = kept.fingers[0];
  EXPECT_EQ(f.finger, 3);
  EXPECT_TRUE(f.valid);
  EXPECT_EQ(f.p_WH, finger.p_WH);
  EXPECT_EQ(f.f_H_W, finger.f_H_W);
  EXPECT_EQ(f.t_H_W, finger.t_H_W);
  EXPECT_TRUE(f.oriented);
  EXPECT_EQ(f.q_WT.coeffs(), finger.q_WT.coeffs());
  EXPECT_EQ(f.contact.mode, contact.mode);
  EXPECT_EQ(f.contact.body, contact.body);
  EXPECT_EQ(f.contact.p_WH, contact.p_WH);
  EXPECT_EQ(f.contact.p_WP, contact.p_WP);
  EXPECT_EQ(f.contact.p_BP, contact.p_BP);
  EXPECT_EQ(f.contact.p_BC, contact.p_BC);
  EXPECT_EQ(f.contact.nhat_B, contact.nhat_B);
  EXPECT_EQ(f.contact.friction_static, contact.friction_static);
  EXPECT_EQ(f.contact.friction_dynamic, contact.friction_dynamic);
  EXPECT_EQ(f.contact.normal_force, contact.normal_force);
  EXPECT_EQ(f.contact.tangential_force_W, contact.tangential_force_W);
  EXPECT_EQ(f.contact.f_H_W, contact.f_H_W);
  const FrameSample& r = kept.frames[0];
  EXPECT_EQ(r.stamp.sequence, stamp.sequence);
  EXPECT_EQ(r.frame, 1);
  EXPECT_EQ(r.now.X_WF.p, frame.now.X_WF.p);
  EXPECT_EQ(r.now.X_WF.q.coeffs(), frame.now.X_WF.q.coeffs());
  EXPECT_EQ(r.now.zoom, odd);
  EXPECT_EQ(r.now.doing, 0x80000003U);
  EXPECT_EQ(r.now.uses, 7U);
  EXPECT_EQ(r.now.refusals, 6U);
  EXPECT_EQ(r.now.losses, 5U);
  const Heartbeat& b = kept.heartbeats[0];
  EXPECT_EQ(b.objects, 1);
  EXPECT_EQ(b.fingers, 1);
  EXPECT_EQ(b.output_status, 0x80000001u);
  EXPECT_EQ(b.object_faults, 5u);
  EXPECT_EQ(b.refused, 99u);
  EXPECT_TRUE(b.last);
  EXPECT_EQ(kept.events[0].kind, Event::Kind::kObjectFault);
  EXPECT_EQ(kept.events[0].bits, 3u);
}

// A viewer process is killed and restarted 20 times, another is stopped for the whole run: the run, in virtual time, is
// not affected. Each viewer has joined before it is killed.
TEST(BusDds, ViewersMayBeKilledAndRestarted) {
  StudyRun alone(cube(2.1));
  alone.run();
  const BusSettings bus = ownDomain();
  StudyRun run(cube(2.1), {}, publisherOn(bus));
  std::unique_ptr<ViewerProcess> viewer, stopped;
  int joined = 0;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.index == 0) {
      stopped = std::make_unique<ViewerProcess>(std::vector<std::string>{"bus", "listen", "--for", "600"}, bus);
      EXPECT_TRUE(stopped->says("joined"));
      stopped->signal(SIGSTOP);
    }
    if (sample.tick.index % 100 != 50) return;
    if (viewer) viewer->signal(SIGKILL);
    viewer = std::make_unique<ViewerProcess>(std::vector<std::string>{"bus", "listen", "--for", "600"}, bus);
    if (viewer->says("joined")) ++joined;
  });
  run.run();
  EXPECT_EQ(joined, 21);
  EXPECT_EQ(run.monitor().hash(), alone.monitor().hash());
}

// A viewer in another process receives everything that the run sent, including its end.
TEST(BusDds, ReachesAnotherProcess) {
  const BusSettings bus = ownDomain();
  StudyRun run(cube(2), {}, publisherOn(bus));
  std::unique_ptr<ViewerProcess> viewer;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.index == 100) {
      viewer = std::make_unique<ViewerProcess>(std::vector<std::string>{"bus", "listen", "--json", "--for", "60"}, bus);
      EXPECT_TRUE(viewer->says("joined"));
    }
    // slow down: lockstep runs a hundred times faster than real time, too fast for a viewer
    if (sample.tick.index > 100) sleepUntilNs(monotonicNs() + 200'000);
  });
  run.run();
  const auto heard = nlohmann::json::parse(viewer->rest(), nullptr, false);
  ASSERT_FALSE(heard.is_discarded());
  EXPECT_TRUE(heard.at("joined"));
  EXPECT_TRUE(heard.at("ended"));
  EXPECT_EQ(heard.at("overrun"), 0);
  EXPECT_GT(heard.at("received"), 100);
  EXPECT_EQ(viewer->end(), heard.at("lost") == 0 ? 0 : 1);
}

// A viewer draws a run of another process. With another scene it reports so, and without a run it gives up.
TEST(BusDds, DrawsARunElsewhere) {
  const BusSettings bus = ownDomain();
  const std::string picture = testing::TempDir() + "/bus_remote.png", other = testing::TempDir() + "/bus_other.xml";
  std::filesystem::remove(picture);
  std::ofstream(other) << R"(<scene version="1.0" name="other"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="2000"/></materials>
    <body name="ball"><physics mass="1"><sphere radius="0.1"/></physics></body></scene>)";
  {
    ViewerProcess nobody({"view", "--join", "--wait", "0.2", "--view", "none"}, bus);
    EXPECT_NE(nobody.rest().find("error[E722]"), std::string::npos);
    EXPECT_EQ(nobody.end(), 3);
  }
  StudyRun run(cube(1), {}, publisherOn(bus));
  std::unique_ptr<ViewerProcess> viewer, wrong;
  run.observe([&](const HapticSample& sample) {
    if (sample.tick.index != 100) return;
    viewer = std::make_unique<ViewerProcess>(
        std::vector<std::string>{"view", "--join", "--view", "offscreen", "--screenshot", picture}, bus);
    wrong = std::make_unique<ViewerProcess>(std::vector<std::string>{"view", "--join", other, "--view", "none"}, bus);
    EXPECT_TRUE(viewer->says("joined"));
    EXPECT_TRUE(wrong->says("joined"));
  });
  run.run();
  const std::string said = viewer->rest();
  EXPECT_EQ(viewer->end(), 0) << said;
  EXPECT_NE(said.find("the run has ended"), std::string::npos) << said;
  EXPECT_TRUE(std::filesystem::exists(picture));
  const std::string wrong_said = wrong->rest();
  EXPECT_NE(wrong_said.find("another scene"), std::string::npos) << wrong_said;
  EXPECT_EQ(wrong->end(), 2);
}

// The bus leaves no trace in a recording: the recording of a published run replays to the bit without a bus.
TEST(BusDds, LeavesNoTraceInARecording) {
  const BusSettings bus = ownDomain();
  const std::string program = std::string(PRESA_BINARY_DIR) + "/bin/presa ", file = testing::TempDir() + "/bus_run.h5";
  ASSERT_EQ(std::system((program + "run " + kCube + " --lockstep --for 1.5 --quiet --overwrite --record " + file +
                         " --bus loopback --domain " + std::to_string(bus.domain))
                            .c_str()),
            0);
  EXPECT_EQ(std::system((program + "replay " + file + " --verify").c_str()), 0);
}

// A network that does not exist is refused by name, with Cyclone's message, and nothing runs.
TEST(BusDds, RefusesANetworkThatIsNotThere) {
  ViewerProcess viewer({"run", kCube, "--lockstep", "--for", "0.1"}, {.network = "lan:nowhere0", .domain = 3});
  const std::string said = viewer.rest();
  EXPECT_EQ(viewer.end(), 2) << said;
  EXPECT_NE(said.find("error[E720]"), std::string::npos) << said;
  EXPECT_NE(said.find("nowhere0"), std::string::npos) << said;
}

// Without a request for a bus, neither Cyclone DDS nor the plug-in is loaded, and no thread runs for it.
TEST(BusDds, IsThereForWhoAsksOnly) {
  const std::string folder = testing::TempDir();
  const auto explained = [&](const std::string& options) {
    const std::string out = folder + "/bus_explain.json";
    EXPECT_EQ(std::system((std::string(PRESA_BINARY_DIR) + "/bin/presa explain " + kCube + " --format json " + options +
                           " > " + out)
                              .c_str()),
              0);
    std::ifstream in(out);
    return nlohmann::json::parse(in);
  };
  const auto without = explained(""), with = explained("--bus loopback");
  EXPECT_EQ(without.at("libraries").dump().find("ddsc"), std::string::npos);
  EXPECT_EQ(without.at("libraries").dump().find("presa_bus_dds"), std::string::npos);
  EXPECT_EQ(without.at("threads").dump().find("\"bus\""), std::string::npos);
  EXPECT_NE(without.at("left_out").dump().find("no bus was requested"), std::string::npos);
  EXPECT_NE(with.at("libraries").dump().find("ddsc"), std::string::npos);
  EXPECT_NE(with.at("threads").dump().find("\"bus\""), std::string::npos);
  EXPECT_NE(with.at("modules").dump().find("--bus loopback"), std::string::npos);

  const std::string rig = folder + "/bus_rig.xml";
  std::ofstream(rig)
      << R"(<rig version="1.0" name="desk"><bus network="loopback" domain="9"/>)"
      << R"(<device role="thumb" driver="scripted"><set key="motion" value=")" << PRESA_SOURCE_DIR
      << R"(/config/motions/pinch_cube.xml"/></device><device role="index" driver="scripted"><set key="motion" value=")"
      << PRESA_SOURCE_DIR << R"(/config/motions/pinch_cube.xml"/></device></rig>)";
  EXPECT_NE(explained("--rig " + rig).at("modules").dump().find("the rig 'desk' publishes on bus 'loopback'"),
            std::string::npos);
  EXPECT_EQ(explained("--rig " + rig + " --bus none").at("threads").dump().find("\"bus\""), std::string::npos);
}

}  // namespace
}  // namespace presa::bus
