// A CAVE of separate processes, drawn off-screen, while this test listens to what they tell each other.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "framework/bus/wall_link.h"
#include "framework/core/schedule/clock.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

using testing::HasSubstr;

const std::string kCave = std::string(PRESA_SOURCE_DIR) + "/config/cave/cave.xml";
const std::string kHeadRig = std::string(PRESA_SOURCE_DIR) + "/config/cave/head.xml";

std::vector<std::string> caveProcess(std::vector<std::string> more) {
  std::vector<std::string> words{"view", "--join", "--wait", "60", "--walls", kCave};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::unique_ptr<ViewerProcess> runCube(const BusSettings& bus, const std::string& seconds) {
  const std::vector<std::string> words{"run", kCube, "--realtime", "--view", "none", "--quiet", "--for", seconds};
  return std::make_unique<ViewerProcess>(words, bus);
}

/// Everything said on the link, each message once.
struct Heard {
  std::map<std::uint64_t, WallFrame> frames;                        // by number
  std::map<std::uint64_t, std::map<std::string, WallDrawn>> drawn;  // by number and wall

  void take(WallLink& link) {
    const WallLink::Arrived arrived = link.take();
    for (const WallFrame& frame : arrived.frames) frames.try_emplace(frame.number, frame);
    for (const WallDrawn& one : arrived.drawn)
      if (one.number > 0) drawn[one.number].try_emplace(one.wall, one);
  }
  std::size_t complete(std::size_t walls) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(drawn, [&](const auto& entry) { return entry.second.size() == walls; }));
  }
};

// Every field arrives to the bit.
TEST(Walls, MessagesArriveUnchanged) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const double odd = std::nextafter(0.1, 1.0);
  const Pose head{{odd, -2, 3}, Quat(0.5, -0.5, 0.5, odd)};
  link->send(WallFrame{1, 2, 3, odd, head, true});
  link->send(WallDrawn{4, 5, 6, "front", odd, 7, head, 8});
  WallLink::Arrived all;
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  while ((all.frames.empty() || all.drawn.empty()) && monotonicNs() < end) {
    WallLink::Arrived some = link->take();
    std::ranges::move(some.frames, std::back_inserter(all.frames));
    std::ranges::move(some.drawn, std::back_inserter(all.drawn));
    sleepUntilNs(monotonicNs() + 1'000'000);
  }
  ASSERT_EQ(all.frames.size(), 1u);
  ASSERT_EQ(all.drawn.size(), 1u);
  const WallFrame& f = all.frames[0];
  EXPECT_EQ(std::tuple(f.leader, f.number, f.run, f.time, f.tracked), std::tuple(1u, 2u, 3u, odd, true));
  EXPECT_EQ(f.X_KHead.p, head.p);
  EXPECT_EQ(f.X_KHead.q.coeffs(), head.q.coeffs());
  const WallDrawn& d = all.drawn[0];
  EXPECT_EQ(std::tuple(d.sender, d.leader, d.number, d.wall, d.time, d.state, d.shown_ns),
            std::tuple(4u, 5u, 6u, "front", odd, 7u, 8));
  EXPECT_EQ(d.X_KHead.p, head.p);
  EXPECT_EQ(d.X_KHead.q.coeffs(), head.q.coeffs());
}

// Four walls and a leader: each frame has one time, one head and one state on all walls, and no wall shows a frame
// before all have shown the one before. The cube moves meanwhile, and so does the head.
TEST(Walls, FourProcessesDrawTheSameFrames) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const auto run = runCube(bus, "60");
  const std::vector<std::string> names{"front", "left", "right", "floor"};
  std::vector<std::unique_ptr<ViewerProcess>> processes;
  for (const std::string& wall : names)
    processes.push_back(
        std::make_unique<ViewerProcess>(caveProcess({"--wall", wall, "--view", "offscreen", "--quiet"}), bus));
  processes.push_back(std::make_unique<ViewerProcess>(caveProcess({"--head", kHeadRig, "--quiet"}), bus));
  Heard heard;
  constexpr std::size_t kEnough = 60;
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  while (heard.complete(names.size()) < kEnough && monotonicNs() < end) {
    heard.take(*link);
    sleepUntilNs(monotonicNs() + 2'000'000);
  }
  ASSERT_GE(heard.complete(names.size()), kEnough);

  std::set<double> heads;
  std::set<std::uint64_t> states;
  for (const auto& [number, walls] : heard.drawn) {
    if (walls.size() < names.size()) continue;  // before all have joined
    ASSERT_TRUE(heard.frames.contains(number));
    const WallFrame& frame = heard.frames[number];
    const WallDrawn& first = walls.begin()->second;
    for (const auto& [name, wall] : walls) {
      EXPECT_EQ(wall.time, frame.time) << name << ", frame " << number;
      EXPECT_EQ(wall.X_KHead.p, frame.X_KHead.p);
      EXPECT_EQ(wall.X_KHead.q.coeffs(), frame.X_KHead.q.coeffs());
      EXPECT_EQ(wall.state, first.state) << name << ", frame " << number;
    }
    heads.insert(frame.X_KHead.p.x());
    states.insert(first.state);
    const auto next = heard.drawn.find(number + 1);
    if (next == heard.drawn.end() || next->second.size() < names.size()) continue;
    for (const auto& [name, later] : next->second)
      for (const auto& [other, wall] : walls) EXPECT_GT(later.shown_ns, wall.shown_ns) << name << " before " << other;
  }
  EXPECT_GT(heads.size(), 5u);
  EXPECT_GT(states.size(), 5u);
}

// A leader that dies leaves the walls frozen, and they say so; the next one goes on from the head that they show.
TEST(Walls, FreezeWithoutTheirLeaderAndGoOnWithTheNext) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const auto run = runCube(bus, "60");
  ViewerProcess front(caveProcess({"--wall", "front", "--view", "offscreen"}), bus);
  Heard heard;
  const auto hearFrom = [&](std::size_t frames, double x) {
    const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
    heard = {};
    while (monotonicNs() < end) {
      heard.take(*link);
      if (heard.complete(1) >= frames && heard.drawn.rbegin()->second.begin()->second.X_KHead.p.x() > x) return true;
      sleepUntilNs(monotonicNs() + 2'000'000);
    }
    return false;
  };
  {
    const ViewerProcess leader(caveProcess({"--head", kHeadRig, "--quiet"}), bus);
    ASSERT_TRUE(hearFrom(5, 0.05));  // the head is on its way
  }
  EXPECT_TRUE(front.says("LEADER LOST: the wall is frozen"));
  heard.take(*link);
  const Vec3 frozen = heard.drawn.rbegin()->second.begin()->second.X_KHead.p;
  EXPECT_GT(frozen.x(), 0.05);
  const ViewerProcess next(caveProcess({"--head", kHeadRig, "--quiet"}), bus);
  ASSERT_TRUE(hearFrom(5, -10));
  // the first frame shows the frozen head, to the rounding of the path that begins there
  EXPECT_LT((heard.frames.begin()->second.X_KHead.p - frozen).norm(), 1e-3);
}

/// A rig of a scripted head with these keyframes and settings.
std::string headRig(const std::string& name, const std::string& keyframes, const std::string& settings = "") {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir());
  const std::string stem = "presa_head_" + name + "_" + std::to_string(getpid());
  std::ofstream(folder / (stem + ".csv")) << "time_s,role,x_m,y_m,z_m,qw,qx,qy,qz\n" << keyframes;
  std::ofstream(folder / (stem + ".xml"))
      << R"(<rig version="1.0" name="head"><device role="head" driver="scripted"><set key="motion" value=")" << stem
      << ".csv\"/>" << settings << "</device></rig>";
  return (folder / (stem + ".xml")).string();
}

// The tracker is lost while the head moves: the leader and the wall say so, and all frames from then on have one head.
TEST(Walls, ALostTrackerFreezesTheHeadAndIsTold) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const auto run = runCube(bus, "60");
  ViewerProcess front(caveProcess({"--wall", "front", "--view", "offscreen"}), bus);
  const std::string rig = headRig("lost", "0,head,-0.8,-0.8,1.7,1,0,0,0\n20,head,0.8,-0.8,1.7,1,0,0,0\n",
                                  R"(<set key="lost_at" value="4"/>)");
  ViewerProcess leader(caveProcess({"--head", rig}), bus);
  EXPECT_TRUE(front.says("HEAD LOST: it stays where it was"));
  EXPECT_TRUE(leader.says("front"));
  EXPECT_TRUE(leader.says("HEAD LOST: it stays where it was"));
  Heard heard;
  heard.take(*link);
  std::size_t tracked = 0;
  std::set<double> frozen;
  for (const auto& [number, frame] : heard.frames) {
    if (frame.tracked)
      ++tracked;
    else if (tracked > 0)
      frozen.insert(frame.X_KHead.p.x());
  }
  EXPECT_GT(tracked, 5u);
  ASSERT_EQ(frozen.size(), 1u);
  // a minimum-jerk path of 1.6 m: 0.058 of it is done after 4 s of 20; the scripted finger lags behind by less than 1 cm
  EXPECT_NEAR(*frozen.begin(), -0.8 + 0.058 * 1.6, 0.01);
}

TEST(Walls, AnEyeBehindAWallIsTold) {
  const BusSettings bus = ownDomain();
  const auto run = runCube(bus, "60");
  ViewerProcess front(caveProcess({"--wall", "front", "--view", "offscreen"}), bus);
  const std::string rig = headRig("behind", "0,head,0,1.7,1.7,1,0,0,0\n1,head,0,1.7,1.7,1,0,0,0\n");
  const ViewerProcess leader(caveProcess({"--head", rig, "--quiet"}), bus);
  EXPECT_TRUE(front.says("the eye is behind the wall: drawn from its last place before it"));
}

/// Listens for a while, and says `also` all the time; the highest number of a frame of somebody else, 0: none.
std::uint64_t newestFrame(WallLink& link, double seconds, const WallFrame* also = nullptr) {
  std::uint64_t newest = 0;
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(seconds * 1e9);
  while (monotonicNs() < end && (also != nullptr || newest == 0)) {
    if (also != nullptr) link.send(*also);
    const WallLink::Arrived arrived = link.take();
    for (const WallFrame& frame : arrived.frames)
      if (also == nullptr || frame.leader != also->leader) newest = std::max(newest, frame.number);
    sleepUntilNs(monotonicNs() + 20'000'000);
  }
  return newest;
}

TEST(Walls, TwoLeadersAreRefused) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const auto run = runCube(bus, "60");
  ViewerProcess leader(caveProcess({"--head", kHeadRig}), bus);
  ASSERT_TRUE(leader.says("leads no wall yet"));
  ASSERT_GT(newestFrame(*link, kPatience), 0u);
  const Said said = say(bus, caveProcess({"--head", kHeadRig, "--quiet", "--for", "30"}));
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.text, HasSubstr("error[E767]: another process leads these walls already"));
}

// Frames of another leader, even forged ones, do not end a leader that has begun: its own frames go on.
TEST(Walls, ALeaderThatHasBegunIgnoresAnother) {
  const BusSettings bus = ownDomain();
  const auto link = openWallLink(bus);
  const auto run = runCube(bus, "60");
  ViewerProcess leader(caveProcess({"--head", kHeadRig}), bus);
  ASSERT_GT(newestFrame(*link, kPatience), 0u);  // it leads
  const WallFrame forged{1, 1, 1, 0, {Vec3::Zero(), Quat::Identity()}, true};
  const std::uint64_t before = newestFrame(*link, 3, &forged);  // longer than between two lines of its terminal
  EXPECT_GT(newestFrame(*link, 1, &forged), before);
  EXPECT_TRUE(leader.says("ANOTHER LEADER is ignored"));
}

TEST(Walls, MistakesAreNamed) {
  const BusSettings bus = ownDomain();
  const auto run = runCube(bus, "60");
  const auto finds = [&](std::vector<std::string> more) { return say(bus, caveProcess(std::move(more))).text; };
  EXPECT_THAT(finds({"--wall", "fron", "--view", "offscreen"}), HasSubstr("error[E764]: no wall 'fron'"));
  EXPECT_THAT(finds({"--wall", "front", "--view", "none"}), HasSubstr("error[E121]: a wall needs a view"));
  EXPECT_THAT(finds({}), HasSubstr("error[E123]: needs --wall NAME, --head RIG, or both"));
  EXPECT_THAT(finds({"--wall", "front", "--hud", "off"}), HasSubstr("error[E123]: says nothing on a wall"));
  EXPECT_THAT(finds({"--head", std::string(PRESA_SOURCE_DIR) + "/config/rigs/pinch_cube.xml"}),
              HasSubstr("pinch_cube.xml: error[E766]: the head needs a rig of one device, found 2"));
}

}  // namespace
}  // namespace presa::bus
