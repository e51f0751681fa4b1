#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/definition/trial.h"
#include "tests/support/alloc_lock_guard.h"

// The state machine of a trial, fed with samples computed by hand.
namespace presa::experiment {
namespace {

constexpr double kPeriod = 0.001;

/// lift (until x > mass, held 10 ms, at most 1 s), hold (100 ms, aborted by x < 0), end (until x == 0, next after 50
/// ms).
class TrialTest : public testing::Test {
 protected:
  TrialTest() {
    experiment.samples = SymbolTable({"t", "t_phase", "signal", "x"});
    experiment.factors = {{"mass", false, {{"mass", "kg", {}}}, {{"0.2"}, {"heavy"}}}};
    experiment.names = SymbolTable({"mass", "missed_ticks", "clipped_s", "device_lost_s", "most_force"});
    SymbolTable guards = experiment.samples;
    guards.add("mass");
    const auto make = [&](const char* text) { return Expression::compile(text, guards, {}, diagnostics); };
    experiment.phases.push_back({"lift", make("x > mass"), {}, 0.01, 1, Phase::OnTimeout::kAbort, ""});
    experiment.phases.push_back({"hold", {}, make("x < 0"), 0, 0.1, Phase::OnTimeout::kNext, "dropped"});
    experiment.phases.push_back({"end", make("x == 0"), {}, 0, 0.05, Phase::OnTimeout::kNext, ""});
    measure("held", "seconds(hold)");
    measure("mean_x", "mean(hold, x)");
    measure("sd_x", "sd(hold, x)");
    measure("range", "most(hold, x) - least(hold, x)");
    measure("first_big", "first(hold, x > 1.005, t_phase)");
    measure("twice", "2 * mean_x / mass");
    measure("begin", "start(end)");
    experiment.exclusions.push_back(
        {Expression::compile("missed_ticks > 2", experiment.names, {}, diagnostics), "late"});
    EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  }
  void measure(const char* name, const char* text) {
    const std::vector<std::string> phases = experiment.phaseNames();
    Measure made{name, "", "", {}, {}, experiment.names.size()};
    made.value =
        Expression::compile(text, experiment.names, {}, diagnostics, &made.aggregates, &experiment.samples, &phases);
    experiment.measures.push_back(std::move(made));
    experiment.names.add(name);
  }
  /// Steps until the trial ends or `seconds` are over; `x` gives the sample by tick number.
  template <class X>
  void run(Trial& trial, X x, int ticks) {
    for (int n = 0; n < ticks && trial.state() == Trial::State::kRunning; ++n) {
      trial.samples()[3] = x(n);
      trial.step(n * kPeriod);
    }
  }
  double value(const std::vector<double>& results, const char* name) { return results[*experiment.names.find(name)]; }

  Experiment experiment;
  Diagnostics diagnostics;
};

TEST_F(TrialTest, GoesThroughItsPhasesAndMeasures) {
  Trial trial(experiment, {0.2}, kPeriod);
  // above 0.2 from tick 5: held 10 ms at tick 15; hold is ticks 16 to 115 with x = 1 + 0.0001 (n - 16); then end, with
  // x = 0 in tick 120
  run(
      trial,
      [](int n) {
        return n < 5 ? 0.1 : n < 16 ? 1.0 : n < 116 ? 1 + 1e-4 * (n - 16) : n < 120 ? 5.0 : 0.0;
      },
      1000);
  ASSERT_EQ(trial.state(), Trial::State::kDone);
  EXPECT_NEAR(trial.stretches()[0].end, 0.016, 1e-12);
  EXPECT_NEAR(trial.stretches()[1].end, 0.116, 1e-12);
  EXPECT_NEAR(trial.stretches()[2].end, 0.121, 1e-12);
  const auto results = trial.results(std::vector<double>{0, 0, 0, 0});
  EXPECT_NEAR(value(results, "held"), 0.1, 1e-12);
  EXPECT_NEAR(value(results, "mean_x"), 1 + 1e-4 * 49.5, 1e-12);
  EXPECT_NEAR(value(results, "sd_x"), 1e-4 * std::sqrt(100.0 * 101 / 12), 1e-12);  // of 0 … 99
  EXPECT_NEAR(value(results, "range"), 99e-4, 1e-12);
  EXPECT_NEAR(value(results, "first_big"), 0.051, 1e-12);
  EXPECT_NEAR(value(results, "twice"), 10 * value(results, "mean_x"), 1e-12);
  EXPECT_NEAR(value(results, "begin"), 0.116, 1e-12);
  EXPECT_EQ(trial.exclusion(results), "");
  EXPECT_EQ(trial.exclusion(trial.results(std::vector<double>{3, 0, 0, 0})), "late");
}

TEST_F(TrialTest, AGuardThatFlickersDoesNotHold) {
  Trial trial(experiment, {0.2}, kPeriod);
  run(
      trial, [](int n) { return n % 8 == 0 ? 0.0 : 1.0; }, 2000);
  EXPECT_EQ(trial.state(), Trial::State::kAborted);
  EXPECT_EQ(trial.reason(), "no end of lift");
  EXPECT_NEAR(trial.stretches()[0].end, 0.999, 1e-12);
}

TEST_F(TrialTest, AbortsWithItsReason) {
  Trial trial(experiment, {0.2}, kPeriod);
  run(
      trial, [](int n) { return n < 50 ? 1.0 : -1.0; }, 1000);
  EXPECT_EQ(trial.state(), Trial::State::kAborted);
  EXPECT_EQ(trial.reason(), "dropped");
  EXPECT_EQ(trial.phase(), 1U);
  const auto results = trial.results(std::vector<double>{0, 0, 0, 0});
  EXPECT_TRUE(std::isnan(value(results, "begin")));  // the phase was never reached
  trial.abort(2, "operator");
  EXPECT_EQ(trial.reason(), "dropped");  // the first reason is kept
}

TEST_F(TrialTest, FromOutside) {
  Trial trial(experiment, {0.2}, kPeriod);
  run(
      trial, [](int) { return 1.0; }, 30);
  trial.abort(0.03, "device lost");
  EXPECT_EQ(trial.state(), Trial::State::kAborted);
  EXPECT_EQ(trial.reason(), "device lost");
}

// A textual level has no numeric value: a guard on it never holds.
TEST_F(TrialTest, AWordIsNoNumber) {
  Trial trial(experiment, {1}, kPeriod);
  run(
      trial, [](int) { return 1.0; }, 2000);
  EXPECT_EQ(trial.reason(), "no end of lift");
}

// The friction changes from the first tick of its phase on, and only in trials that meet its condition.
TEST_F(TrialTest, ChangesTheFrictionWithItsPhase) {
  experiment.phases[1].changes_friction = true;
  Trial always(experiment, {0.2}, kPeriod);
  run(
      always, [](int) { return 1.0; }, 10);
  EXPECT_EQ(always.phase(), 0U);
  EXPECT_FALSE(always.frictionChanged());
  run(
      always, [](int) { return 1.0; }, 11);  // held 10 ms in the last tick: the next one is the first of the phase
  EXPECT_EQ(always.phase(), 1U);
  EXPECT_TRUE(always.frictionChanged());
  SymbolTable seen = experiment.samples;
  seen.add("mass");
  experiment.phases[1].event_when = Expression::compile("mass == 0.1", seen, {}, diagnostics);
  Trial never(experiment, {0.2}, kPeriod);
  run(
      never, [](int) { return 1.0; }, 200);
  EXPECT_GT(never.phase(), 0U);
  EXPECT_FALSE(never.frictionChanged());
}

TEST_F(TrialTest, AStepTakesNoMemory) {
  Trial trial(experiment, {0.2}, kPeriod);
  const RealTimeGuard guard;
  run(
      trial, [](int n) { return n < 116 ? 1.0 : 0.0; }, 1000);
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

}  // namespace
}  // namespace presa::experiment
