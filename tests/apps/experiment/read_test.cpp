#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "experiments/runner/definition/order.h"
#include "experiments/runner/definition/read.h"
#include "tests/apps/experiment/contents.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kGrip = std::string(PRESA_SOURCE_DIR) + "/experiments/grip_slip/experiment.xml";

/// The findings on the shipped experiment after a single change.
class Changed : public testing::Test {
 protected:
  ~Changed() override { fs::remove(file_); }
  std::string findings(const std::string& from, const std::string& to) {
    std::string text = contentsOf(kGrip);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    std::ofstream(file_) << text;
    Diagnostics diagnostics;
    EXPECT_FALSE(readExperiment(file_, {}, diagnostics));
    return diagnostics.text();
  }
  // beside the original, so that its scene is found
  const std::string file_ = fs::path(kGrip).parent_path() / ("changed_" + std::to_string(::getpid()) + ".xml");
};

/// What the participant sees, as words.
std::string seen(const Sight& sees) {
  std::string words;
  for (const auto& [is_seen, word] : {std::pair(sees.bodies, "bodies"), std::pair(sees.fingertips, "fingertips"),
                                      std::pair(sees.instruction, "instruction"), std::pair(sees.question, "question"),
                                      std::pair(sees.answers, "answers"), std::pair(sees.fixation, "fixation"),
                                      std::pair(sees.measured, "measured")}) {
    if (is_seen) words += (words.empty() ? "" : " ") + std::string(word);
  }
  return words;
}

// Nothing that is measured unless the experiment says so; a phase may differ from the rest.
TEST(Read, SaysWhatTheParticipantSees) {
  const std::string file = fs::path(kGrip).parent_path() / ("sees_" + std::to_string(::getpid()) + ".xml");
  std::string text = contentsOf(kGrip);
  const auto readText = [&] {
    std::ofstream(file) << text;
    Diagnostics diagnostics;
    auto experiment = readExperiment(file, {}, diagnostics);
    fs::remove(file);
    EXPECT_TRUE(experiment) << diagnostics.text();
    return std::move(*experiment);
  };
  const auto put = [&](const std::string& before, const std::string& what) { text.insert(text.find(before), what); };
  EXPECT_EQ(seen(readText().phases.at(3).sees), "bodies fingertips instruction question answers");
  put("<phase name=\"reach\"", "<participant sees=\"bodies fixation\"/>");
  put("seconds=\"10\" abort", "sees=\"black\" ");
  const Experiment experiment = readText();
  EXPECT_EQ(seen(experiment.sees), "bodies fixation");
  EXPECT_EQ(seen(experiment.phases.at(0).sees), "bodies fixation");
  EXPECT_EQ(seen(experiment.phases.at(3).sees), "");
  text.replace(text.find("bodies fixation"), 15, "measured");
  EXPECT_EQ(seen(readText().sees), "measured");
}

TEST_F(Changed, ThePartsThatAParticipantMaySeeAreKnown) {
  const std::string found =
      findings("<phase name=\"reach\"", "<participant sees=\"bodies forces\"/><phase name=\"reach\"");
  EXPECT_THAT(found, HasSubstr("'bodies forces'"));
  EXPECT_THAT(found, HasSubstr("words out of bodies, fingertips, instruction"));
}

TEST(Read, TheGripStudyIsThatOfThePaper) {
  Diagnostics diagnostics;
  const auto experiment = readExperiment(kGrip, {}, diagnostics);
  ASSERT_TRUE(experiment) << diagnostics.text();
  EXPECT_EQ(conditionsOf(*experiment, 1).size(), 27U);
  EXPECT_EQ(planTrials(*experiment, 1, 1).size(), 2U + 54U);
  const Condition heavy_slippery{2, 0, 1};
  EXPECT_EQ(experiment->valueOf("mu_d", heavy_slippery), "0.3");
  EXPECT_THAT(experiment->setsOf(heavy_slippery),
              testing::ElementsAre("body/cube/physics/mass=0.4", "material/rubber/friction/static=0.4",
                                   "material/rubber/friction/dynamic=0.3", "material/rubber/stiffness=1000"));
  EXPECT_THAT(experiment->textFor("release", "it"), HasSubstr("finché"));
  EXPECT_EQ(experiment->textFor("release", "de"), experiment->textFor("release", "en"));
  EXPECT_THAT(experiment->resolved_xml, HasSubstr("between=\"false\""));  // defaults are written out
}

TEST_F(Changed, WrongNumberOfValues) {
  EXPECT_THAT(findings("<level values=\"0.4 0.3\"/>", "<level values=\"0.4\"/>"),
              HasSubstr("error[E904]: factor 'friction' has 2 columns, found 1 values"));
}

TEST_F(Changed, UnknownPathOfTheScene) {
  EXPECT_THAT(findings("body/cube/physics/mass", "body/cub/physics/mass"), HasSubstr("did you mean"));
}

// Invalid friction: the scene's check reports it for the level that sets it.
TEST_F(Changed, LevelThatTheSceneRefuses) { EXPECT_THAT(findings("0.8 0.6", "0.8 0.9"), HasSubstr("error[E2")); }

TEST_F(Changed, UnknownNumberInAGuard) {
  EXPECT_THAT(findings("until=\"signal\"", "until=\"signl\""),
              HasSubstr("error[E902]: unknown name 'signl' (did you mean 'signal'?)"));
}

TEST_F(Changed, UnknownPhaseInAMeasure) {
  EXPECT_THAT(findings("mean(hold, thumb.fn)", "mean(held, thumb.fn)"), HasSubstr("there is no phase 'held'"));
}

TEST_F(Changed, MeasureThatUsesALaterOne) {
  EXPECT_THAT(findings("mass * 9.81 / (2 * mu_s)", "RSM * 2"), HasSubstr("unknown name 'RSM'"));
}

TEST_F(Changed, ColumnThatHidesASample) {
  EXPECT_THAT(findings("<column name=\"stiffness\"", "<column name=\"signal\""),
              HasSubstr("error[E903]: 'signal' is already the name of a sample, of a trial variable or of a column"));
}

TEST_F(Changed, UnknownFactorInBlocks) {
  EXPECT_THAT(findings("repeats=\"2\"", "repeats=\"2\" block_by=\"fricton\""), HasSubstr("did you mean 'friction'"));
}

TEST_F(Changed, TextOfNoPhase) {
  EXPECT_THAT(findings("<text when=\"hold\"", "<text when=\"hol\""),
              HasSubstr("there is no phase 'hol' (did you mean 'hold'?)"));
}

TEST_F(Changed, SecondMeasureOfAName) {
  EXPECT_THAT(findings("name=\"F_index\"", "name=\"F_thumb\""), HasSubstr("error[E903]"));
}

TEST_F(Changed, EventThatTheSceneDoesNotHave) {
  EXPECT_THAT(findings("<phase name=\"hold\"", "<phase name=\"hold\" event=\"change_friction\""),
              HasSubstr("error[E916]: phase 'hold' changes the friction of surfaces, but no touchable material of"));
  EXPECT_THAT(findings("<phase name=\"hold\"", "<phase name=\"hold\" event_when=\"mass == 0.1\""),
              HasSubstr("has a condition for an event, but no event"));
}

TEST_F(Changed, ReactionOfNoPhase) {
  const auto with = [&](const std::string& phases) {
    return findings("<measure name=\"F_thumb\"",
                    "<reaction name=\"R\" value=\"thumb.fn\" " + phases + "/><measure name=\"F_thumb\"");
  };
  EXPECT_THAT(with("baseline=\"hold\" phase=\"relese\""),
              HasSubstr("error[E917]: there is no phase 'relese' (did you mean 'release'?)"));
  EXPECT_THAT(with("baseline=\"release\" phase=\"hold\""), HasSubstr("does not come before phase 'hold'"));
}

TEST_F(Changed, EverythingAtOnce) {
  std::string text = contentsOf(kGrip);
  const std::string all = findings("until=\"signal\"", "until=\"signl\" abort=\"cube.lft &lt; 0\"");
  EXPECT_THAT(all, HasSubstr("signl"));
  EXPECT_THAT(all, HasSubstr("cube.lft"));
}

}  // namespace
}  // namespace presa::experiment
