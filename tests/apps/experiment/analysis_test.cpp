#include "apps/experiment/analysis/analyse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/common/scratch_folder.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/random.h"
#include "tests/apps/experiment/contents.h"
#include "tests/apps/experiment/grip_study.h"

// Datasets whose statistics are known exactly, from their logs to the report.
namespace presa::experiment::analysis {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class AnalysisTest : public GripStudyTest {
 protected:
  static double number(const Table& table, std::size_t row, const std::string& column) {
    return std::get<double>(cell(table, row, column));
  }
  static const Cell& cell(const Table& table, std::size_t row, const std::string& column) {
    const auto found =
        std::find_if(table.columns.begin(), table.columns.end(), [&](const auto& c) { return c.name == column; });
    if (found == table.columns.end()) throw std::out_of_range(column);
    return table.rows.at(row)[static_cast<std::size_t>(found - table.columns.begin())];
  }
};

// With the slip force as the measured value, the three correlations are exact for any number of repeats and subjects.
TEST_F(AnalysisTest, CorrelationsOfTheSlipForceAreExact) {
  const Result result =
      analysed(R"(<spearman y="F_grip" x="mass mu_s stiffness" within="subject block" permutations="200"/>)",
               gripping([](auto&...) { return 1; }));
  const Table& table = result.sections.at(0).tables.at(0);
  ASSERT_EQ(table.rows.size(), 3U * 4U);
  const double expected[] = {std::sqrt(75.0 / 118), -11 / std::sqrt(354.0), 0};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    EXPECT_EQ(number(table, row, "n"), row % 4 == 0 ? 162 : 54);
    EXPECT_NEAR(number(table, row, "rho"), expected[row / 4], 1e-12);
  }
  // t = r sqrt((n - 2) / (1 - r^2)), n = 162
  EXPECT_NEAR(number(table, 0, "t"), expected[0] * std::sqrt(160 / (1 - 75.0 / 118)), 1e-9);
  EXPECT_NEAR(number(table, 0, "p_permutation"), 1.0 / 201, 1e-12);
  EXPECT_GT(number(table, 8, "p_permutation"), 0.05);
  EXPECT_THAT(result.headlines(),
              ElementsAre(HasSubstr("F_grip rises with mass (ρ = 0.80, 0.72 to 0.85) and falls with mu_s (ρ = −0.58")));
  EXPECT_THAT(result.headlines().front(), HasSubstr("no monotone relation with stiffness (ρ = 0.00"));
}

// 27 cells of 6 trials; the half-width of their interval is t(.975, 5) s / sqrt 6 = 1.0494 s.
TEST_F(AnalysisTest, CellMeansOfSixTrials) {
  const auto noisy = [](const Experiment&, const PlannedTrial& trial) {
    return RandomStream(7, "grip", trial.seed).uniform(1, 2);
  };
  const Result result = analysed(R"(<cell_means y="F_grip" by="mass mu_s stiffness"/>)", gripping(noisy));
  const Table& table = result.sections.at(0).tables.at(0);
  ASSERT_EQ(table.rows.size(), 27U);
  for (std::size_t row = 0; row < 27; ++row) {
    EXPECT_EQ(number(table, row, "n"), 6);
    const auto interval = std::get<statistics::Interval>(cell(table, row, "interval"));
    EXPECT_NEAR(interval.halfWidth(), 1.0494 * number(table, row, "sd"), 1e-4 * number(table, row, "sd"));
    EXPECT_NEAR(0.5 * (interval.low + interval.high), number(table, row, "mean"), 1e-12);
  }
  EXPECT_EQ(std::get<std::string>(cell(table, 26, "mass")), "0.4");
  EXPECT_THAT(result.sections[0].method, HasSubstr("Morey 2008"));
}

// A grip of twice the slip force has a margin of 50 % of the grip, 100 % of the slip force.
TEST_F(AnalysisTest, MarginsInBothConventions) {
  const auto factor = [](const Experiment& experiment, const PlannedTrial& trial) {
    return levelOf(experiment, trial, "mass") == 0.1 ? 2 : 1.25;
  };
  const Result result = analysed(R"(<margin grip="F_grip" slip="F_slip" by="mass"/>)", gripping(factor));
  const Table& table = result.sections.at(0).tables.at(0);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_NEAR(number(table, 0, "margin_of_grip_median"), 50, 1e-9);
  EXPECT_NEAR(number(table, 0, "margin_of_slip_mean"), 100, 1e-9);
  EXPECT_NEAR(number(table, 2, "margin_of_grip_mean"), 20, 1e-9);
  EXPECT_NEAR(number(table, 2, "margin_of_slip_median"), 25, 1e-9);
  EXPECT_EQ(number(table, 1, "n"), 54);
}

// Grip as a product of powers: the fit recovers the exponents; the slope of the depth is the exponent of stiffness
// minus 1.
TEST_F(AnalysisTest, ExponentsAndControlSlope) {
  const auto factor = [](const Experiment& experiment, const PlannedTrial& trial) {
    return std::pow(levelOf(experiment, trial, "stiffness"), 0.25) *
           (1 + 1e-3 * RandomStream(3, "noise", trial.seed).normal());
  };
  const Result result = analysed(R"(<log_linear y="F_grip" x="mass mu_s stiffness"/>
                                    <depth_control force="F_grip" stiffness="stiffness" x="mass mu_s"/>)",
                                 gripping(factor));
  const Table& exponents = result.sections.at(0).tables.at(0);
  // noise of 1e-3 in ln y over levels with sd 0.57: standard error 1e-3 / (0.57 sqrt 162) = 1.4e-4; tolerance 5 of them
  EXPECT_NEAR(number(exponents, 0, "exponent"), 1, 7e-4);
  EXPECT_NEAR(number(exponents, 1, "exponent"), -1, 8e-4);
  EXPECT_NEAR(number(exponents, 2, "exponent"), 0.25, 7e-4);
  const Table& control = result.sections.at(1).tables.at(0);
  EXPECT_NEAR(number(control, 0, "slope"), -0.75, 7e-4);
  EXPECT_LT(number(control, 0, "p_against_force"), 1e-6);
  EXPECT_LT(number(control, 0, "p_against_depth"), 1e-6);
}

// Practice, excluded, aborted and missing trials are counted separately and do not affect the numbers.
TEST_F(AnalysisTest, SaysWhatIsLeftOut) {
  SyntheticDataset dataset(scratch.file("data"), gripStudy(R"(<cell_means y="F_grip" by="mass"/>)"));
  const auto make = [](const Experiment& experiment, const PlannedTrial& trial) {
    auto made = gripping([](auto&...) { return 1; })(experiment, trial);
    if (trial.practice) made.values["F_grip"] = 1e6;
    if (trial.number == 3) made.values["F_grip"] = 1e6, made.excluded = "not held for 10 s";
    if (trial.number == 4) made.values["F_grip"] = 1e6, made.outcome = Outcome::kAborted, made.reason = "dropped";
    return made;
  };
  dataset.addSession(1, make, 12);  // 2 practice trials, 10 that count, then the process ends
  const Result result = analyse({dataset.folder(), ""}, [](auto...) { return true; });
  ASSERT_EQ(result.trials.sessions.size(), 1U);
  const SessionCensus& census = result.trials.sessions.front();
  EXPECT_FALSE(census.complete);
  EXPECT_EQ(census.planned, 54U);
  EXPECT_EQ(census.counted, 8U);
  EXPECT_EQ(census.excluded, 1U);
  EXPECT_EQ(census.missing, 45U);
  EXPECT_EQ(census.aborted, 1U);
  EXPECT_EQ(census.practice, 2U);
  ASSERT_EQ(result.trials.left_out.size(), 46U);
  EXPECT_EQ(result.trials.left_out[0].why, "not held for 10 s");
  EXPECT_EQ(result.trials.left_out[1].why, "aborted: dropped");
  EXPECT_EQ(result.trials.left_out[2].why, "not run yet");
  double n = 0;
  const Table& table = result.sections.at(0).tables.at(0);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    n += number(table, row, "n");
    EXPECT_LT(number(table, row, "mean"), 10);
  }
  EXPECT_EQ(n, 8);
  EXPECT_THAT(reportHtml(result), HasSubstr("1 of 1 sessions are not finished"));
}

// Exponents are superscripts on the page; a ^ without a number stays.
TEST(AnalysisPage, HasExponentsAsSuperscripts) {
  Result result;
  result.sections.emplace_back().finding = {"F = 2.1 · mass^0.85 · friction^−1.2 & x^-3, y^z ^"};
  EXPECT_THAT(reportHtml(result), HasSubstr("<p>F = 2.1 · mass<sup>0.85</sup> · friction<sup>−1.2</sup> &amp; "
                                            "x<sup>-3</sup>, y^z ^</p>"));
}

// With fewer than 8 subjects there is no statement about a population; from 8 on there is an interval over subjects.
TEST_F(AnalysisTest, IntervalOverSubjectsFromEightOn) {
  const std::string spearman = R"(<spearman y="F_grip" x="mass" permutations="0"/>)";
  const auto own = [](const Experiment&, const PlannedTrial& trial) {
    return RandomStream(5, "own", trial.seed).uniform(1, 2);
  };
  const Result few = analysed(spearman, gripping(own), 7);
  EXPECT_THAT(reportHtml(few), HasSubstr("makes no claim about a population"));
  EXPECT_THROW(cell(few.sections[0].tables[0], 0, "interval_over_subjects"), std::out_of_range);
  std::filesystem::remove_all(scratch.file("data"));
  const Result many = analysed(spearman, gripping(own), 8);
  EXPECT_THAT(reportHtml(many), Not(HasSubstr("makes no claim about a population")));
  const auto interval = std::get<statistics::Interval>(cell(many.sections[0].tables[0], 0, "interval_over_subjects"));
  EXPECT_LT(interval.low, number(many.sections[0].tables[0], 0, "rho"));
  EXPECT_GT(interval.high, number(many.sections[0].tables[0], 0, "rho"));
}

TEST_F(AnalysisTest, EveryOutputSaysThatItIsAModel) {
  SyntheticDataset dataset(scratch.file("data"), gripStudy(R"(<cell_means y="F_grip" by="mass"/>)"));
  dataset.addSession(1, gripping([](auto&...) { return 1.5; }), SIZE_MAX,
                     "simulated subject, level L1: a model, not a person");
  const Result result = analyse({dataset.folder(), ""}, [](auto...) { return true; });
  const std::string out = scratch.file("out");
  write(result, out);
  for (const char* file : {"/report.html", "/analysis.json", "/tables/cell_means_F_grip_mass.csv"})
    EXPECT_THAT(contentsOf(out + file), HasSubstr("odel, not a person")) << file;
}

// Text from the file is escaped on the page; the same data give the same bytes; files of an earlier analysis are
// deleted.
TEST_F(AnalysisTest, WritesTheSameAgain) {
  const Result result = analysed(
      R"(<spearman y="F_grip" x="mass" permutations="500" title="A &lt; B"/>)",
      gripping([](const Experiment&, const PlannedTrial& t) { return 1 + RandomStream(9, "x", t.seed).uniform(); }));
  const std::string out = scratch.file("out");
  std::filesystem::create_directories(out + "/tables");
  std::ofstream(out + "/tables/old.csv") << "stale";
  write(result, out);
  EXPECT_FALSE(std::filesystem::exists(out + "/tables/old.csv"));
  EXPECT_THAT(contentsOf(out + "/report.html"), HasSubstr("<h2>A &lt; B</h2>"));
  EXPECT_THAT(contentsOf(out + "/report.html"), HasSubstr("<h1>Grip &amp; slip</h1>"));
  EXPECT_EQ(reportJson(result), reportJson(analyse({result.data, ""}, [](auto...) { return true; })));
  const Json json = Json::parse(contentsOf(out + "/analysis.json"));
  const Json& row = json["analyses"][0]["tables"][0]["rows"][0];
  EXPECT_EQ(row["n"], 162);
  EXPECT_NEAR(row["rho"].get<double>(), number(result.sections[0].tables[0], 0, "rho"), 0);
  EXPECT_TRUE(row["interval"].contains("low"));
}

}  // namespace
}  // namespace presa::experiment::analysis
