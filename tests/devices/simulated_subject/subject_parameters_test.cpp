// A subject is data: it must be the same wherever it is drawn, and each number must state its source.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "devices/simulated_subject/model/subject_parameters.h"

namespace presa::subject {
namespace {

constexpr Level kLevels[] = {Level::kL0, Level::kL1, Level::kL2};

TEST(SubjectParameters, EachHasANameOfItsOwnAUnitASourceAndAPlace) {
  std::set<std::string_view> names;
  SubjectParameters parameters;
  const Population population(Level::kL1);
  for (const SubjectParameter& parameter : population.parameters()) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.unit.empty()) << parameter.name;
    EXPECT_FALSE(parameter.source.empty()) << parameter.name;
    EXPECT_EQ(parameters.*parameter.value, 0) << parameter.name << " shares its place";
    parameters.*parameter.value = 1;
  }
  EXPECT_EQ(names.size() * sizeof(double), sizeof(SubjectParameters)) << "a trait without a line";
}

TEST(SubjectParameters, LevelsAreNamedBothWays) {
  for (const Level level : kLevels) EXPECT_EQ(levelNamed(nameOf(level)), level);
  EXPECT_FALSE(levelNamed("L3"));
}

// A level changes the mechanism, not the person: all other parameters must be equal.
TEST(SubjectParameters, TheSameSeedAndSubjectGiveTheSamePersonAtEveryLevel) {
  const std::set<std::string_view> mechanism{"finger_resolution", "position_noise", "muscle_time"};
  const SubjectParameters base = Population(Level::kL0).draw(7, 2);
  for (const Level level : kLevels) {
    const Population population(level);
    const SubjectParameters parameters = population.draw(7, 2);
    for (const SubjectParameter& parameter : population.parameters()) {
      if (mechanism.contains(parameter.name)) continue;
      EXPECT_EQ(parameters.*parameter.value, base.*parameter.value) << parameter.name;
    }
  }
  const SubjectParameters l1 = Population(Level::kL1).draw(7, 2), l2 = Population(Level::kL2).draw(7, 2);
  EXPECT_EQ(base.finger_resolution, 0);
  EXPECT_EQ(l1.finger_resolution, 0.2e-3);
  EXPECT_GT(l1.muscle_time, 0);
  EXPECT_EQ(l2.muscle_time, 0);
}

TEST(SubjectParameters, OneParameterHeldFixedLeavesTheOthersAsTheyWere) {
  Population population(Level::kL0);
  const SubjectParameters before = population.draw(3, 1);
  ASSERT_TRUE(population.set("force_cv", constant(0.06)));
  EXPECT_FALSE(population.set("forse_cv", constant(0.06)));
  const SubjectParameters after = population.draw(3, 1);
  EXPECT_EQ(after.force_cv, 0.06);
  for (const SubjectParameter& parameter : population.parameters()) {
    if (parameter.name == "force_cv") continue;
    EXPECT_EQ(after.*parameter.value, before.*parameter.value) << parameter.name;
  }
}

// Mean and spread over 4000 people within four standard errors (by chance 1 in 16 000; the seeds are fixed).
TEST(SubjectParameters, AreSpreadOverPeopleAsTheTableSays) {
  const Population population(Level::kL0);
  constexpr int kPeople = 4000;
  for (const SubjectParameter& parameter : population.parameters()) {
    const auto& [kind, a, b] = parameter.spread;
    double mean = 0, squares = 0, low = INFINITY, high = -INFINITY;
    for (int subject = 0; subject < kPeople; ++subject) {
      const double drawn = population.draw(11, subject).*parameter.value;
      const double value = kind == Spread::Kind::kLogNormal ? std::log(drawn) : drawn;
      mean += value / kPeople, squares += value * value / kPeople;
      low = std::min(low, drawn), high = std::max(high, drawn);
    }
    if (kind == Spread::Kind::kConstant) {
      EXPECT_EQ(low, a) << parameter.name;
      EXPECT_EQ(high, a) << parameter.name;
      continue;
    }
    const bool is_uniform = kind == Spread::Kind::kUniform;
    if (is_uniform) {
      EXPECT_GE(low, a) << parameter.name;
      EXPECT_LT(high, b) << parameter.name;
    }
    // |N(2, 0.5)|: folding changes its mean by 1e-5
    const double expected = is_uniform ? (a + b) / 2 : kind == Spread::Kind::kLogNormal ? std::log(a) : a;
    const double sd = is_uniform ? (b - a) / std::sqrt(12.0) : b;
    EXPECT_NEAR(mean, expected, 4 * sd / std::sqrt(kPeople)) << parameter.name;
    // standard error of a standard deviation: sd sqrt((kurtosis - 1) / 4n), with a kurtosis of at most 3 here
    EXPECT_NEAR(std::sqrt(squares - mean * mean), sd, 4 * sd / std::sqrt(2.0 * kPeople)) << parameter.name;
  }
}

}  // namespace
}  // namespace presa::subject
