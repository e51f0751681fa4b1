// The driver against the model of the device, two independent implementations of one description. The forces that the
// model received are judged by its force watch (devices/falcon_model/force_watch.h), checked at the end of every test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/novint_falcon/kinematics.h"
#include "tests/devices/novint_falcon/model_bench.h"
#include "tests/support/effort.h"

namespace presa::falcon {
namespace {

using falcon_model::ReplyFate;
using falcon_model::UploadFault;
using testing::IsEmpty;

/// Rounding error of half a count per motor at the current pose [N].
double rounding(const ModelBench& bench) {
  return falcon_model::roundingOf(const_cast<Model&>(bench.model).grip().rates());
}

TEST(FalconOnModel, FromPowerOnToTheFirstForce) {
  ModelBench bench(withoutFirmware());
  bench.force = [](const LinkSample&) { return Vec3(0, 0, 2); };
  ASSERT_TRUE(bench.reach(LinkState::kHoming, 10));
  EXPECT_EQ(bench.link->status().load.attempts, 0);
  EXPECT_EQ(bench.model.processor().uploads(), 1);
  bench.run(1);
  EXPECT_EQ(bench.link->status().state, LinkState::kHoming) << "nobody has moved the grip";
  EXPECT_TRUE(bench.model.received().blue);
  bench.home();
  ASSERT_TRUE(bench.reach(LinkState::kOperating, 2));
  bench.run(1);
  EXPECT_TRUE(bench.model.received().green && bench.model.received().homing);
  EXPECT_NEAR((bench.felt() - Vec3(0, 0, 2)).norm(), 0, rounding(bench));
  // counters are whole numbers, and a count is 0.05 mm here
  EXPECT_NEAR((bench.link->sample().p_DH - bench.model.grip().position()).norm(), 0, 1e-4);
  EXPECT_THAT(bench.model.violations(), IsEmpty());
}

// Uploads sometimes fail, each time at another byte.
TEST(FalconOnModel, WrongEchoesAreTriedAgain) {
  for (const auto kind :
       {UploadFault::Kind::kCorruptByte, UploadFault::Kind::kWrongEcho, UploadFault::Kind::kLostEcho}) {
    ModelSettings settings = withoutFirmware();
    for (int attempt = 0; attempt < 9; ++attempt)
      settings.loader.faults.push_back({attempt, static_cast<std::size_t>(attempt * 1061), kind});
    settings.loader.zero_before = true;
    settings.loader.deaf_greetings = 3;
    ModelBench bench(settings);
    ASSERT_TRUE(bench.reach(LinkState::kHoming, 60));
    EXPECT_EQ(bench.link->status().load.attempts, 9);
    EXPECT_EQ(bench.model.processor().uploads(), 10);
    EXPECT_THAT(bench.model.violations(), IsEmpty());
  }
}

TEST(FalconOnModel, TenWrongEchoesAreEnough) {
  ModelSettings settings = withoutFirmware();
  for (int attempt = 0; attempt < 20; ++attempt)
    settings.loader.faults.push_back({attempt, 4711, UploadFault::Kind::kWrongEcho});
  ModelBench bench(settings);
  ASSERT_TRUE(bench.reach(LinkState::kDead, 120));
  EXPECT_EQ(bench.link->status().fault, LinkFault::kEchoMismatch);
  EXPECT_EQ(bench.link->status().load.bytes, 4711U);
  EXPECT_EQ(bench.model.processor().uploads(), 10);
  EXPECT_EQ(bench.model.requests(), 0);
}

TEST(FalconOnModel, FirmwareThatDoesNotRunIsSaid) {
  struct Case {
    std::vector<std::uint8_t> file;
    LinkFault fault;
  };
  std::vector<std::uint8_t> wrong = madeUpFirmware(), half = wrong, longer = wrong;
  wrong[5000] ^= 1;
  half.resize(half.size() / 2);
  longer.resize(longer.size() + 200);
  for (const Case& c : {Case{{}, LinkFault::kNoFirmware}, Case{wrong, LinkFault::kFirmwareSilent},
                        Case{half, LinkFault::kFirmwareSilent}, Case{longer, LinkFault::kEchoMissing}}) {
    ModelBench bench(withoutFirmware(), c.file);
    ASSERT_TRUE(bench.reach(LinkState::kDead, 200));
    EXPECT_EQ(bench.link->status().fault, c.fault) << describe(bench.link->status().fault);
    EXPECT_LE(bench.model.processor().uploads(), 10);
    EXPECT_EQ(bench.model.requests(), 0);
  }
}

TEST(FalconOnModel, ARefusedSettingIsSaid) {
  for (int nth = 1; nth <= 8; ++nth) {
    ModelBench bench(withoutFirmware());
    bench.model.refuseRequests(nth);
    ASSERT_TRUE(bench.reach(LinkState::kDead, 10)) << nth;
    EXPECT_EQ(bench.link->status().fault, LinkFault::kControlRefused);
  }
}

// A hand of 500 N/m with its target 10 mm inside a wall of 1000 N/m: two springs, F = K k/(K + k) x = 3.33 N. The wall
// sees whole counts: half a count is 25 um along z, 25 mN.
TEST(FalconOnModel, AHandPressedAgainstAWallFeelsTwoSprings) {
  ModelBench bench;
  constexpr double kWall = 0.120, kStiffness = 1000;
  bench.force = [](const LinkSample& sample) -> Vec3 {
    return {0, 0, sample.valid ? kStiffness * std::max(0.0, kWall - sample.p_DH.z()) : 0};
  };
  ASSERT_TRUE(bench.reach(LinkState::kOperating, 1));
  bench.handAt({0, 0, kWall - 0.010});
  bench.run(2);
  const double expected = kStiffness * 500 / (kStiffness + 500) * 0.010;
  EXPECT_NEAR(bench.model.received().force_D.z(), expected, 0.025 + rounding(bench));
  EXPECT_NEAR(bench.model.grip().position().z(), kWall - expected / kStiffness, 1e-4);
  EXPECT_LT(bench.model.grip().velocity().norm(), 0.005) << "at rest";
  EXPECT_THAT(bench.model.violations(), IsEmpty());
}

// 10 minutes at 1 kHz: one request per tick, exactly a millisecond apart.
TEST(FalconOnModel, TenMinutesWithoutDrift) {
  ModelBench bench;
  ASSERT_TRUE(bench.reach(LinkState::kOperating, 1));
  double first = -1;
  std::int64_t count = 0;
  double worst = 0, wrong = 0;
  bench.force = [&bench](const LinkSample&) -> Vec3 { return {0.5, 0, std::sin(bench.now())}; };
  bench.model.onRequest([&](const falcon_model::Received& request) {
    if (first < 0) first = request.time;
    worst = std::max(worst, std::abs(request.time - first - 1e-3 * static_cast<double>(count++)));
    if (count > 1000) wrong = std::max(wrong, (request.meant_D - bench.command.f_H_D).norm());
  });
  const std::int64_t ticks = bench.ticks;
  constexpr int kSeconds = unlessSanitized(600, 60);
  bench.run(kSeconds);
  EXPECT_NEAR(static_cast<double>(count), static_cast<double>(bench.ticks - ticks), 1);
  EXPECT_EQ(bench.ticks - ticks, kSeconds * 1000);
  EXPECT_LT(worst, 1e-6);  // accumulated rounding of the clock
  EXPECT_LT(wrong, 0.01);  // half a count per motor, and a change of 1 mN in a tick
  EXPECT_EQ(bench.link->status().rejected, 0U);
  EXPECT_THAT(bench.model.violations(), IsEmpty());
}

/// Applies a fault at 4 N until it is over; the force may vanish, and returns.
void survives(const char* what, const std::function<void(ModelBench&)>& fault, bool comes_back = true) {
  SCOPED_TRACE(what);
  ModelBench bench;
  bench.operate({1, 1, 3});
  fault(bench);
  bench.run(1);
  EXPECT_THAT(bench.model.violations(), IsEmpty());
  EXPECT_LE(bench.model.watch().largestStep(), 1.0 + 1e-9);
  if (!comes_back) return;
  EXPECT_NEAR((bench.felt() - Vec3(1, 1, 3)).norm(), 0, rounding(bench));
  EXPECT_EQ(bench.link->status().state, LinkState::kOperating);
}

TEST(FalconOnModel, SurvivesRepliesThatAreShortSplitMergedOrMissing) {
  RandomStream random(7, "replies");
  const auto forHalfASecond = [](ModelBench& bench, const std::function<void(ReplyFate&)>& fault) {
    bench.model.onReply(fault);
    bench.run(0.5);
    bench.model.onReply(nullptr);
  };
  const auto sometimes = [&](const std::function<void(ReplyFate&)>& fault) {
    return [&random, fault](ReplyFate& reply) {
      if (random.below(10) == 0) fault(reply);
    };
  };
  survives("one in ten cut to 14 bytes", [&](ModelBench& bench) {
    forHalfASecond(bench, sometimes([&](ReplyFate& reply) { shorten(reply, random); }));
    EXPECT_GT(bench.link->status().dropped, 100U);
  });
  survives("all cut to 14 bytes", [&](ModelBench& bench) {
    forHalfASecond(bench, [&](ReplyFate& reply) { shorten(reply, random); });
    EXPECT_FALSE(bench.link->sample().valid);
    EXPECT_EQ(bench.felt(), Vec3::Zero());
  });
  survives("one in ten split", [&](ModelBench& bench) {
    forHalfASecond(bench, sometimes([&](ReplyFate& reply) { split(reply, random); }));
    EXPECT_EQ(bench.link->status().dropped, 0U);
  });
  survives("one in ten merged with the next", [&](ModelBench& bench) {
    forHalfASecond(bench, sometimes([&](ReplyFate& reply) { reply.waits = true; }));
    EXPECT_EQ(bench.link->status().dropped, 0U);
  });
  survives("none for 0.2 s", [&](ModelBench& bench) {
    bench.model.mute(bench.now(), bench.now() + 0.2);
    bench.run(0.1);
    EXPECT_EQ(bench.felt(), Vec3::Zero());
    EXPECT_FALSE(bench.link->sample().valid);
  });
}

// Flipped bits never cause a force before homing or above a limit; an affected sample may latch.
TEST(FalconOnModel, SurvivesFlippedBits) {
  RandomStream random(8, "bits");
  for (int run = 0; run < 20; ++run) {
    survives(
        "flipped bits",
        [&](ModelBench& bench) {
          bench.model.onReply([&](ReplyFate& reply) {
            if (random.below(4) == 0) flipBits(reply, random, 1 + static_cast<int>(random.below(3)));
          });
        },
        false);
  }
}

// From 4 N: held at most 2 ms after the last reply was read, zero by 5 ms.
TEST(FalconOnModel, SilenceIsHeldTwoMillisecondsAndZeroByFive) {
  for (const double phase : {0.0, 0.25e-3, 0.5e-3, 0.75e-3}) {
    ModelBench bench;
    bench.operate({0, 0, 4});
    bench.run(phase);
    const double full = bench.felt().norm();
    std::uint64_t replies = bench.link->status().replies;
    bench.model.mute(bench.now(), bench.now() + 1);
    double last_reply = bench.now(), down = -1, zero = -1;
    bench.model.onRequest([&](const falcon_model::Received& request) {
      const double sent = request.time - 16 * 10 / 1.5e6;  // minus its transmission time
      if (down < 0 && request.meant_D.norm() < 0.99 * full) down = sent;
      if (zero < 0 && request.counts == std::array{0, 0, 0}) zero = sent;
    });
    for (int i = 0; i < 80; ++i) {
      bench.step();
      if (bench.link->status().replies > replies) last_reply = bench.now();
      replies = bench.link->status().replies;
    }
    ASSERT_GT(zero, 0);
    EXPECT_LE(down - last_reply, 2e-3 + 1e-6) << phase;
    EXPECT_LE(zero - last_reply, 5e-3 + 1e-6) << phase;
    EXPECT_THAT(bench.model.violations(), IsEmpty());
  }
}

TEST(FalconOnModel, ALostReferenceLatchesFromTheSameCycleOn) {
  for (const std::size_t encoder : {0UL, 1UL, 2UL}) {
    ModelBench bench;
    bench.operate({1, 1, 3});
    bench.model.grip().loseReference(encoder);
    bench.run(0.010);
    EXPECT_EQ(bench.link->status().fault, LinkFault::kHomingLost);
    EXPECT_TRUE(bench.link->sample().lost);
    EXPECT_EQ(bench.felt(), Vec3::Zero());
    bench.home();
    bench.run(2);
    EXPECT_EQ(bench.link->status().homed, 7U) << "found again";
    EXPECT_EQ(bench.felt(), Vec3::Zero()) << "and still latched";
    bench.link->rearm();
    bench.model.forgive();
    bench.run(1);
    EXPECT_NEAR((bench.felt() - Vec3(1, 1, 3)).norm(), 0, rounding(bench));
    EXPECT_THAT(bench.model.violations(), IsEmpty());
  }
}

TEST(FalconOnModel, AJumpOfTheEncodersLatches) {
  ModelBench bench;
  bench.operate({0, 0, 4});
  bench.model.grip().jump(1, 300);
  bench.run(0.010);
  EXPECT_EQ(bench.link->status().fault, LinkFault::kBadSamples);
  EXPECT_EQ(bench.felt(), Vec3::Zero());
  EXPECT_THAT(bench.model.violations(), IsEmpty());
}

TEST(FalconOnModel, PulledOutItIsLostAndBackItStartsFromTheBeginning) {
  ModelBench bench;
  bench.operate({0, 0, 4});
  bench.model.unplug(bench.now());
  bench.run(0.001);
  EXPECT_EQ(bench.link->status().fault, LinkFault::kLost);
  EXPECT_TRUE(bench.link->sample().lost);
  bench.model.plug(bench.now());
  bench.run(1);
  EXPECT_EQ(bench.link->status().state, LinkState::kDead);
  bench.connect();
  ASSERT_TRUE(bench.reach(LinkState::kHoming, 20)) << "firmware went with the power";
  EXPECT_EQ(bench.model.processor().uploads(), 1);
  bench.home();
  ASSERT_TRUE(bench.reach(LinkState::kOperating, 2));
  bench.run(1);
  EXPECT_NEAR((bench.felt() - Vec3(0, 0, 4)).norm(), 0, rounding(bench));
  EXPECT_THAT(bench.model.violations(), IsEmpty());
}

// When the program ends, the motors hold their force (the worst case); the next program starts from zero.
TEST(FalconOnModel, AProgramThatEndedLeavesTheForceAndTheNextTakesItAway) {
  ModelBench bench;
  bench.operate({0, 0, 4});
  bench.transport->lost();
  for (int i = 0; i < 400; ++i) ++bench.quarters;  // the link is not stepped for 0.1 s
  bench.model.advance(bench.now());
  EXPECT_TRUE(bench.model.holdsForce());
  EXPECT_NEAR(bench.model.quietFor(bench.now()), 0.1, 2e-3);
  bench.force = nullptr;
  bench.command = {};
  bench.connect();
  ASSERT_TRUE(bench.reach(LinkState::kOperating, 5));
  EXPECT_FALSE(bench.model.holdsForce());
}

TEST(FalconOnModel, ButtonsAndLightsAreThoseOfTheDevice) {
  ModelBench bench;
  bench.operate(Vec3::Zero());
  bench.model.buttons(2 | 8);
  bench.run(0.01);
  EXPECT_EQ(bench.link->sample().buttons, kButtonForward | kButtonMinus);
}

TEST(FalconOnModel, SameSeedSameForces) {
  const auto run = [] {
    RandomStream random(9, "same");
    ModelBench bench;
    bench.force = [](const LinkSample& sample) -> Vec3 { return 500 * (Vec3(0, 0, 0.125) - sample.p_DH); };
    bench.model.onReply([&](ReplyFate& reply) {
      if (random.below(20) == 0) shorten(reply, random);
    });
    std::vector<std::array<int, 3>> sent;
    bench.model.onRequest([&](const falcon_model::Received& request) { sent.push_back(request.counts); });
    bench.handAt({0.01, -0.01, 0.115});
    bench.run(2);
    return sent;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace presa::falcon
