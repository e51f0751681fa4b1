#include <gtest/gtest.h>

#include <map>
#include <set>

#include "experiments/runner/definition/order.h"

// The guarantees of each kind of order, for many subjects and seeds.
namespace presa::experiment {
namespace {

Factor factor(const std::string& name, std::size_t levels, bool between = false) {
  Factor made{name, between, {{name, "", {}}}, {}};
  for (std::size_t i = 0; i < levels; ++i) made.levels.push_back({std::to_string(i)});
  return made;
}

Experiment grip() {
  Experiment experiment;
  experiment.factors = {factor("mass", 3), factor("friction", 3), factor("stiffness", 3)};
  experiment.design.repeats = 2;
  return experiment;
}

std::map<Condition, int> countOf(const std::vector<PlannedTrial>& trials) {
  std::map<Condition, int> count;
  for (const PlannedTrial& trial : trials) ++count[trial.condition];
  return count;
}

int immediateRepeats(const std::vector<PlannedTrial>& trials) {
  int count = 0;
  for (std::size_t i = 1; i < trials.size(); ++i) count += trials[i].condition == trials[i - 1].condition ? 1 : 0;
  return count;
}

TEST(Order, EveryConditionComesAsOftenAsAsked) {
  using Order = Design::Order;
  Experiment experiment = grip();
  for (const Order order :
       {Order::kListed, Order::kRandom, Order::kRandomRepeats, Order::kLatinSquare, Order::kBalancedSquare}) {
    experiment.design.order = order;
    for (int subject = 1; subject <= 30; ++subject) {
      const auto trials = planTrials(experiment, subject, 1);
      ASSERT_EQ(trials.size(), 54U);
      for (const auto& [condition, count] : countOf(trials)) ASSERT_EQ(count, 2);
      for (std::size_t i = 0; i < trials.size(); ++i) ASSERT_EQ(trials[i].number, static_cast<int>(i) + 1);
    }
  }
}

TEST(Order, EachRepeatHoldsEveryConditionOnce) {
  const auto trials = planTrials(grip(), 3, 1);
  for (const auto& part :
       {std::vector(trials.begin(), trials.begin() + 27), std::vector(trials.begin() + 27, trials.end())}) {
    EXPECT_EQ(countOf(part).size(), 27U);
    for (const PlannedTrial& trial : part) EXPECT_EQ(trial.block, part.front().repeat);
  }
}

TEST(Order, SameArgumentsGiveTheSameOrderAndOthersDoNot) {
  const Experiment experiment = grip();
  const auto conditions = [&](int subject, int session) {
    std::vector<Condition> all;
    for (const PlannedTrial& trial : planTrials(experiment, subject, session)) all.push_back(trial.condition);
    return all;
  };
  EXPECT_EQ(conditions(1, 1), conditions(1, 1));
  EXPECT_NE(conditions(1, 1), conditions(2, 1));
  EXPECT_NE(conditions(1, 1), conditions(1, 2));
  // practice has its own random stream: the order of the other trials does not change
  Experiment practised = experiment;
  practised.design.practice = 5;
  const auto with = planTrials(practised, 1, 1);
  ASSERT_EQ(with.size(), 59U);
  EXPECT_EQ(with[5].condition, planTrials(experiment, 1, 1)[0].condition);
}

TEST(Order, NoImmediateRepeatHoldsForEverySubject) {
  Experiment experiment;
  experiment.factors = {factor("level", 3)};
  experiment.design.repeats = 8;
  int without = 0;
  for (const auto order : {Design::Order::kRandom, Design::Order::kRandomRepeats}) {
    for (int subject = 1; subject <= 200; ++subject) {
      experiment.design.order = order;
      experiment.design.no_immediate_repeat = false;
      without += immediateRepeats(planTrials(experiment, subject, 1));
      experiment.design.no_immediate_repeat = true;
      const auto trials = planTrials(experiment, subject, 1);
      ASSERT_EQ(immediateRepeats(trials), 0) << subject;
      for (const auto& [condition, count] : countOf(trials)) ASSERT_EQ(count, 8);
    }
  }
  EXPECT_GT(without, 1000);  // otherwise the test would be trivial
}

TEST(Order, BlocksKeepOneLevelTogether) {
  Experiment experiment = grip();
  experiment.design.block_by = "friction";
  std::set<std::vector<std::size_t>> orders;
  for (int subject = 1; subject <= 20; ++subject) {
    std::map<int, std::set<std::size_t>> levels;
    std::vector<std::size_t> order;
    for (const PlannedTrial& trial : planTrials(experiment, subject, 1)) {
      if (levels[trial.block].insert(trial.condition[1]).second) order.push_back(trial.condition[1]);
    }
    ASSERT_EQ(levels.size(), 3U);
    for (const auto& [block, level] : levels) ASSERT_EQ(level.size(), 1U);
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 3U);
}

TEST(Order, SubjectsFillTheGroupsInTurn) {
  Experiment experiment;
  experiment.factors = {factor("cue", 2, true), factor("mass", 3), factor("hand", 3, true)};
  std::map<std::pair<std::size_t, std::size_t>, int> cells;
  for (int subject = 1; subject <= 12; ++subject) {
    const auto trials = planTrials(experiment, subject, 1);
    ASSERT_EQ(trials.size(), 3U);
    ++cells[{trials[0].condition[0], trials[0].condition[2]}];
  }
  ASSERT_EQ(cells.size(), 6U);
  for (const auto& [cell, count] : cells) EXPECT_EQ(count, 2);
}

TEST(LatinSquare, EachItemOnceInEachRowAndColumn) {
  for (std::size_t n = 1; n <= 9; ++n) {
    const auto square = latinSquare(n);
    for (std::size_t i = 0; i < n; ++i) {
      std::set<std::size_t> row, column;
      for (std::size_t j = 0; j < n; ++j) row.insert(square[i][j]), column.insert(square[j][i]);
      ASSERT_EQ(row.size(), n);
      ASSERT_EQ(column.size(), n);
    }
  }
}

// Williams design: over all rows each item follows each other item equally often, once for even n and twice for odd n.
TEST(LatinSquare, BalancedForWhatComesBefore) {
  for (std::size_t n = 2; n <= 9; ++n) {
    std::map<std::pair<std::size_t, std::size_t>, int> follows;
    std::map<std::pair<std::size_t, std::size_t>, int> stands;
    for (const auto& row : balancedSquare(n)) {
      ASSERT_EQ(row.size(), n);
      for (std::size_t i = 0; i < n; ++i) ++stands[{i, row[i]}];
      for (std::size_t i = 1; i < n; ++i) ++follows[{row[i - 1], row[i]}];
    }
    const int times = n % 2 == 0 ? 1 : 2;
    ASSERT_EQ(follows.size(), n * (n - 1));
    for (const auto& [pair, count] : follows) ASSERT_EQ(count, times) << n;
    for (const auto& [place, count] : stands) ASSERT_EQ(count, times) << n;
  }
}

}  // namespace
}  // namespace presa::experiment
