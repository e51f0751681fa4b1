#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/respondent.h"
#include "experiments/runner/definition/presentation.h"
#include "experiments/runner/definition/read.h"
#include "experiments/runner/definition/row.h"
#include "experiments/runner/definition/trial_source.h"
#include "tests/apps/experiment/contents.h"

// Psychophysical methods in an experiment file: presentations, questions, and the effect of answers.
namespace presa::experiment {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kFixtures = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/";

Experiment fixture(const std::string& name) {
  Diagnostics diagnostics;
  auto experiment = readExperiment(kFixtures + name, "", diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return std::move(*experiment);
}

/// The findings of reading the file with `from` replaced by `to`; it is written beside the fixture's scene.
std::string findings(const std::string& name, const std::string& from, const std::string& to) {
  std::string text = contentsOf(kFixtures + name);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string up = "../../../../experiments/";
  for (std::size_t i = text.find(up); i != std::string::npos; i = text.find(up))
    text.replace(i, up.size(), std::string(PRESA_SOURCE_DIR) + "/experiments/");
  const ScratchFolder scratch;
  std::ofstream(scratch.file(name)) << text;
  Diagnostics diagnostics;
  readExperiment(scratch.file(name), "", diagnostics);
  return diagnostics.text();
}

psychophysics::Response rightTwoTimesInThree(const TrialSource& source, int n) {
  return source.method()->responseFor(n % 3 != 0);
}

TEST(Procedure, PresentsStandardAndComparisonAtTheirPlaces) {
  const Experiment experiment = fixture("rub.xml");
  const auto source = makeTrialSource(experiment, 1, 1);
  int trials = 0;
  for (; const PlannedTrial* next = source->next(); ++trials) {
    const auto shown = presentationsOf(experiment, *next);
    ASSERT_EQ(shown.size(), 2U);
    const double comparison = 0.8 * std::exp(next->stimulus->level);
    const bool standard_first = next->stimulus->standard_place == 1;
    EXPECT_DOUBLE_EQ(shown[0].columns.back(), standard_first ? 0.8 : comparison);
    EXPECT_DOUBLE_EQ(shown[1].columns.back(), standard_first ? comparison : 0.8);
    const std::string coupled = shown[standard_first ? 0 : 1].sets.back();
    EXPECT_THAT(coupled, HasSubstr("material/plate/friction/dynamic=0.6"));
    source->finish(Outcome::kDone, rightTwoTimesInThree(*source, trials));
  }
  EXPECT_EQ(trials, 1 + 12);
}

TEST(Procedure, IsRebuiltFromItsOutcomes) {
  const Experiment experiment = fixture("rub.xml");
  const auto whole = makeTrialSource(experiment, 2, 1), again = makeTrialSource(experiment, 2, 1);
  for (int n = 0; const PlannedTrial* next = whole->next(); ++n) {
    const PlannedTrial* same = again->next();
    ASSERT_NE(same, nullptr);
    EXPECT_EQ(same->stimulus, next->stimulus);
    EXPECT_EQ(same->seed, next->seed);
    const Outcome outcome = n % 4 == 1 ? Outcome::kAborted : Outcome::kDone;
    const auto answer = rightTwoTimesInThree(*whole, n);
    again->finish(Outcome::kInterrupted);  // the same trial comes again
    EXPECT_EQ(again->next()->seed, next->seed);
    whole->finish(outcome, answer);
    again->finish(outcome, answer);
  }
  EXPECT_EQ(again->next(), nullptr);
}

TEST(Procedure, AnAbortedTrialComesAgainWithAnotherSeed) {
  const Experiment experiment = fixture("rub.xml");
  const auto source = makeTrialSource(experiment, 1, 1);
  source->finish(Outcome::kDone, source->method()->responseFor(true));  // a practice trial
  const PlannedTrial first = *source->next();
  source->finish(Outcome::kAborted);
  EXPECT_EQ(source->next()->number, first.number);
  EXPECT_EQ(source->next()->attempt, 2);
  EXPECT_NE(source->next()->seed, first.seed);
  EXPECT_EQ(source->done(), 1U);
}

TEST(Procedure, RowHoldsBothIntervals) {
  const Experiment experiment = fixture("rub.xml");
  std::vector<std::string> names;
  for (const RowColumn& column : rowColumns(experiment)) names.push_back(column.name);
  EXPECT_THAT(names,
              ElementsAre("mu_s_1", "mu_s_2", "level", "track", "catch_trial", "standard_place", "chosen", "positive",
                          "mu_felt_1", "mu_felt_2", "missed_ticks", "clipped_s", "device_lost_s", "most_force"));
  PlannedTrial trial = *makeTrialSource(experiment, 1, 1)->next();
  // names of a presentation: stimulus, four quality figures, the measure
  const std::vector<double> row = rowValues(experiment, trial, {{0.8, 3, 0, 0, 5, 0.61}, {1.6, 1, 0, 0, 7, 1.2}},
                                            psychophysics::Response{.positive = true, .chosen = 2});
  EXPECT_EQ(row[0], 0.8);
  EXPECT_EQ(row[1], 1.6);
  EXPECT_EQ(row[2], trial.stimulus->level);
  EXPECT_EQ(row[6], 2);
  EXPECT_EQ(row[7], 1);
  EXPECT_EQ(row[9], 1.2);
  EXPECT_EQ(row[10], 3);  // the larger of both
  EXPECT_EQ(row[13], 7);
}

TEST(Procedure, TellsWhatIsWrong) {
  EXPECT_THAT(findings("rub.xml", "stop_trials=\"6\"", ""), HasSubstr("stop_trials"));
  EXPECT_THAT(findings("rub.xml", "<staircase start=\"0.8\" steps=\"0.4 0.2\"",
                       "<adjustment nearest=\"0\" farthest=\"1\" trials=\"2\" coarse=\"1\" fine=\"1\"/><staircase "
                       "start=\"0.8\" steps=\"0.4 0.2\""),
              HasSubstr("error[E908]: <procedure> needs one method, found 2"));
  EXPECT_THAT(findings("rub.xml", "task=\"2ifc\"", "task=\"2afc\""),
              HasSubstr("2afc needs the path of the second place too"));
  EXPECT_THAT(findings("rub.xml", "percept=\"mu_felt\"", "percept=\"mu_fekt\""), HasSubstr("did you mean 'mu_felt'"));
  EXPECT_THAT(findings("rub.xml", "name=\"mu_s\"", "name=\"level\""), HasSubstr("error[E903]"));
  EXPECT_THAT(findings("rub.xml", "standard=\"0.8\"", "standard=\"0\""), HasSubstr("error[E909]"));
  EXPECT_THAT(findings("rub.xml", "steps=\"0.4 0.2\"", "steps=\"0.4 x\""),
              HasSubstr("must be one or more numbers, found 'x'"));
}

/// Share of answers "first" of the simulated observer in `n` trials with the given percepts.
double shareOfFirst(const Experiment& experiment, double first, double second, int n) {
  const auto observer = simulatedRespondent(experiment, 1);
  TrialResult a, b;
  a.values.assign(experiment.names.size(), first);
  b.values.assign(experiment.names.size(), second);
  const std::vector<TrialResult> shown{a, b};
  int count = 0;
  PlannedTrial trial = *makeTrialSource(experiment, 1, 1)->next();
  for (int i = 0; i < n; ++i) {
    trial.seed = static_cast<std::uint64_t>(i);
    count += observer->choose(trial, shown) == 1 ? 1 : 0;
  }
  return static_cast<double>(count) / n;
}

// Weber fraction 0.2: a ratio of 1.2 is discriminated in 75 % (0.745 with 2 % guesses); the question is "less".
// Binomial sd of 20 000 answers: 0.0031.
TEST(SimulatedObserver, TellsItsWeberFractionApartInThreeOfFour) {
  const Experiment experiment = fixture("rub.xml");
  const double expected = 0.98 * 0.75 + 0.02 * 0.5;
  EXPECT_NEAR(shareOfFirst(experiment, 0.5, 0.6, 20000), expected, 0.012);
  EXPECT_NEAR(shareOfFirst(experiment, 0.6, 0.5, 20000), 1 - expected, 0.012);
  EXPECT_NEAR(shareOfFirst(experiment, 0.5, 0.5, 20000), 0.5, 0.012);
  EXPECT_NEAR(shareOfFirst(experiment, std::nan(""), 0.5, 20000), 0.5, 0.012);  // no percept: a guess
}

}  // namespace
}  // namespace presa::experiment
