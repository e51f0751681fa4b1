// A guide in one process and the run in another, over loopback.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "framework/bus/guide_link.h"
#include "framework/core/schedule/clock.h"
#include "tests/modules/bus_dds/viewer_process.h"

namespace presa::bus {
namespace {

using testing::HasSubstr;

template <class Done>
bool soon(const Done& done) {
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(kPatience * 1e9);
  while (!done()) {
    if (monotonicNs() > end) return false;
    sleepUntilNs(monotonicNs() + 5'000'000);
  }
  return true;
}

/// A scene with a box near its goal; the file is removed at the end.
class BoxScene {
 public:
  BoxScene() {
    std::ofstream(file_) << R"(<scene version="1.0" name="box"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="1000"><friction static="0.5"/></material></materials>
    <body name="table" fixed="true" pos="0 0 -0.05"><physics><box size="2 2 0.1"/></physics></body>
    <body name="box" pos="0.004 -0.003 0.0302"><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
    <assembly><goal name="bottom" bodies="box" pos="0 0 0.03" fold="4"/></assembly></scene>)";
  }
  ~BoxScene() { unlink(file_.c_str()); }
  const std::string& file() const { return file_; }

 private:
  const std::string file_ = testing::TempDir() + "/guided_box_" + std::to_string(getpid()) + ".xml";
};

// Every field of an order and of a status arrives unchanged, numbers to the bit.
TEST(BusGuide, OrdersAndStatusesArriveToTheBit) {
  using Kind = GuideEvent::Kind;
  const BusSettings bus = ownDomain();
  const auto post = openOrderPost(bus);
  const auto sender = openOrderSender(bus);
  const double odd = std::nextafter(0.1, 1.0);
  GuideOrder order{0xfedcba9876543210, 5, 6, 7, 8};
  order.draws = {3, kNoBody, 1000000};
  order.says.placed = 2;
  order.says.body = 4;
  order.says.held = true;
  order.says.blocked = 1;
  order.says.missing = 0;
  order.says.news = GuideEvent{Kind::kUndone, odd, 1, 4};
  order.says.elapsed = odd;
  order.told = 40;
  order.events = {{Kind::kTaken, 1, kNoGoal, 4}, {Kind::kHint, odd, 2, kNoBody}};
  std::vector<GuideOrder> orders;
  ASSERT_TRUE(soon([&] {
    sender->send(order);
    orders = post->take();
    return !orders.empty();
  }));
  const GuideOrder& got = orders.front();
  EXPECT_EQ(std::tie(got.run, got.guide, got.number, got.on, got.undone),
            std::tie(order.run, order.guide, order.number, order.on, order.undone));
  EXPECT_EQ(got.draws, order.draws);
  EXPECT_EQ(got.says.placed, 2);
  EXPECT_EQ(got.says.body, 4);
  EXPECT_TRUE(got.says.held);
  EXPECT_EQ(got.says.goal, kNoGoal);
  EXPECT_EQ(got.says.blocked, 1);
  EXPECT_EQ(got.says.missing, 0);
  ASSERT_TRUE(got.says.news);
  EXPECT_EQ(got.says.news->kind, Kind::kUndone);
  EXPECT_EQ(got.says.news->time, odd);
  EXPECT_EQ(got.says.elapsed, odd);
  EXPECT_EQ(got.told, 40u);
  ASSERT_EQ(got.events.size(), 2u);
  EXPECT_EQ(got.events[1].kind, Kind::kHint);
  EXPECT_EQ(got.events[1].time, odd);
  EXPECT_EQ(got.events[1].goal, 2);

  GuideStatus status{9, 10, 11, 12, OrderRefusal::kLate, 13, 14};
  status.elapsed = odd;
  status.assembly.time = -0.0;
  status.assembly.filled = 1;
  status.assembly.last_filled = 0;
  status.assembly.goals = {{GoalState::Status::kFilled, 3, kNoGoal}, {GoalState::Status::kBlocked, 4, 1}};
  std::vector<GuideStatus> statuses;
  ASSERT_TRUE(soon([&] {
    post->show(status);
    statuses = sender->take();
    return !statuses.empty();
  }));
  const GuideStatus& told = statuses.front();
  EXPECT_EQ(std::tie(told.run, told.sequence, told.lead, told.number, told.refusal, told.refused_guide, told.undone),
            std::tie(status.run, status.sequence, status.lead, status.number, status.refusal, status.refused_guide,
                     status.undone));
  EXPECT_EQ(told.elapsed, odd);
  EXPECT_TRUE(std::signbit(told.assembly.time));
  EXPECT_EQ(told.assembly.filled, 1);
  EXPECT_EQ(told.assembly.last_filled, 0);
  ASSERT_EQ(told.assembly.goals.size(), 2u);
  EXPECT_EQ(told.assembly.goals[1].status, GoalState::Status::kBlocked);
  EXPECT_EQ(told.assembly.goals[1].missing, 1);
}

// In real time: the box is pulled; a second guide is refused and told so; when the first one dies, the run says it and
// goes on.
TEST(BusGuide, ARunFollowsOneViewer) {
  const BoxScene scene;
  const BusSettings bus = ownDomain();
  ViewerProcess run({"run", scene.file(), "--realtime", "--for", "60", "--bus-commands", "--guide", "viewer"}, bus);
  const std::vector<std::string> guide{"view", "--join", "--guide", "--view", "none", "--wait", "30"};
  ViewerProcess first(guide, bus);
  ASSERT_TRUE(first.says("guides the run"));
  const Said second = say(bus, guide);
  EXPECT_EQ(second.status, 2) << second.text;
  EXPECT_THAT(second.text, HasSubstr("error[E768]"));
  first.signal(SIGKILL);
  ASSERT_TRUE(run.says("the guide fell silent"));
  ViewerProcess third(guide, bus);
  ASSERT_TRUE(third.says("guides the run"));
  run.signal(SIGINT);
  const std::string said = run.rest();
  EXPECT_EQ(run.end(), 130) << said;
  EXPECT_EQ(third.end(), 0) << third.rest();
}

TEST(BusGuide, IsRefusedWhereNobodyAskedForIt) {
  const BoxScene scene;
  const BusSettings bus = ownDomain(), nowhere{.network = ""};
  ViewerProcess run({"run", scene.file(), "--lockstep", "--speed", "0.1", "--for", "60", "--bus-commands"}, bus);
  const Said viewer = say(bus, {"view", "--join", "--guide", "--view", "none", "--wait", "30"});
  EXPECT_EQ(viewer.status, 2) << viewer.text;
  EXPECT_THAT(viewer.text, HasSubstr("error[E769]"));
  const Said unheard = say(nowhere, {"run", scene.file(), "--lockstep", "--for", "0.1", "--guide", "viewer"});
  EXPECT_EQ(unheard.status, 2) << unheard.text;
  EXPECT_THAT(unheard.text, HasSubstr("error[E770]"));
  const Said nothing = say(nowhere, {"run", kCube, "--lockstep", "--for", "0.1", "--guide", "viewer"});
  EXPECT_EQ(nothing.status, 2) << nothing.text;
  EXPECT_THAT(nothing.text, HasSubstr("error[E771]"));
  run.signal(SIGINT);
  EXPECT_EQ(run.end(), 130);
}

// `presa explain` shows the run's end of it, and nothing of it where the guide is beside the dynamics.
TEST(BusGuide, IsExplained) {
  const BoxScene scene;
  const BusSettings nowhere{.network = ""};
  const std::vector<std::string> words{"explain", scene.file(), "--bus", "loopback", "--bus-commands", "--guide"};
  auto beside = words, viewer = words;
  beside.emplace_back("beside");
  viewer.emplace_back("viewer");
  const Said own = say(nowhere, beside), remote = say(nowhere, viewer);
  EXPECT_THAT(own.text, testing::Not(HasSubstr("guide in the viewer"))) << own.text;
  EXPECT_THAT(remote.text, HasSubstr("take the orders of the guide in the viewer"));
  EXPECT_THAT(remote.text, HasSubstr("guide_orders"));
}

}  // namespace
}  // namespace presa::bus
