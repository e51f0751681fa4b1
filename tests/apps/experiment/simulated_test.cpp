#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/operator/operator.h"
#include "apps/experiment/session.h"
#include "devices/simulated_subject/model/subject_parameters.h"
#include "experiments/runner/definition/read.h"
#include "tests/apps/experiment/contents.h"
#include "tests/apps/experiment/facts.h"
#include "tests/apps/experiment/refusal.h"

// A simulated subject is the same individual in all its trials, and its data are always labelled as a model's.
namespace presa::experiment {
namespace {

using testing::HasSubstr;

const std::string kFolder = std::string(PRESA_SOURCE_DIR) + "/experiments/grip_slip/";
const std::string kModel = "simulated subject, level L1: a model, not a person";

Experiment gripStudy(const std::string& level, const std::string& rig = {}) {
  Diagnostics diagnostics;
  auto experiment = readExperiment(kFolder + "experiment.xml", rig, diagnostics, level);
  EXPECT_TRUE(experiment) << diagnostics.text();
  return experiment.value_or(Experiment{});
}

TEST(Simulated, IsCalledAModelWhereverItComesFrom) {
  EXPECT_EQ(gripStudy("L1").model, kModel);
  EXPECT_EQ(gripStudy("L1").rig, kFolder + "rig_simulated.xml");
  EXPECT_EQ(gripStudy({}, kFolder + "rig_simulated.xml").model, "simulated subject, level L0: a model, not a person");
  EXPECT_EQ(gripStudy({}).model, "scripted fingers: no person");
}

TEST(Simulated, IsDrawnFromTheSeedOfTheExperimentAndItsNumber) {
  Experiment experiment = gripStudy("L1");
  for (const int number : {1, 2}) {
    const subject::Population population(subject::Level::kL1);
    const subject::SubjectParameters expected = population.draw(experiment.seed, static_cast<std::uint64_t>(number));
    const std::vector<DeviceFact> parameters = traitsOf(experiment, number);
    ASSERT_EQ(parameters.size(), population.parameters().size());
    for (const subject::SubjectParameter& parameter : population.parameters())
      EXPECT_EQ(factOf(parameters, std::string(parameter.name)), expected.*parameter.value) << parameter.name;
  }
  const double before = factOf(traitsOf(experiment, 1), "safety_margin");
  EXPECT_NE(factOf(traitsOf(experiment, 2), "safety_margin"), before);
  ++experiment.seed;
  EXPECT_NE(factOf(traitsOf(experiment, 1), "safety_margin"), before);
}

TrialResult runTrial(const Experiment& experiment, const PlannedTrial& trial, const TrialSetting& setting) {
  return present(experiment, presentationsOf(experiment, trial).front(), trial.seed, setting);
}

// Commands from elsewhere must not change the stimuli: neither a session nor a trial begins with them enabled.
TEST(Simulated, AnExperimentTakesNoCommands) {
  const ScratchFolder folder;
  std::string rig = contentsOf(kFolder + "rig_simulated.xml");
  rig.insert(rig.rfind("</rig>"), "<bus network=\"loopback\" commands=\"true\"/>");
  std::ofstream(folder.file("rig.xml")) << rig;
  const Experiment open = gripStudy({}, folder.file("rig.xml"));
  EXPECT_THAT(refusalOf([&] { traitsOf(open, 1); }), HasSubstr("error[E730]"));
  EXPECT_THAT(refusalOf([&] { runTrial(open, planTrials(open, 1, 1).front(), {.subject = 1}); }),
              HasSubstr("error[E730]"));
}

// The trial's seed changes only the variation between trials, not the subject's parameters.
TEST(Simulated, IsTheSamePersonInEveryTrialAndAnotherUnderAnotherNumber) {
  const Experiment experiment = gripStudy("L1");
  PlannedTrial trial = planTrials(experiment, 1, 1).front();
  const TrialSetting first{.subject = 1}, second{.subject = 2};
  const TrialResult once = runTrial(experiment, trial, first), again = runTrial(experiment, trial, first);
  EXPECT_EQ(once.state, Trial::State::kDone) << once.reason;
  EXPECT_THAT(again.values, testing::ElementsAreArray(once.values));
  EXPECT_NE(runTrial(experiment, trial, second).values, once.values);
  ++trial.seed;
  const TrialResult other = runTrial(experiment, trial, first);
  for (const char* name : {"device_resolution", "slip_threshold_of_trial", "misjudgement_of_trial"}) {
    EXPECT_EQ(factOf(again.facts, name), factOf(once.facts, name)) << name;
    EXPECT_NE(factOf(other.facts, name), factOf(once.facts, name)) << name;
  }
}

TEST(Simulated, NeedsARigForIt) {
  ScratchFolder scratch;
  std::string text = contentsOf(kFolder + "experiment.xml");
  const std::string attribute = "simulated_rig=\"rig_simulated.xml\"", scene = "scene=\"";
  text.replace(text.find(attribute), attribute.size(), "");
  text.replace(text.find(scene), scene.size(), scene + kFolder);
  std::ofstream(scratch.file("experiment.xml")) << text;
  Diagnostics diagnostics;
  EXPECT_FALSE(readExperiment(scratch.file("experiment.xml"), {}, diagnostics, "L1"));
  EXPECT_THAT(diagnostics.text(), HasSubstr("experiment.xml:4:1: error[E912]: a simulated subject is asked for"));
}

TEST(Simulated, TheSessionSaysSoAndKeepsItsLevel) {
  ScratchFolder scratch;
  Experiment experiment = gripStudy("L1");
  for (Factor& factor : experiment.factors) factor.levels.resize(1);
  experiment.design = {.repeats = 1};
  SessionStart start;
  start.experiment_file = experiment.file;
  start.subject = {"S03", 3};
  start.simulated = experiment.level;
  start.model = experiment.model;
  const SessionFolder folder = SubjectSession::begin(experiment, start, scratch.file("data")).folder();
  const auto logged = [&] { return readLog(folder.journal(), Journal::read(folder.journal()).records); };
  EXPECT_EQ(logged().start.simulated, "L1");
  EXPECT_EQ(logged().start.model, kModel);
  SubjectSession session = SubjectSession::resume(experiment, folder);
  EXPECT_EQ(session.start().model, kModel);
  ASSERT_EQ(session.run(*silentOperator(1), "en"), SubjectSession::End::kComplete);

  const auto records = Journal::read(folder.journal()).records;
  const double margin = factOf(traitsOf(experiment, 3), "safety_margin");
  EXPECT_EQ(records.front().at("traits").at("safety_margin"), (Json{{"value", margin}, {"unit", "1"}}));
  EXPECT_EQ(logged().runs.at(0).end.at("model").at(0).at("device_resolution").at("unit"), "m");
  // both fingers carry the cube: the means of their tangential forces are its weight, but for what the hand does to it
  const auto end = std::ranges::find_if(records, [](const Json& record) { return record.at("event") == "trial_end"; });
  ASSERT_NE(end, records.end());
  const Json& values = end->at("values");
  const double weight = 9.81 * values.at("mass").get<double>();
  EXPECT_NEAR(values.at("F_t_thumb").get<double>() + values.at("F_t_index").get<double>(), weight, 0.02 * weight);
  EXPECT_THAT(contentsOf(folder.file("trials.csv")), HasSubstr("\nS03,1,\"" + kModel + "\",1,"));
  EXPECT_THAT(contentsOf(folder.file("trials.json")), HasSubstr(kModel));
}

}  // namespace
}  // namespace presa::experiment
