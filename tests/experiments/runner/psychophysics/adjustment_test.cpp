#include "experiments/runner/psychophysics/adjustment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "experiments/runner/psychophysics/observer.h"

namespace presa::psychophysics {
namespace {

const AdjustmentPlan kPlan{.centre = 2,
                           .nearest = 0.5,
                           .farthest = 1.5,
                           .trials = 21,
                           .coarse = 0.25,
                           .fine = 0.03125,
                           .confirmations = 2,
                           .min = 0,
                           .max = 4};

TEST(Adjustment, HalfOfTheTrialsStartAboveAndHalfBelow) {
  int more_above = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Adjustment method(kPlan, RandomStream(seed, "starts"));
    int above = 0;
    while (!method.finished()) {
      const double offset = method.next()->level - 2;
      EXPECT_GE(std::abs(offset), 0.5);
      EXPECT_LE(std::abs(offset), 1.5);
      EXPECT_EQ(method.next()->track, offset > 0 ? 1U : 0U);
      above += offset > 0;
      method.respond({.value = 2});
    }
    EXPECT_TRUE(above == 10 || above == 11) << above;
    more_above += above == 11;
  }
  EXPECT_GT(more_above, 0);
  EXPECT_LT(more_above, 40);
}

// Bounds: five standard errors of the mean and of the SD over 4000 settings. The observer ignores the start, so the
// means from above and from below agree.
TEST(Adjustment, SettingsRecoverTheObserver) {
  AdjustmentPlan plan = kPlan;
  plan.trials = 4000;
  plan.min = -100, plan.max = 100;
  Adjustment method(plan, RandomStream(1, "starts"));
  const Observer observer({.location = 2.2, .spread = 0.4}, Coding::kGreater, 9);
  while (!method.finished()) method.respond(observer.answer(method));
  const Settings settings = method.settings();
  EXPECT_EQ(settings.n, 4000U);
  EXPECT_NEAR(settings.mean, 2.2, 5 * 0.4 / std::sqrt(4000));
  EXPECT_NEAR(settings.sd, 0.4, 5 * 0.4 / std::sqrt(8000));
  EXPECT_NEAR(settings.mean_from_below, settings.mean_from_above, 5 * 0.4 * std::sqrt(2.0 / 2000));
}

TEST(Adjustment, SettingsByHand) {
  Adjustment method({.nearest = 1, .farthest = 2, .trials = 4, .coarse = 1, .fine = 1}, RandomStream(1, "starts"));
  EXPECT_TRUE(std::isnan(method.settings().mean_from_below));
  while (!method.finished()) method.respond({.value = method.next()->level < 0 ? 1.0 : 3.0});
  EXPECT_EQ(method.settings().mean, 2);
  EXPECT_DOUBLE_EQ(method.settings().sd, std::sqrt(4.0 / 3));
  EXPECT_EQ(method.settings().mean_from_below, 1);
  EXPECT_EQ(method.settings().mean_from_above, 3);
}

TEST(Adjustment, ASettingOutsideTheRangeIsRefused) {
  Adjustment method(kPlan, RandomStream(1, "starts"));
  for (const double wrong : {-0.1, 4.1, static_cast<double>(NAN)}) {
    EXPECT_THROW(method.respond({.value = wrong}), std::invalid_argument);
  }
  EXPECT_TRUE(method.trials().empty());
}

TEST(Adjustment, EveryMistakeIsNamed) {
  const AdjustmentPlan wrong{.centre = 1, .nearest = 2, .farthest = 1.5, .confirmations = 0, .min = 0};
  EXPECT_EQ(mistakes(wrong).size(), 5U);
  EXPECT_THROW(Adjustment(wrong, RandomStream(1, "starts")), std::invalid_argument);
}

TEST(Adjuster, FollowsTheKeysAndEndsWhenConfirmedInARow) {
  using enum AdjustmentKey;
  Adjuster adjuster(kPlan, 1.0);
  for (const AdjustmentKey key : {kUp, kUp, kDownFine, kConfirm, kUpFine, kDown}) adjuster.press(key);
  EXPECT_EQ(adjuster.level(), 1.25);
  adjuster.press(kConfirm);
  EXPECT_FALSE(adjuster.done()) << "a step in between starts the confirmation anew";
  adjuster.press(kConfirm);
  EXPECT_TRUE(adjuster.done());
  adjuster.press(kUp);
  EXPECT_EQ(adjuster.level(), 1.25);
}

TEST(Adjuster, StaysInItsRange) {
  Adjuster adjuster(kPlan, 3.9);
  adjuster.press(AdjustmentKey::kUp);
  EXPECT_EQ(adjuster.level(), 4);
  for (int i = 0; i < 20; ++i) adjuster.press(AdjustmentKey::kDown);
  EXPECT_EQ(adjuster.level(), 0);
}

}  // namespace
}  // namespace presa::psychophysics
