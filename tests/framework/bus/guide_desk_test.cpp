// The run's end of a guide in a viewer: whom it follows, and what it refuses. Orders are made by hand.
#include "framework/bus/guide_desk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "framework/bus/local_bus.h"
#include "framework/core/schedule/clock.h"

namespace presa::bus {
namespace {

constexpr std::uint64_t kGuidedRun = 7, kGuide = 11, kOther = 12;
constexpr std::int32_t kDrumA = 0, kDrumB = 1, kCapital = 2, kGround = 3;

/// Two drums, either of which fits the first goal, and a capital for the second.
class GuideDeskTest : public testing::Test {
 protected:
  GuideDeskTest() {
    scene_.bodies.resize(4);
    Assembly assembly;
    assembly.goals = {{.name = "shaft", .bodies = {0, 1}, .X_WB = {}, .after = {}},
                      {.name = "head", .bodies = {2}, .X_WB = {}, .after = {0}}};
    scene_.assembly = assembly;
    state_.goals.resize(2);
    desk_ = std::make_unique<GuideDesk>(scene_, true, [this] { return bus_.orderPost(); });
    desk_->start(kGuidedRun);
    sender_ = bus_.orderSender();
  }

  /// One publication, 5 ms after the last.
  void publish() {
    const Stamp stamp{kGuidedRun, ++sequence_, 0.005 * static_cast<double>(sequence_), monotonicNs()};
    desk_->show(stamp, state_);
    desk_->serve(stamp, state_);
    for (GuideStatus& status : sender_->take()) status_ = std::move(status);
  }
  GuideOrder order(std::int32_t first = kNoBody, std::int32_t second = kNoBody) {
    GuideOrder order{kGuidedRun, kGuide, ++number_, sequence_};
    order.undone = status_.undone;
    order.draws = {first, second};
    return order;
  }
  /// Publishes once more, so that the status tells.
  OrderRefusal answerTo(const GuideOrder& order) {
    sender_->send(order);
    publish();
    publish();
    return status_.refused_guide == order.guide ? status_.refusal : OrderRefusal::kNone;
  }
  void waitInSilence() {
    sleepUntilNs(monotonicNs() + static_cast<std::int64_t>(1.05e9 * GuideDesk::kSilence));
    publish();
    publish();
  }
  std::int32_t ordered(std::size_t goal) const { return desk_->orders().draws[goal].body; }
  std::size_t notesAbout(const std::string& word) {
    const std::vector<std::string> notes = desk_->takeNotes();
    return static_cast<std::size_t>(
        std::ranges::count_if(notes, [&](const std::string& note) { return note.find(word) != std::string::npos; }));
  }

  Scene scene_;
  AssemblyState state_;
  LocalBus bus_;
  std::unique_ptr<GuideDesk> desk_;
  std::unique_ptr<OrderSender> sender_;
  GuideStatus status_;
  std::uint64_t sequence_ = 0, number_ = 0;
};

TEST_F(GuideDeskTest, FollowsTheFirstGuideAndTellsTheSecond) {
  publish();
  EXPECT_EQ(status_.lead, 0u);
  EXPECT_EQ(answerTo(order(kDrumB)), OrderRefusal::kNone);
  EXPECT_EQ(status_.lead, kGuide);
  EXPECT_EQ(ordered(0), kDrumB);
  GuideOrder second = order(kDrumA);
  second.guide = kOther;
  EXPECT_EQ(answerTo(second), OrderRefusal::kOtherGuide);
  EXPECT_EQ(status_.refused_guide, kOther);
  EXPECT_EQ(status_.lead, kGuide);
  EXPECT_EQ(ordered(0), kDrumB);
  EXPECT_EQ(notesAbout("a second guide was refused"), 1u);
}

TEST_F(GuideDeskTest, AnOrderOfAnotherRunIsNotHeard) {
  publish();
  GuideOrder wrong = order(kDrumA);
  wrong.run = kGuidedRun + 1;
  EXPECT_EQ(answerTo(wrong), OrderRefusal::kNone);
  EXPECT_EQ(status_.lead, 0u);
  EXPECT_EQ(ordered(0), kNoBody);
}

TEST_F(GuideDeskTest, RefusesBodiesThatAreNoneAndGoalsThatAreNot) {
  publish();
  for (const std::int32_t body : {kGround, kCapital, 4, 1000000, -2, -1000000})
    EXPECT_EQ(answerTo(order(body)), OrderRefusal::kWrongBody) << body;
  GuideOrder more = order(kDrumA);
  more.draws.push_back(kNoBody);
  EXPECT_EQ(answerTo(more), OrderRefusal::kWrongGoals);
  more.draws.clear();
  more.number = ++number_;
  EXPECT_EQ(answerTo(more), OrderRefusal::kWrongGoals);
  EXPECT_EQ(status_.lead, 0u) << "who sends such orders does not lead";
  EXPECT_EQ(ordered(0), kNoBody);
}

TEST_F(GuideDeskTest, LateAndForgedNumbersHaveNoEffect) {
  publish();
  answerTo(order(kDrumA));
  const GuideOrder before = order(kDrumB);
  EXPECT_EQ(answerTo(order(kDrumA)), OrderRefusal::kNone);
  EXPECT_EQ(answerTo(before), OrderRefusal::kNone) << "overtaken";
  EXPECT_EQ(ordered(0), kDrumA);
  GuideOrder ahead = order(kDrumB);
  ahead.number += 100000;
  EXPECT_EQ(answerTo(ahead), OrderRefusal::kOutOfOrder);
  GuideOrder early = order(kDrumB);
  early.on = sequence_ + 10;
  EXPECT_EQ(answerTo(early), OrderRefusal::kOutOfOrder);
  GuideOrder undoes = order(kDrumB);
  undoes.undone = 3;
  EXPECT_EQ(answerTo(undoes), OrderRefusal::kOutOfOrder);
  GuideOrder old = order(kDrumB);
  for (std::uint64_t i = 0; i <= GuideDesk::kOldest; ++i) publish();
  EXPECT_EQ(answerTo(old), OrderRefusal::kLate);
  EXPECT_EQ(ordered(0), kDrumA);
  EXPECT_EQ(desk_->orders().undone, 0);
  EXPECT_EQ(answerTo(order(kDrumB)), OrderRefusal::kLate) << "the last refusal stays in the status";
  EXPECT_EQ(ordered(0), kDrumB) << "and the next genuine order acts";
}

// A flood costs the run a bounded time, and cannot push the guide out.
TEST_F(GuideDeskTest, AFloodIsCutOff) {
  publish();
  answerTo(order(kDrumA));
  for (std::size_t i = 0; i < 10 * GuideDesk::kMostAtOnce; ++i) {
    GuideOrder forged = order(kDrumB);
    forged.guide = kOther + i;
    sender_->send(forged);
  }
  EXPECT_EQ(answerTo(order(kDrumB)), OrderRefusal::kNone);
  EXPECT_EQ(status_.refusal, OrderRefusal::kOtherGuide);
  EXPECT_EQ(status_.lead, kGuide);
  EXPECT_EQ(ordered(0), kDrumB);
  EXPECT_EQ(notesAbout("refused"), 1u);
  for (std::size_t i = 0; i < 2 * GuideDesk::kMostAtOnce; ++i) sender_->send(order(kDrumA));
  EXPECT_EQ(answerTo(order(kDrumB)), OrderRefusal::kTooMany) << "in the name of the guide";
  EXPECT_EQ(status_.lead, kGuide);
}

TEST_F(GuideDeskTest, UndoesOnceAndNotTooFast) {
  publish();
  answerTo(order());
  GuideOrder undo = order();
  undo.undone = 1;
  sender_->send(undo);
  for (int i = 0; i < 3; ++i) {  // repeated
    undo.number = ++number_;
    sender_->send(undo);
    publish();
  }
  EXPECT_EQ(desk_->orders().undone, 1);
  undo.undone = 2;
  undo.number = ++number_;
  sender_->send(undo);
  publish();
  EXPECT_EQ(desk_->orders().undone, 1) << "too early";
  for (double s = 0; s < GuideDesk::kUndoEvery; s += 0.005) publish();
  undo.number = ++number_;
  undo.on = sequence_;
  sender_->send(undo);
  publish();
  EXPECT_EQ(desk_->orders().undone, 2);
}

// Whoever comes after a guide that died leads; nothing that was ordered is withdrawn by the silence.
TEST_F(GuideDeskTest, ASilentGuideLosesTheLead) {
  publish();
  answerTo(order(kDrumA));
  EXPECT_EQ(notesAbout("a viewer guides the assembly"), 1u);
  waitInSilence();
  EXPECT_EQ(status_.lead, 0u);
  EXPECT_EQ(ordered(0), kDrumA);
  EXPECT_EQ(notesAbout("fell silent"), 1u);
  GuideOrder second = order(kDrumA);
  second.guide = kOther;
  second.number = 1;
  EXPECT_EQ(answerTo(second), OrderRefusal::kNone);
  EXPECT_EQ(status_.lead, kOther);
  EXPECT_EQ(notesAbout("taken over"), 1u);
  EXPECT_NE(desk_->summary().find("1 times silent"), std::string::npos) << desk_->summary();
}

// What it tells its user arrives once, and indices that name nothing do not arrive.
TEST_F(GuideDeskTest, PassesOnWhatTheGuideTells) {
  using Kind = GuideEvent::Kind;
  publish();
  GuideOrder tells = order();
  tells.says.placed = 1;
  tells.says.body = kCapital;
  tells.says.goal = 5;
  tells.says.elapsed = std::numeric_limits<double>::quiet_NaN();
  tells.told = 3;
  tells.events = {{Kind::kTaken, 1, kNoGoal, kCapital}, {Kind::kPlaced, 2, 1, kCapital}, {Kind::kPlaced, 3, 9, 77}};
  answerTo(tells);
  EXPECT_EQ(desk_->report().now.body, kCapital);
  EXPECT_EQ(desk_->report().now.goal, kNoGoal);
  EXPECT_EQ(desk_->report().now.all, 2);
  EXPECT_EQ(desk_->report().now.elapsed, 0);
  EXPECT_EQ(desk_->report().told, 2u);
  tells.number = ++number_;  // the same events once more, and a new one
  tells.told = 4;
  tells.events.push_back({Kind::kDropped, 4, kNoGoal, kDrumA});
  answerTo(tells);
  ASSERT_EQ(desk_->report().told, 3u);
  EXPECT_EQ(desk_->report().events[2].kind, Kind::kDropped);
  EXPECT_EQ(desk_->report().events[1].goal, 1);
}

// Captions name the body of the news.
TEST_F(GuideDeskTest, NewsWithoutABodyIsNotShown) {
  using Kind = GuideEvent::Kind;
  publish();
  GuideOrder tells = order();
  for (const GuideEvent& wrong : {GuideEvent{Kind::kHint, 1, 0, kNoBody}, GuideEvent{Kind::kFinished, 1},
                                  GuideEvent{Kind::kTaken, 1, kNoGoal, kDrumA}, GuideEvent{Kind::kDropped, 1}}) {
    tells.number = ++number_;
    tells.says.news = wrong;
    answerTo(tells);
    EXPECT_FALSE(desk_->report().now.news) << static_cast<int>(wrong.kind);
  }
  tells.number = ++number_;
  tells.says.news = GuideEvent{Kind::kDropped, 1, kNoGoal, kDrumA};
  answerTo(tells);
  EXPECT_TRUE(desk_->report().now.news);
}

// A guide that was not heard for long, as while the run was paused, has gone on counting.
TEST_F(GuideDeskTest, AGuideThatCountedOnUnheardLeadsAgain) {
  publish();
  answerTo(order(kDrumA));
  number_ += 100000;
  EXPECT_EQ(answerTo(order(kDrumB)), OrderRefusal::kOutOfOrder) << "as long as it leads, such a number may be forged";
  waitInSilence();
  EXPECT_EQ(status_.lead, 0u);
  answerTo(order(kDrumB));
  EXPECT_EQ(status_.lead, kGuide);
  EXPECT_EQ(ordered(0), kDrumB);
}

// The first guide leads again after another: what it told before, and what the other one told, is not told once more.
TEST_F(GuideDeskTest, EventsAreToldOnceWhateverGuideLeads) {
  using Kind = GuideEvent::Kind;
  publish();
  GuideOrder first = order();
  first.events = {{Kind::kTaken, 0.001, kNoGoal, kDrumA}, {Kind::kPlaced, 0.002, 0, kDrumA}};
  first.told = 2;
  answerTo(first);
  waitInSilence();
  GuideOrder second = order();
  second.guide = kOther;
  second.events = {{Kind::kPlaced, 0.004, 1, kCapital}, {Kind::kFinished, 0.004}};
  second.told = 2;
  answerTo(second);
  EXPECT_EQ(desk_->report().told, 4u);
  waitInSilence();
  first.number = ++number_;
  first.on = sequence_;
  first.events.push_back({Kind::kFinished, 0.01});
  first.events.push_back({Kind::kUndone, 0.01, 1, kCapital});
  first.told = 4;
  answerTo(first);
  ASSERT_EQ(desk_->report().told, 5u);
  EXPECT_EQ(desk_->report().events[4].kind, Kind::kUndone);
  first.number = ++number_;
  first.on = sequence_;
  first.events.push_back({Kind::kPlaced, 0.02, 1, kCapital});
  first.events.push_back({Kind::kFinished, 0.02});
  first.told = 6;
  answerTo(first);
  EXPECT_EQ(desk_->report().told, 7u) << "all stands once more";
}

// A recording keeps up with the changes of draws: one for each haptic tick. The rest of an order waits.
TEST_F(GuideDeskTest, ManyDrawsBeginOneAfterTheOther) {
  const int many = 2 * GuideDesk::kMostChanges + 1;
  scene_.bodies.resize(static_cast<std::size_t>(many));
  scene_.assembly->goals.clear();
  for (std::size_t g = 0; g < scene_.bodies.size(); ++g)
    scene_.assembly->goals.push_back({.name = "goal", .bodies = {g}, .X_WB = {}, .after = {}});
  state_.goals.resize(scene_.bodies.size());
  desk_ = std::make_unique<GuideDesk>(scene_, true, [this] { return bus_.orderPost(); });
  desk_->start(kGuidedRun);
  publish();
  for (const int begun : {GuideDesk::kMostChanges, 2 * GuideDesk::kMostChanges, many}) {
    GuideOrder all = order();
    all.draws.clear();
    for (std::int32_t body = 0; body < many; ++body) all.draws.push_back(body);
    sender_->send(all);
    publish();
    EXPECT_EQ(std::ranges::count_if(desk_->orders().draws, [](const auto& draw) { return draw.body != kNoBody; }),
              begun);
  }
}

/// Repeats an order on the first publication whenever it is asked, as a guide that missed all others.
class BehindPost final : public OrderPost {
 public:
  static constexpr int kAtMost = 200'000;  // 10 s of the desk's looks, so that the test ends
  explicit BehindPost(int& asked) : asked_(asked) {}
  void show(const GuideStatus&) noexcept override {}
  std::vector<GuideOrder> take() override {
    if (++asked_ > kAtMost) return {};
    GuideOrder order{kGuidedRun, kGuide, static_cast<std::uint64_t>(asked_), 1};
    order.draws = {kNoBody, kNoBody};
    return {order};
  }

 private:
  int& asked_;
};

TEST_F(GuideDeskTest, AGuideThatStaysBehindDoesNotHoldALockstepRun) {
  int asked = 0;
  GuideDesk desk(scene_, false, [&] { return std::make_unique<BehindPost>(asked); });
  desk.start(kGuidedRun);
  desk.serve({kGuidedRun, 1, 0.005, 0}, state_);
  desk.serve({kGuidedRun, 2, 0.01, 0}, state_);
  EXPECT_LT(asked, BehindPost::kAtMost);
  EXPECT_NE(desk.summary().find("1 times silent"), std::string::npos) << desk.summary();
}

}  // namespace
}  // namespace presa::bus
