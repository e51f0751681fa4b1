// A subject is data: it must be the same wherever it is drawn, and each number must state its source.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "devices/simulated_subject/model/traits.h"

namespace presa::subject {
namespace {

constexpr Level kLevels[] = {Level::kL0, Level::kL1, Level::kL2};

TEST(Traits, EachHasANameOfItsOwnAUnitASourceAndAPlace) {
  std::set<std::string_view> names;
  Traits traits;
  for (const Trait& trait : Population(Level::kL1).traits()) {
    EXPECT_TRUE(names.insert(trait.name).second) << trait.name;
    EXPECT_FALSE(trait.unit.empty()) << trait.name;
    EXPECT_FALSE(trait.source.empty()) << trait.name;
    EXPECT_EQ(traits.*trait.value, 0) << trait.name << " shares its place";
    traits.*trait.value = 1;
  }
  EXPECT_EQ(names.size() * sizeof(double), sizeof(Traits)) << "a trait without a line";
}

TEST(Traits, LevelsAreNamedBothWays) {
  for (const Level level : kLevels) EXPECT_EQ(levelNamed(nameOf(level)), level);
  EXPECT_FALSE(levelNamed("L3"));
}

// A level changes the mechanism, not the person: all other traits must be equal.
TEST(Traits, TheSameSeedAndSubjectGiveTheSamePersonAtEveryLevel) {
  const std::set<std::string_view> mechanism{"finger_resolution", "position_noise", "muscle_time"};
  const Traits base = Population(Level::kL0).draw(7, 2);
  for (const Level level : kLevels) {
    const Population population(level);
    const Traits traits = population.draw(7, 2);
    for (const Trait& trait : population.traits()) {
      if (mechanism.contains(trait.name)) continue;
      EXPECT_EQ(traits.*trait.value, base.*trait.value) << trait.name;
    }
  }
  const Traits l1 = Population(Level::kL1).draw(7, 2), l2 = Population(Level::kL2).draw(7, 2);
  EXPECT_EQ(base.finger_resolution, 0);
  EXPECT_EQ(l1.finger_resolution, 0.2e-3);
  EXPECT_GT(l1.muscle_time, 0);
  EXPECT_EQ(l2.muscle_time, 0);
}

TEST(Traits, OneTraitHeldFixedLeavesTheOthersAsTheyWere) {
  Population population(Level::kL0);
  const Traits before = population.draw(3, 1);
  ASSERT_TRUE(population.set("force_cv", constant(0.06)));
  EXPECT_FALSE(population.set("forse_cv", constant(0.06)));
  const Traits after = population.draw(3, 1);
  EXPECT_EQ(after.force_cv, 0.06);
  for (const Trait& trait : population.traits()) {
    if (trait.name == "force_cv") continue;
    EXPECT_EQ(after.*trait.value, before.*trait.value) << trait.name;
  }
}

// Mean and spread over 4000 people within four standard errors (by chance 1 in 16 000; the seeds are fixed).
TEST(Traits, AreSpreadOverPeopleAsTheTableSays) {
  const Population population(Level::kL0);
  constexpr int kPeople = 4000;
  for (const Trait& trait : population.traits()) {
    const auto& [kind, a, b] = trait.spread;
    double mean = 0, squares = 0, low = INFINITY, high = -INFINITY;
    for (int subject = 0; subject < kPeople; ++subject) {
      const double drawn = population.draw(11, subject).*trait.value;
      const double value = kind == Spread::Kind::kLogNormal ? std::log(drawn) : drawn;
      mean += value / kPeople, squares += value * value / kPeople;
      low = std::min(low, drawn), high = std::max(high, drawn);
    }
    if (kind == Spread::Kind::kConstant) {
      EXPECT_EQ(low, a) << trait.name;
      EXPECT_EQ(high, a) << trait.name;
      continue;
    }
    const bool is_uniform = kind == Spread::Kind::kUniform;
    if (is_uniform) {
      EXPECT_GE(low, a) << trait.name;
      EXPECT_LT(high, b) << trait.name;
    }
    // |N(2, 0.5)|: folding changes its mean by 1e-5
    const double expected = is_uniform ? (a + b) / 2 : kind == Spread::Kind::kLogNormal ? std::log(a) : a;
    const double sd = is_uniform ? (b - a) / std::sqrt(12.0) : b;
    EXPECT_NEAR(mean, expected, 4 * sd / std::sqrt(kPeople)) << trait.name;
    // standard error of a standard deviation: sd sqrt((kurtosis - 1) / 4n), with a kurtosis of at most 3 here
    EXPECT_NEAR(std::sqrt(squares - mean * mean), sd, 4 * sd / std::sqrt(2.0 * kPeople)) << trait.name;
  }
}

}  // namespace
}  // namespace presa::subject
