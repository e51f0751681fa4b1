#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/analysis/analyse.h"
#include "tests/apps/experiment/synthetic_dataset.h"

// Psychometric fits from the log to the table, against the fits of another implementation (scipy, Nelder-Mead).
namespace presa::experiment::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Counts {
  std::vector<std::string> levels;
  std::vector<int> hits;
  int trials = 0;  ///< per level
};
const Counts kHeavier{{"0.160", "0.172", "0.184", "0.200", "0.216", "0.228", "0.240"}, {1, 3, 5, 10, 15, 18, 19}, 20};
const Counts kCorrect{{"5", "10", "15", "20", "30", "40"}, {22, 25, 29, 33, 37, 39}, 40};

std::string definitionOf(const Counts& counts, const std::string& psychometric) {
  std::string text =
      R"(<experiment version="1.0" name="fit" scene="scene.xml"><factor name="x"><column name="x" unit="u"/>)";
  for (const std::string& level : counts.levels) text += "<level values=\"" + level + "\"/>";
  return text + R"(</factor><design repeats=")" + std::to_string(counts.trials) +
         R"("/><phase name="p" seconds="1"/><measure name="answer" value="1"/><analysis>)" + psychometric +
         "</analysis></experiment>";
}

class PsychometricAnalysis : public testing::Test {
 protected:
  Section sectionOf(const Counts& counts, const std::string& psychometric) {
    SyntheticDataset dataset(scratch_.file("data"), definitionOf(counts, psychometric));
    dataset.addSession(1, [&](const Experiment&, const PlannedTrial& trial) {
      const int hits = counts.hits[trial.condition.front()];
      return SyntheticDataset::Made{{{"answer", trial.repeat <= hits ? 1 : 0}}};
    });
    result_ = analyse({dataset.folder(), ""}, [](auto...) { return true; });
    return result_->sections.at(0);
  }
  static const Cell& cell(const Section& section, const std::string& column) {
    const Table& table = section.tables.at(0);
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (table.columns[c].name == column) return table.rows.at(0)[c];
    }
    throw std::out_of_range(column);
  }
  static double number(const Section& section, const std::string& column) {
    return std::get<double>(cell(section, column));
  }
  ScratchFolder scratch_;
  std::optional<Result> result_;
};

// The likelihood is flat in the lapse rate: location and spread are determined to 1 %.
TEST_F(PsychometricAnalysis, PointOfSubjectiveEqualityAndWeberFraction) {
  const Section section =
      sectionOf(kHeavier, R"(<psychometric x="x" y="answer" guess="lapse" standard="0.2" bootstrap="200"/>)");
  EXPECT_NEAR(number(section, "PSE"), 0.199219, 0.01 * 0.199219);
  EXPECT_NEAR(number(section, "jnd"), 0.016059, 0.01 * 0.016059);
  EXPECT_NEAR(number(section, "weber"), 0.0803, 0.01 * 0.0803);
  EXPECT_EQ(number(section, "n"), 140);
  const auto interval = std::get<statistics::Interval>(cell(section, "PSE_interval"));
  EXPECT_TRUE(interval.contains(number(section, "PSE")));
  EXPECT_GT(interval.halfWidth(), 0.001);
  EXPECT_LT(interval.halfWidth(), 0.01);
  EXPECT_THAT(section.finding, ElementsAre(HasSubstr("Point of subjective equality of answer: 0.199 u")));
  // one symbol per level, larger than the threshold's; a curve and its interval
  for (const char* part : {"class=\"area", "class=\"line", "0.16: 1 of 20", "0.24: 19 of 20"})
    EXPECT_THAT(section.figure, HasSubstr(part));
}

TEST_F(PsychometricAnalysis, ThresholdOfAForcedChoice) {
  const Section section =
      sectionOf(kCorrect, R"(<psychometric x="x" y="answer" guess="0.5" standard="100" bootstrap="0"/>)");
  EXPECT_NEAR(number(section, "threshold_75_percent"), 16.6919, 0.01 * 16.6919);
  EXPECT_NEAR(number(section, "jnd"), 0.674490 * 10.1491, 0.01 * 6.8454);
  EXPECT_NEAR(number(section, "weber"), 0.166919, 0.01 * 0.1669);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell(section, "jnd_interval")));
}

TEST_F(PsychometricAnalysis, FixedLapse) {
  const Section section =
      sectionOf(kCorrect, R"(<psychometric x="x" y="answer" guess="0.5" lapse="0.02" bootstrap="0"/>)");
  EXPECT_EQ(number(section, "lapse"), 0.02);
  EXPECT_NEAR(number(section, "jnd"), 0.674490 * 10.4232, 0.001 * 7.03);
}

TEST_F(PsychometricAnalysis, SaysWhyThereIsNoFit) {
  Counts falling = kHeavier;
  std::reverse(falling.hits.begin(), falling.hits.end());
  const Section section = sectionOf(falling, R"(<psychometric x="x" y="answer" guess="lapse"/>)");
  EXPECT_EQ(std::get<std::string>(cell(section, "verdict")), "the answers do not rise with the stimulus");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell(section, "PSE")));
  EXPECT_TRUE(section.finding.empty());
}

}  // namespace
}  // namespace presa::experiment::analysis
