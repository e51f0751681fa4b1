#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/analysis/analyse.h"
#include "apps/experiment/operator/operator.h"
#include "apps/experiment/session.h"
#include "experiments/runner/definition/read.h"
#include "experiments/runner/statistics/margin.h"
#include "tests/apps/experiment/grip_study.h"

// The figures of the grip study, each against the findings of the original research.
namespace presa::experiment::analysis {
namespace {

using testing::HasSubstr;

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class FigureTest : public GripStudyTest {
 protected:
  /// Grip over slip force: 3 at 2000 N/m, otherwise 2. Trials of a cell differ by a factor of the repeat only: 0.9 or
  /// 1.1.
  static double factor(const Experiment& experiment, const PlannedTrial& trial) {
    return (levelOf(experiment, trial, "stiffness") == 2000 ? 3 : 2) * (trial.repeat == 1 ? 0.9 : 1.1);
  }
  Section figure(const std::string& element) { return analysed(element, gripping(factor)).sections.at(0); }
};

// As in figure 14: 27 bars, each the mean of the 6 trials of its cell.
TEST_F(FigureTest, BarsAreTheMeansOfTheirCells) {
  const std::string svg = figure(R"(<bars y="F_grip" rows="mu_s" columns="mass" color="stiffness"/>)").figure;
  const std::regex bar(
      "class=\"bar s([0-2])\"[^>]*data-name=\"mu_s ([0-9.]+), mass ([0-9.]+) kg, stiffness ([0-9]+) N/m\nF_grip "
      "([0-9.]+) N, n 6\"");
  std::size_t bars = 0;
  for (auto at = std::sregex_iterator(svg.begin(), svg.end(), bar); at != std::sregex_iterator(); ++at, ++bars) {
    const double k = std::stod((*at)[4]);
    const double mean = (k == 2000 ? 3 : 2) * *statistics::slipForce(std::stod((*at)[3]), std::stod((*at)[2]));
    EXPECT_NEAR(std::stod((*at)[5]), mean, 0.005 * mean);  // three digits
    EXPECT_EQ(std::stoi((*at)[1]), k == 500 ? 0 : k == 1000 ? 1 : 2);
  }
  EXPECT_EQ(bars, 27U);
}

// As in figure 15: 27 means with error bars, and the slip line in each of the nine panels.
TEST_F(FigureTest, MeansWithIntervalsAndSlipLine) {
  const Section section =
      figure(R"(<means y="F_grip" x="mass" rows="mu_s" columns="stiffness" line="F_slip" interval="within_subject"/>)");
  EXPECT_EQ(countOf(section.figure, "class=\"error\""), 27U);
  EXPECT_EQ(countOf(section.figure, "class=\"line ink dashed\""), 9U + 1U);  // one in the legend
  EXPECT_THAT(section.method, HasSubstr("within-subject interval (Cousineau 2005, Morey 2008)"));
}

// As in figure 16: medians on nine lines; 100 (2 - 1) / 2 = 50 % soft, 100 (3 - 1) / 3 = 66.7 % hard, for every mass.
TEST_F(FigureTest, MarginsOverMass) {
  const Section section = figure(R"(<margins grip="F_grip" slip="F_slip" x="mass" color="stiffness" shape="mu_s"/>)");
  EXPECT_EQ(countOf(section.figure, "class=\"line s"), 9U + 3U);
  ASSERT_EQ(section.tables.at(0).rows.size(), 27U);
  for (const auto& row : section.tables[0].rows) {
    // of six trials the median lies between 0.9 and 1.1 times the factor
    const double f = std::get<std::string>(row[0]) == "2000" ? 3 : 2, low = 100 * (1 - 1 / (0.9 * f)),
                 high = 100 * (1 - 1 / (1.1 * f));
    EXPECT_NEAR(std::get<double>(row.back()), 0.5 * (low + high), 1e-9);
  }
}

/// Distance of the tick at 0.4 kg from that at 0.2, over that of 0.2 from 0.1.
double tickRatio(const std::string& svg) {
  std::vector<double> at;
  for (const char* mass : {"0.1", "0.2", "0.4"}) {
    const std::regex tick("class=\"tick xtick\" x=\"([0-9.]+)\"[^>]*>" + std::string(mass) + "<");
    std::smatch found;
    if (!std::regex_search(svg, found, tick)) return 0;
    at.push_back(std::stod(found[1]));
  }
  return (at[2] - at[1]) / (at[1] - at[0]);
}

// Masses that double lie at equal distances on a logarithmic axis, and 0.1, 0.2, 0.4 do not on a linear one. Bound:
// tenths of a pixel of some 100.
TEST_F(FigureTest, MarginsOverALogarithmicMass) {
  const char* text = R"(<margins grip="F_grip" slip="F_slip" x="mass" color="stiffness" shape="mu_s" log="x"/>)";
  EXPECT_NEAR(tickRatio(figure(text).figure), 1, 0.01);
}
TEST_F(FigureTest, MarginsOverALinearMass) {
  const char* text = R"(<margins grip="F_grip" slip="F_slip" x="mass" color="stiffness" shape="mu_s"/>)";
  EXPECT_NEAR(tickRatio(figure(text).figure), 2, 0.02);
}

// As in figure 17: a symbol per trial, none below the diagonal.
TEST_F(FigureTest, GripOverSlipForce) {
  const Section section = figure(R"(<scatter x="F_slip" y="F_grip" color="stiffness"/>)");
  EXPECT_EQ(countOf(section.figure, "class=\"symbol s"), 162U + 3U);
  EXPECT_EQ(countOf(section.figure, "class=\"line ink dashed\""), 2U);
  EXPECT_EQ(section.figure_caption, "0 of 162 trials lie under the line.");
}

TEST_F(FigureTest, TimeCourseWithoutRecordingSaysSo) {
  const Section section = figure(R"(<time_course finger="thumb" body="cube"/>)");
  EXPECT_TRUE(section.figure.empty());
  ASSERT_EQ(section.notes.size(), 1U);
  EXPECT_THAT(section.notes[0], HasSubstr("The recording of trial 1 of S01 is not there"));
}

// As in figure 12, from a recording: while a scripted grip holds, the state is 1 (stick) and the finger stays within 1
// mm on the cube; it slips during the release, and not before.
TEST(TimeCourse, OfAHeldCube) {
  ScratchFolder scratch;
  const std::string tests = std::string(PRESA_SOURCE_DIR) + "/tests/apps/experiment/fixtures/";
  Diagnostics diagnostics;
  const auto experiment = readExperiment(tests + "lift.xml", {}, diagnostics);
  ASSERT_TRUE(experiment) << diagnostics.text();
  SessionStart start;
  start.experiment_file = tests + "lift.xml";
  start.subject = {"S01", 1};
  auto session = SubjectSession::begin(*experiment, start, scratch.file("data"));
  const auto nobody = silentOperator(session.trials().left());
  ASSERT_EQ(session.run(*nobody, "en"), SubjectSession::End::kComplete);
  const Result result = analyse({scratch.file("data"), tests + "lift_analysis.xml"}, [](auto...) { return true; });
  const Section& section = result.sections.at(0);
  EXPECT_THAT(section.title, HasSubstr("of S01"));
  for (const char* part : {"Height [m]", "Contact state", "Grip force [N]", "line finger", "line object", ">release<"})
    EXPECT_THAT(section.figure, HasSubstr(part));
  const Table& table = section.tables.at(0);
  ASSERT_EQ(table.rows.size(), 3U);
  const auto at = [&](std::size_t row, std::size_t column) { return std::get<double>(table.rows[row][column]); };
  EXPECT_EQ(std::get<std::string>(table.rows[1][0]), "hold");
  EXPECT_EQ(at(1, 4), 100);
  EXPECT_LT(at(1, 6), 1);
  EXPECT_GT(at(2, 5), 0);
  EXPECT_NEAR(at(1, 7), result.trials.numbers.at("F_grip")[0], 0.02 * at(1, 7));  // one finger against the mean of both
}

}  // namespace
}  // namespace presa::experiment::analysis
