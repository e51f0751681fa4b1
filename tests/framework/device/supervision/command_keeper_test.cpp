#include "framework/device/supervision/command_keeper.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace presa {
namespace {

constexpr double kPeriod = 0.25e-3;  // [s]

constexpr DeviceRating kRating{.force = 8, .force_rate = 1000, .speed = 1, .soft_start = 0.5};

class Keeper : public testing::Test {
 protected:
  /// Runs `steps` cycles with a fresh command in every fourth; records the largest force and the largest change.
  void command(const Vec3& force, int steps) {
    for (int i = 0; i < steps; ++i) step({.fresh = i % 4 == 0, .command = force});
  }
  void silence(int steps) {
    for (int i = 0; i < steps; ++i) step({.command = kWanted});
  }
  void step(const CommandKeeper::Input& input) {
    const Vec3 before = keeper_.last().f;
    const Vec3 force = keeper_.step(input, kPeriod).f;
    EXPECT_LE((force - before).norm(), 1000 * kPeriod * (1 + 1e-12));
  }
  double force() const { return keeper_.last().f.norm(); }
  /// Pressed with the whole force: first zero, then half a second of soft start.
  void press() {
    command(Vec3::Zero(), 4);
    command(kWanted, 2400);
    ASSERT_DOUBLE_EQ(force(), 4);
  }

  static inline const Vec3 kWanted{0, 0, 4};
  CommandKeeper keeper_{kRating};
};

TEST_F(Keeper, SendsNothingBeforeACommandOfZero) {
  command(kWanted, 4000);
  EXPECT_EQ(force(), 0);
  EXPECT_TRUE(keeper_.dropped());
}

TEST_F(Keeper, PassesForcesOnAfterASoftStart) {
  command(Vec3::Zero(), 4);
  command(kWanted, 1000);  // half of the soft start
  EXPECT_NEAR(force(), 2, 0.01);
  command(kWanted, 1400);
  EXPECT_DOUBLE_EQ(force(), 4);
}

TEST_F(Keeper, HoldsThroughALateTick) {
  press();
  silence(16);  // the last command is 4.75 ms old then
  EXPECT_DOUBLE_EQ(force(), 4);
  command(kWanted, 4);
  EXPECT_DOUBLE_EQ(force(), 4);
}

TEST_F(Keeper, IsAtZeroTenMillisecondsAfterTheLastCommand) {
  press();
  silence(40);
  EXPECT_EQ(force(), 0);
}

// A keeper that was held up for 6 ms itself: the command is older than 5 ms then, and one haptic tick's worth of the
// way is made up.
TEST_F(Keeper, WhoWasHeldUpHimselfDropsNoLater) {
  press();
  keeper_.step({.command = kWanted}, 6e-3);
  EXPECT_TRUE(keeper_.dropped());
  EXPECT_DOUBLE_EQ(force(), 3);
}

// Any command is limited to the device's rating: 1e9 N in one write, a thousand times in alternating directions.
TEST_F(Keeper, HoldsTheRatingWhateverIsCommanded) {
  command(Vec3::Zero(), 4);
  int at_rating = 0, at_slew = 0;
  for (int i = 0; i < 4000; ++i) {
    const double before = keeper_.last().f.z();
    step({.fresh = true, .command = Vec3(0, 0, i / 100 % 2 == 0 ? 1e9 : -1e9)});
    ASSERT_LE(force(), kRating.force);
    at_rating += force() == kRating.force ? 1 : 0;
    at_slew += std::abs(keeper_.last().f.z() - before) > 0.999 * kRating.force_rate * kPeriod ? 1 : 0;
  }
  EXPECT_GT(at_rating, 500);
  EXPECT_GT(at_slew, 500);
}

// The hand is driven faster than the rating's 1 m/s: latched here too, whatever the rig said to the program's stage.
TEST_F(Keeper, TripsAtTheRatingsSpeed) {
  press();
  FingerInput fast;
  fast.v_WH = {0, 0, 1.01};
  for (int i = 0; i < 2; ++i) step({.fresh = true, .command = kWanted, .finger = fast});
  command(Vec3::Zero(), 40);
  command(kWanted, 400);
  EXPECT_EQ(force(), 0);
}

TEST_F(Keeper, OpensAgainAtZeroOnly) {
  press();
  silence(200);
  command(kWanted, 4000);  // the program returns without starting at zero
  EXPECT_EQ(force(), 0);
  command(Vec3::Zero(), 4);
  command(kWanted, 4);
  EXPECT_GT(force(), 0);
  EXPECT_LT(force(), 0.05);
}

TEST_F(Keeper, NeverTrustsADeadProgramAgain) {
  press();
  step({.alone = true, .command = kWanted});
  EXPECT_LT(force(), 4);
  command(kWanted, 16);
  EXPECT_EQ(force(), 0);
  command(Vec3::Zero(), 400);
  command(kWanted, 400);
  EXPECT_EQ(force(), 0);
}

TEST_F(Keeper, DoesNotBelieveEveryCommand) {
  press();
  command({0, 0, 1e300}, 40);
  EXPECT_DOUBLE_EQ(force(), 8);  // the device's rating
  command({0, std::numeric_limits<double>::quiet_NaN(), 0}, 40);
  EXPECT_EQ(force(), 0);  // latched
  command(Vec3::Zero(), 4);
  command(kWanted, 400);
  EXPECT_EQ(force(), 0);
  keeper_.rearm();
  command(kWanted, 400);
  EXPECT_GT(force(), 0);
}

TEST_F(Keeper, ADeviceThatIsLostLatches) {
  press();
  FingerInput gone;
  gone.lost = true;
  step({.fresh = true, .command = kWanted, .finger = gone});
  command(kWanted, 40);
  EXPECT_EQ(force(), 0);
}

}  // namespace
}  // namespace presa
