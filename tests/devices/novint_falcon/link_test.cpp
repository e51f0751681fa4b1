#include "devices/novint_falcon/link.h"

#include <gtest/gtest.h>

#include "framework/core/math/random.h"
#include "tests/devices/novint_falcon/hand_written_falcon.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/effort.h"

namespace presa::falcon {
namespace {

constexpr double kPeriod = 1e-3;
constexpr int kHomingBit = 1;

/// A link and its device in virtual time; in every tick the haptic thread commands `force`.
struct Bench {
  explicit Bench(const LinkSettings& settings = {}) : link(falcon, {}, settings) {
    falcon.homed = 0;
    link.open(0);
    while (link.status().state == LinkState::kStarting) tick();
    falcon.sent.clear();
  }

  void tick(double length = kPeriod) {
    time += length;
    if (commanding) commanded = time;
    link.step(time, {force, commanded});
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  /// Homed and past the soft start, with `wanted` on the grip.
  void operate(const Vec3& wanted) {
    force = wanted;
    falcon.homed = 7;
    ticks(700);
    ASSERT_EQ(link.status().state, LinkState::kOperating);
    ASSERT_TRUE(link.sample().valid);
  }
  const Counts& last() const { return falcon.sent.back().force; }

  HandWrittenFalcon falcon;
  FalconLink link;
  double time = 0;
  Vec3 force = Vec3::Zero();
  bool commanding = true;
  double commanded = 0;
};

// Homing moves the origin: a force computed across that jump would be violent.
TEST(FalconLink, NoForceUntilAllThreeFlagsCameTenTimesInARow) {
  Bench bench;
  bench.force = {3, 3, 3};
  for (const int flags : {0, 1, 3, 6, 5}) {
    bench.falcon.homed = flags;
    bench.ticks(50);
  }
  bench.falcon.homed = 7;
  bench.ticks(9);
  bench.falcon.homed = 3;  // one missing flag restarts the count
  bench.ticks(2);
  bench.falcon.homed = 7;
  const std::size_t homed_from = bench.falcon.sent.size();
  while (bench.falcon.sent.back().zero()) {
    bench.tick();
    ASSERT_LT(bench.falcon.sent.size(), homed_from + 100);
  }
  // the request after the tenth reply is the first with a force
  EXPECT_GE(bench.falcon.sent.size(), homed_from + 10 + 1);
  EXPECT_EQ(bench.link.status().state, LinkState::kOperating);
}

TEST(FalconLink, AGapInTheRepliesIsNotInARow) {
  Bench bench;
  bench.force = {3, 3, 3};
  bench.falcon.homed = 7;
  for (int i = 0; i < 20; ++i) {
    bench.ticks(8);
    bench.falcon.replies_to_swallow = 1;
    bench.ticks(2);
  }
  EXPECT_EQ(bench.link.status().state, LinkState::kHoming);
  EXPECT_TRUE(std::all_of(bench.falcon.sent.begin(), bench.falcon.sent.end(), [](auto& s) { return s.zero(); }));
}

TEST(FalconLink, EveryRequestAsksForHoming) {
  Bench bench;
  bench.operate({1, 0, 0});
  bench.falcon.homed = 0;
  bench.ticks(20);
  bench.link.release();
  bench.ticks(5);
  for (const auto& sent : bench.falcon.sent) {
    ASSERT_TRUE(sent.well_formed);
    ASSERT_TRUE(sent.light_and_homing & kHomingBit);
  }
}

// One request per period and one reply per request; never more than one in transit when the device is on time.
TEST(FalconLink, OneRequestEachPeriod) {
  Bench bench;
  bench.ticks(1000);
  ASSERT_EQ(bench.falcon.sent.size(), 1000U);
  for (std::size_t i = 1; i < bench.falcon.sent.size(); ++i)
    ASSERT_NEAR(bench.falcon.sent[i].time - bench.falcon.sent[i - 1].time, 1e-3, 1e-9);
}

TEST(FalconLink, SteppedOftenerItKeepsThePeriod) {
  Bench bench;
  for (int i = 0; i < 4000; ++i) bench.tick(0.25e-3);
  EXPECT_NEAR(static_cast<double>(bench.falcon.sent.size()), 1000, 1);
}

TEST(FalconLink, ForceStartsSoftlyAndArrivesInCounts) {
  Bench bench;
  bench.operate({2, -1, 3});
  const Vec3 p = *direct(thighAngles({0, 0, 0}));
  EXPECT_EQ(bench.last(), *motorCounts({2, -1, 3}, p));
  EXPECT_NEAR((bench.link.sample().p_DH - p).norm(), 0, 1e-12);
  // rises with 1 / 0.5 s: the change between requests is bounded by that, plus a count for rounding
  const double step = 3 / ForceGate::kSoftStart * kPeriod;
  for (std::size_t i = 1; i < bench.falcon.sent.size(); ++i) {
    for (std::size_t m = 0; m < 3; ++m)
      ASSERT_LE(std::abs(bench.falcon.sent[i].force[m] - bench.falcon.sent[i - 1].force[m]), 1000 * step + 1);
  }
}

// The output stage limits the slope too; here it is limited for any input.
TEST(FalconLink, AForceNeverRisesFasterThanTheRate) {
  Bench bench(LinkSettings{.rating = {.force = 8, .force_rate = 500}});
  bench.operate({0, 0, 0});
  const std::size_t from = bench.falcon.sent.size();
  bench.force = {0, 0, 6};
  bench.ticks(30);
  bench.force = {0, 0, -6};
  bench.ticks(30);
  EXPECT_EQ(bench.last()[0], -(*motorCounts({0, 0, 6}, bench.link.sample().p_DH))[0]);
  int steps = 0;
  for (std::size_t i = from; i < bench.falcon.sent.size(); ++i) {
    const int change = std::abs(bench.falcon.sent[i].force[0] - bench.falcon.sent[i - 1].force[0]);
    EXPECT_LE(change, 0.5 * 249.4 + 1);  // 0.5 N per period, 249.4 counts per newton
    steps += change > 0.4 * 249.4;
  }
  EXPECT_GE(steps, 30);
}

// The force falls from the same cycle on at the slew limit: sqrt(12) N in four requests.
TEST(FalconLink, AfterADroppedFlagForceGoesToZeroFromTheSameCycleAndStaysThere) {
  for (const int flags : {0, 3, 5, 6}) {
    Bench bench;
    bench.operate({2, 2, 2});
    ASSERT_FALSE(bench.falcon.sent.back().zero());
    bench.falcon.homed = flags;
    bench.tick();  // the reply to this request reports the dropped flag and arrives before the next
    const Vec3 full(2, 2, 2), p_DH = bench.link.sample().p_DH;
    for (const double left : {1.0, 2.0, 3.0}) {
      bench.tick();
      EXPECT_EQ(bench.last(), *motorCounts(full * (1 - left / full.norm()), p_DH)) << left;
      EXPECT_FALSE(bench.link.sample().valid);
      EXPECT_EQ(bench.link.status().fault, LinkFault::kHomingLost);
    }
    bench.tick();
    EXPECT_TRUE(bench.falcon.sent.back().zero());
    const std::size_t from = bench.falcon.sent.size();
    bench.falcon.homed = 7;  // the flag's return changes nothing
    bench.ticks(2000);
    for (std::size_t i = from; i < bench.falcon.sent.size(); ++i) ASSERT_TRUE(bench.falcon.sent[i].zero());
    EXPECT_EQ(bench.link.status().state, LinkState::kLatched);
    bench.link.rearm();
    bench.ticks(9);
    EXPECT_TRUE(bench.falcon.sent.back().zero());
    bench.ticks(700);
    EXPECT_EQ(bench.last(), *motorCounts({2, 2, 2}, bench.link.sample().p_DH));
  }
}

// The force is held for 1 to 2 ms after the last reply, then falls at the slew limit: from 4 N, zero is sent after 5
// ms. The sample becomes invalid after 2 ms, and the next force starts softly.
TEST(FalconLink, MissingRepliesTakeTheForceDown) {
  Bench bench;
  bench.operate({0, 0, 4});
  const Counts full = bench.last();
  bench.tick();  // the last one with a reply
  const double last_reply = bench.time + kPeriod;
  bench.falcon.replies_to_swallow = 20;
  const std::size_t from = bench.falcon.sent.size();
  for (int i = 0; i < 20; ++i) {
    bench.tick();
    EXPECT_EQ(bench.link.sample().valid, bench.time - last_reply <= 2e-3 + 1e-9) << i;
  }
  ASSERT_EQ(bench.falcon.sent.size(), from + 20);  // it keeps sending requests
  for (std::size_t i = from; i < bench.falcon.sent.size(); ++i) {
    const double age = bench.falcon.sent[i].time - last_reply;
    const double share = std::clamp((5e-3 - age) / 4e-3, 0.0, 1.0);
    EXPECT_NEAR(bench.falcon.sent[i].force[0], full[0] * share, 1) << age;
  }
  bench.ticks(3);
  EXPECT_TRUE(bench.link.sample().valid);
  EXPECT_LT(std::abs(bench.last()[0]), std::abs(full[0]) / 50);
  bench.ticks(600);
  EXPECT_EQ(bench.last(), full);
}

// One or two late replies are common: the force drops by 1 N for a request and returns at the slew limit.
TEST(FalconLink, AShortGapIsADip) {
  Bench bench;
  bench.operate({0, 0, 4});
  const Counts full = bench.last();
  bench.falcon.replies_to_swallow = 2;
  bench.ticks(3);
  EXPECT_NEAR(bench.last()[0], 0.75 * full[0], 1);
  bench.ticks(1);
  EXPECT_EQ(bench.last(), full);
}

TEST(FalconLink, OneLostReplyIsHeldOver) {
  Bench bench;
  bench.operate({0, 0, 4});
  const Counts full = bench.last();
  const std::size_t from = bench.falcon.sent.size();
  bench.falcon.replies_to_swallow = 1;
  bench.ticks(10);
  for (std::size_t i = from; i < bench.falcon.sent.size(); ++i) EXPECT_EQ(bench.falcon.sent[i].force, full);
  EXPECT_TRUE(bench.link.sample().valid);
}

// 25 counts on every encoder are about 1.2 mm along z; at 3 m/s the limit is 3 mm per period.
TEST(FalconLink, OneImpossibleSampleIsPassedOverTwoAreLatched) {
  for (const int bad : {1, 2}) {
    Bench bench;
    bench.operate({0, 0, 2});
    const Vec3 before = bench.link.sample().p_DH;
    int left = bad;
    bench.falcon.damage = [&](const Bytes& good) { return left-- > 0 ? replyOf({400, 400, 400}, 0xB1) : good; };
    for (int i = 0; i < 6; ++i) {
      bench.tick();
      EXPECT_EQ(bench.link.sample().p_DH, before);
    }
    EXPECT_EQ(bench.link.status().rejected, static_cast<std::uint64_t>(bad));
    EXPECT_EQ(bench.link.status().state, bad == 1 ? LinkState::kOperating : LinkState::kLatched);
    EXPECT_EQ(bench.falcon.sent.back().zero(), bad == 2);  // 2 N fall in two requests
    if (bad == 2) {
      EXPECT_EQ(bench.link.status().fault, LinkFault::kBadSamples);
    }
  }
}

TEST(FalconLink, CountsOfNoPositionAreImpossibleToo) {
  Bench bench;
  bench.operate({0, 0, 2});
  bench.falcon.damage = [](const Bytes&) { return replyOf({32767, -32768, 0}, 0xB1); };
  bench.ticks(4);
  EXPECT_EQ(bench.link.status().fault, LinkFault::kBadSamples);
  EXPECT_TRUE(bench.falcon.sent.back().zero());
}

TEST(FalconLink, AFastHandIsNoFault) {
  Bench bench;
  bench.operate({0, 0, 2});
  for (int i = 0; i < 500; ++i) {
    const int c = 20 * std::min(i % 100, 100 - i % 100);  // 0.95 m/s back and forth
    bench.falcon.encoders = {c, c, c};
    bench.tick();
    ASSERT_EQ(bench.link.status().rejected, 0U);
  }
  EXPECT_TRUE(bench.link.sample().valid);
}

// Steady motion along z by 2 counts per period: the velocity must match the positions after the filter has settled (3
// ms).
TEST(FalconLink, VelocityIsThatOfThePositions) {
  Bench bench;
  bench.operate({0, 0, 0});
  Vec3 before = bench.link.sample().p_DH;
  for (int i = 0; i < 60; ++i) {
    before = bench.link.sample().p_DH;
    bench.falcon.encoders = {2 * i, 2 * i, 2 * i};
    bench.tick();
  }
  const Vec3 steps = (bench.link.sample().p_DH - before) / kPeriod;
  EXPECT_GT(steps.z(), 0.08);
  // the mechanism slows down by 0.07 % per period here, and the filter lags by three and a half periods
  EXPECT_NEAR((bench.link.sample().v_DH - steps).norm(), 0, 0.005 * steps.norm());
}

TEST(FalconLink, AfterHomingThereIsNoVelocityOfTheJump) {
  Bench bench;
  bench.falcon.encoders = {-900, -900, -900};
  bench.ticks(20);
  bench.falcon.encoders = {300, -200, 100};
  bench.falcon.homed = 7;
  for (int i = 0; i < 40; ++i) {
    bench.tick();
    EXPECT_EQ(bench.link.sample().v_DH, Vec3::Zero());
  }
  ASSERT_TRUE(bench.link.sample().valid);
  EXPECT_EQ(bench.link.status().rejected, 0U);
  EXPECT_NEAR((bench.link.sample().p_DH * 1e3 - Vec3(14.528, -11.579, 136.148)).norm(), 0, 1e-3);
}

// After a new homing the origin may be anywhere: a jump of 80 mm within 12 ms is neither a motion nor a fault.
TEST(FalconLink, HomedAnewItForgetsWhereItWas) {
  Bench bench;
  bench.falcon.encoders = {-900, -900, -900};
  bench.operate({0, 0, 0});
  bench.falcon.homed = 3;
  bench.ticks(2);
  bench.falcon.homed = 7;
  bench.falcon.encoders = {900, 900, 900};
  bench.link.rearm();
  while (!bench.link.sample().valid) {
    bench.tick();
    ASSERT_EQ(bench.link.status().rejected, 0U);
  }
  EXPECT_EQ(bench.link.sample().v_DH, Vec3::Zero());
  EXPECT_GT(bench.link.sample().p_DH.z(), 0.16);
}

// A dead or blocked haptic thread: its last command is not applied for ever.
TEST(FalconLink, ACommandThatIsNotRenewedFades) {
  Bench bench;
  bench.operate({0, 0, 4});
  bench.commanding = false;
  bench.ticks(10);
  EXPECT_FALSE(bench.falcon.sent.back().zero());
  bench.ticks(4);  // 4 N
  EXPECT_TRUE(bench.falcon.sent.back().zero());
  EXPECT_TRUE(bench.link.sample().valid);
}

TEST(FalconLink, ACommandThatIsNotFiniteTakesTheForceDown) {
  const double bad[]{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  for (const double value : bad) {
    Bench bench;
    bench.operate({1, 1, 1});
    bench.force.x() = value;
    bench.ticks(2);  // sqrt(3) N at 1 N per request
    EXPECT_TRUE(bench.falcon.sent.back().zero());
    bench.force.x() = 1;
    bench.tick();
    EXPECT_LT(std::abs(bench.last()[0]), 10);  // starts softly
  }
}

TEST(FalconLink, UnpluggedNothingIsSentAnyMore) {
  Bench bench;
  bench.operate({1, 1, 1});
  bench.falcon.unplugged = true;
  bench.tick();
  EXPECT_FALSE(bench.link.sample().valid);
  EXPECT_EQ(bench.link.status().state, LinkState::kDead);
  EXPECT_EQ(bench.link.status().fault, LinkFault::kLost);
  const std::size_t sent = bench.falcon.sent.size();
  bench.falcon.unplugged = false;  // it does not come back by itself
  bench.link.rearm();
  bench.ticks(50);
  EXPECT_EQ(bench.falcon.sent.size(), sent);
}

TEST(FalconLink, ReleasedItGoesToZeroWhateverIsCommanded) {
  Bench bench;
  bench.operate({2, 2, 2});
  bench.link.release();
  const std::size_t from = bench.falcon.sent.size();
  bench.ticks(50);
  ASSERT_EQ(bench.falcon.sent.size(), from + 50);
  for (std::size_t i = from; i < bench.falcon.sent.size(); ++i)
    EXPECT_EQ(bench.falcon.sent[i].zero(), i >= from + 3);  // sqrt(12) N at 1 N per request
  EXPECT_FALSE(bench.link.sample().valid);
}

// A rejected write was not felt: the slope counts from the last request that was sent.
TEST(FalconLink, ABusyBusDoesNotMakeAStep) {
  Bench bench;
  bench.operate({0, 0, 0});
  bench.force = {0, 0, 8};
  for (int i = 0; i < 400; ++i) {
    bench.falcon.busy = i % 5 < 3;
    bench.tick(0.25e-3);
  }
  for (std::size_t i = 1; i < bench.falcon.sent.size(); ++i)
    ASSERT_LE(std::abs(bench.falcon.sent[i].force[0] - bench.falcon.sent[i - 1].force[0]), 249.4 + 1);
  EXPECT_GT(std::abs(bench.last()[0]), 1000);
}

TEST(FalconLink, ButtonsComeThrough) {
  Bench bench;
  bench.falcon.buttons = kButtonCentre | kButtonMinus;
  bench.ticks(3);
  EXPECT_EQ(bench.link.sample().buttons, kButtonCentre | kButtonMinus);
}

/// Random disturbances of a cycle; in one of eight cycles the reply is damaged or lost.
void disturb(Bench& bench, RandomStream& random) {
  HandWrittenFalcon& falcon = bench.falcon;
  falcon.busy = random.below(50) == 0;
  falcon.latency = random.uniform(0.1e-3, random.below(20) == 0 ? 5e-3 : 0.9e-3);
  falcon.damage = nullptr;
  bench.commanding = random.below(200) != 0;
  for (int axis = 0; axis < 3; ++axis)
    bench.force[axis] = random.below(100) == 0 ? std::bit_cast<double>(random.bits()) : 8 * random.normal();
  for (auto& encoder : falcon.encoders)
    encoder = std::clamp<std::int32_t>(encoder + static_cast<std::int32_t>(random.below(21)) - 10, -400, 400);
  if (random.below(8) != 0) return;
  switch (random.below(6)) {
    case 0:
      falcon.replies_to_swallow = static_cast<int>(random.below(6));
      break;
    case 1:
      falcon.damage = [&random](Bytes b) {
        b[random.below(16)] ^= static_cast<std::uint8_t>(1U << random.below(8));
        return b;
      };
      break;
    case 2:
      falcon.damage = [](Bytes b) {
        b.erase(b.begin() + 13, b.begin() + 15);
        return b;
      };
      break;
    case 3:
      falcon.damage = [&random](Bytes b) {
        b.resize(random.below(16));
        return b;
      };
      break;
    case 4:
      falcon.damage = [&random](Bytes b) {
        b.insert(b.begin() + static_cast<std::ptrdiff_t>(random.below(16)),
                 static_cast<std::uint8_t>(random.below(256)));
        return b;
      };
      break;
    default:
      falcon.damage = [&random](const Bytes&) {
        return replyOf(
            {static_cast<std::int32_t>(random.below(65536)), static_cast<std::int32_t>(random.below(65536)), 5}, 0xB1);
      };
  }
}

// Invariants at the wire in each of 10^6 disturbed cycles: packets are well formed, counts within range, the homing bit
// set. Outside operation there is no force: none before the first operation, and afterwards it only falls, a newton per
// request, to zero: eight requests from the rated 8 N, plus one for the rounding of counts.
TEST(FalconLink, AtTheWireTheInvariantsHoldWhateverGoesWrong) {
  RandomStream random(20262, "falcon link");
  Bench bench;
  std::uint64_t latched = 0, pushed = 0, going_down = 0, gone = 0;
  int outside = 0;  // requests in a row
  bool operated = false;
  double before = 0;
  constexpr unsigned kTicks = unlessSanitized(1'000'000U, 100'000U);
  for (unsigned i = 0; i < kTicks; ++i) {
    bench.falcon.homed = random.below(4000) == 0 ? static_cast<int>(random.below(7)) : 7;
    disturb(bench, random);
    bench.falcon.sent.clear();
    bench.tick();
    const LinkState state = bench.link.status().state;
    for (const auto& sent : bench.falcon.sent) {
      ASSERT_TRUE(sent.well_formed && (sent.light_and_homing & kHomingBit));
      for (const std::int32_t counts : sent.force) ASSERT_LE(std::abs(counts), kMaxCounts);
      const double counts = Vec3(sent.force[0], sent.force[1], sent.force[2]).norm();
      operated = operated || state == LinkState::kOperating;
      outside = state == LinkState::kOperating ? 0 : outside + 1;
      ASSERT_TRUE(state == LinkState::kOperating || counts <= before) << i;
      ASSERT_TRUE(operated || sent.zero()) << i;
      ASSERT_TRUE(outside <= 9 || sent.zero()) << i << ": " << outside << " requests outside operation";
      going_down += outside > 0 && !sent.zero() ? 1 : 0;
      gone += outside > 9 ? 1 : 0;
      before = counts;
      pushed += sent.zero() ? 0 : 1;
    }
    ASSERT_TRUE(bench.link.sample().p_DH.allFinite() && bench.link.sample().v_DH.allFinite());
    if (state == LinkState::kLatched && random.below(20) == 0) {
      ++latched;
      bench.link.rearm();
    }
  }
  EXPECT_GT(latched, kTicks / 1000);
  EXPECT_GT(pushed, kTicks / 10);
  EXPECT_GT(going_down, kTicks / 5000);
  EXPECT_GT(gone, kTicks / 1000);
}

TEST(FalconLink, SameInputSameBits) {
  const auto run = [] {
    RandomStream random(20263, "falcon same");
    Bench bench;
    for (int i = 0; i < 5000; ++i) {
      bench.falcon.homed = random.below(2000) == 0 ? 3 : 7;
      disturb(bench, random);
      bench.tick();
      if (random.below(500) == 0) bench.link.rearm();
    }
    std::vector<Counts> forces;
    for (const auto& sent : bench.falcon.sent) forces.push_back(sent.force);
    return forces;
  };
  EXPECT_EQ(run(), run());
}

/// Answers without allocating, so that any allocation is the link's.
class Metronome final : public FalconTransport {
 public:
  bool control(Control, double) noexcept override { return true; }
  bool write(std::span<const std::uint8_t>, double) noexcept override { return ++waiting_ > 0; }
  std::size_t read(std::span<std::uint8_t> buffer, double) noexcept override {
    if (waiting_ == 0) return 0;
    --waiting_;
    std::copy(reply_.begin(), reply_.end(), buffer.begin());
    return reply_.size();
  }
  bool lost() const noexcept override { return false; }

 private:
  Bytes reply_ = replyOf({1, 2, 3}, 0xB1);
  int waiting_ = 0;
};

TEST(FalconLink, InOperationNothingIsAllocatedOrLocked) {
  Metronome transport;
  FalconLink link(transport, {}, {});
  link.open(0);
  double time = 0;
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      time += kPeriod;
      link.step(time, {{1, 2, 3}, time});
    }
  };
  steps(50);
  ASSERT_EQ(link.status().state, LinkState::kOperating);
  RealTimeGuard guard;
  steps(1000);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa::falcon
