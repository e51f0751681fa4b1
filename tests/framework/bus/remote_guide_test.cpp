// The guide's end of a guide in a viewer, with a run made by hand: forged statuses, and another run on the same bus.
#include "framework/bus/remote_guide.h"

#include <gtest/gtest.h>

#include <limits>

#include "framework/bus/local_bus.h"
#include "framework/bus/scene_hash.h"
#include "framework/core/schedule/clock.h"
#include "framework/scene/load.h"

namespace presa::bus {
namespace {

using Status = GoalState::Status;

constexpr double kPublished = 0.005;  // [s]
constexpr std::int32_t kBox = 1;

std::shared_ptr<const World> boxWorld() {
  Diagnostics diagnostics;
  const std::string xml = R"(<scene version="1.0" name="box"><world gravity="0 0 -9.81"/>
    <materials><material name="wood" stiffness="1000"/></materials>
    <body name="table" fixed="true" pos="0 0 -0.05"><physics><box size="2 2 0.1"/></physics></body>
    <body name="box" pos="0.004 0 0.03"><physics mass="0.2"><box size="0.1 0.1 0.06"/></physics></body>
    <assembly><goal name="bottom" bodies="box" pos="0 0 0.03" fold="4"/></assembly></scene>)";
  World world = buildWorld(parseScene(xml, "test", ".", {}, diagnostics), {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return std::make_shared<const World>(std::move(world));
}

class RemoteGuideTest : public testing::Test {
 protected:
  RemoteGuideTest() { announce(1); }

  void announce(std::uint64_t run) {
    stamp_ = {run, 0, 0, 0};
    writer_->announce({run, sceneHash(*world_), kPublished, false, "box", world_->scene.resolved_xml});
  }
  GuideStatus status() const {
    GuideStatus status{stamp_.run, stamp_.sequence, lead_};
    status.elapsed = elapsed_;
    status.assembly.goals.resize(1);
    return status;
  }
  /// One publication, and what the guide orders on it; no order: null.
  std::optional<GuideOrder> publish(const GuideStatus* forged = nullptr, bool last = false) {
    ++stamp_.sequence;
    stamp_.time += kPublished;
    stamp_.sent_ns = monotonicNs();
    ObjectSample box;
    box.stamp = stamp_;
    box.body = kBox;
    box.X_WB = world_->scene.bodies[1].X_WB;
    Heartbeat heartbeat;
    heartbeat.stamp = stamp_;
    heartbeat.last = last;
    post_->show(status());
    if (forged != nullptr) post_->show(*forged);
    writer_->publish({{&box, 1}, {}, heartbeat});
    return step();
  }
  std::optional<GuideOrder> step() {
    guide_.step(0);
    const std::vector<GuideOrder> orders = post_->take();
    if (orders.empty()) return std::nullopt;
    lead_ = orders.back().guide;
    return orders.back();
  }

  LocalBus bus_;
  std::shared_ptr<const World> world_ = boxWorld();
  std::unique_ptr<Writer> writer_ = bus_.writer();
  std::unique_ptr<OrderPost> post_ = bus_.orderPost();
  RemoteGuide guide_{world_, bus_.reader(), bus_.orderSender()};
  Stamp stamp_;
  std::uint64_t lead_ = 0;
  double elapsed_ = 0;
};

// Each of these would write out of bounds, overflow, or block the guide; it arrives between the genuine status and the
// heartbeat of the first publication.
class ForgedStatus : public RemoteGuideTest, public testing::WithParamInterface<int> {};

TEST_P(ForgedStatus, IsNotHeard) {
  GuideStatus forged = status();
  forged.sequence = 1;
  GoalState& goal = forged.assembly.goals[0];
  switch (GetParam()) {
    case 0:
      goal = {Status::kFilled, kNoBody, kNoGoal};
      break;
    case 1:
      goal = {Status::kFilled, 2, kNoGoal};
      break;
    case 2:
      goal = {Status::kFilled, kBox, 1};
      break;
    case 3:
      goal = {Status::kFilled, kBox, -2};
      break;
    case 4:
      forged.undone = std::numeric_limits<std::int32_t>::max();
      break;
    case 5:
      forged.undone = -1;
      break;
    case 6:
      forged.elapsed = std::numeric_limits<double>::infinity();
      break;
    case 7:
      forged.elapsed = -1;
      break;
    default:
      forged.sequence = std::numeric_limits<std::uint64_t>::max();
      goal = {Status::kFilled, kBox, kNoGoal};
  }
  for (int publication = 0; publication < 3; ++publication) {
    const std::optional<GuideOrder> order = publish(publication == 0 ? &forged : nullptr);
    ASSERT_TRUE(order);
    EXPECT_EQ(order->on, stamp_.sequence);
    EXPECT_EQ(order->draws, std::vector<std::int32_t>{kBox});
    EXPECT_EQ(order->undone, 0);
    EXPECT_EQ(order->says.elapsed, 0);
  }
}
INSTANTIATE_TEST_SUITE_P(EachKind, ForgedStatus, testing::Range(0, 9));

// Before the first heartbeat no number is known to be far.
TEST_F(RemoteGuideTest, AForgedFirstStatusDoesNotBlock) {
  GuideStatus forged = status();
  forged.sequence = std::numeric_limits<std::uint64_t>::max();
  forged.lead = 99;
  post_->show(forged);
  step();
  publish();
  publish();
  const std::optional<GuideOrder> order = publish();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->on, stamp_.sequence);
  EXPECT_EQ(guide_.now().standing, RemoteGuide::Standing::kLeads);
}

// What an earlier guide spent counts in its run only.
TEST_F(RemoteGuideTest, AnotherRunBeginsWithNoTimeSpent) {
  elapsed_ = 100;
  const std::optional<GuideOrder> first = publish();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->says.elapsed, 100);
  publish(nullptr, true);
  announce(2);
  elapsed_ = 0;
  publish();
  const std::optional<GuideOrder> second = publish();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->run, 2u);
  EXPECT_EQ(second->says.elapsed, 0);
}

// A body that stands when the guide takes over was placed before.
TEST_F(RemoteGuideTest, WhatStandsIsNotToldAgain) {
  GuideStatus stands = status();
  stands.sequence = 1;
  stands.assembly.goals[0] = {Status::kFilled, kBox, kNoGoal};
  post_->show(stands);
  const std::optional<GuideOrder> order = step();
  ASSERT_TRUE(order);
  EXPECT_EQ(order->says.placed, 1);
  EXPECT_EQ(order->told, 0u);
}

}  // namespace
}  // namespace presa::bus
