#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/runner/definition/read.h"
#include "tests/apps/experiment/grip_study.h"

// All names in an analysis are checked when the file is read, and all errors are reported at once.
namespace presa::experiment::analysis {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReadAnalysis : public testing::Test {
 protected:
  std::string findings(const std::string& analysis) {
    const std::string file = scratch_.file("experiment.xml");
    std::ofstream(file) << gripStudy(analysis);
    Diagnostics diagnostics;
    EXPECT_FALSE(readRecorded(file, diagnostics));
    return diagnostics.text();
  }
  ScratchFolder scratch_;
};

TEST_F(ReadAnalysis, UnknownName) {
  EXPECT_THAT(findings(R"(<spearman y="F_gripp" x="mass"/>)"),
              AllOf(HasSubstr("experiment.xml:9:"),
                    HasSubstr("error[E940]: unknown variable 'F_gripp' (did you mean 'F_grip'?)")));
}

TEST_F(ReadAnalysis, AMeasureMakesNoGroups) {
  EXPECT_THAT(findings(R"(<cell_means y="F_grip" by="mass F_slip"/>)"), HasSubstr("error[E943]: 'F_slip' is measured"));
}

TEST_F(ReadAnalysis, NamedTwice) {
  EXPECT_THAT(findings(R"(<log_linear y="F_grip" x="mass mu_s mass"/>)"),
              HasSubstr("error[E942]: 'mass' is named twice"));
}

TEST_F(ReadAnalysis, StrataThatThereAreNot) {
  EXPECT_THAT(findings(R"(<spearman y="F_grip" x="mass" within="subjects"/>)"),
              HasSubstr("not a grouping variable: 'subjects' (did you mean 'subject'?)"));
}

TEST_F(ReadAnalysis, EverythingAtOnce) {
  EXPECT_THAT(findings(R"(<spearman y="F_grip" x="mas"/><bars y="F_grip" rows="mu" columns="mass" color="stiffnes"/>)"),
              AllOf(HasSubstr("'mas'"), HasSubstr("'mu'"), HasSubstr("'stiffnes'")));
}

TEST_F(ReadAnalysis, AsItStands) {
  const std::string file = scratch_.file("experiment.xml");
  std::ofstream(file) << gripStudy(
      R"(<margin grip="F_grip" slip="F_slip"/><psychometric x="mass" y="F_grip" guess="lapse"/>)");
  Diagnostics diagnostics;
  const auto experiment = readRecorded(file, diagnostics);
  ASSERT_TRUE(experiment) << diagnostics.text();
  ASSERT_EQ(experiment->analysis.items.size(), 2U);
  EXPECT_EQ(experiment->analysis.confidence, 0.95);
  const auto& fit = std::get<wanted::Psychometric>(experiment->analysis.items[1].what);
  EXPECT_FALSE(fit.model.guess);
  EXPECT_EQ(fit.threshold, 0.5);
}

TEST_F(ReadAnalysis, WithoutAnalysisOrOfTwoExperiments) {
  const auto code = [&](const std::string& folder) {
    try {
      analyse({folder, ""}, [](auto...) { return true; });
    } catch (const InputError& error) {
      return error.diagnostics().all().front().code;
    }
    return 0;
  };
  const auto make = gripping([](auto&...) { return 2; });
  std::filesystem::create_directories(scratch_.file("none"));
  EXPECT_EQ(code(scratch_.file("none")), 945);
  SyntheticDataset(scratch_.file("data"), gripStudy("")).addSession(1, make, 3);
  EXPECT_EQ(code(scratch_.file("data")), 947);
  std::string other = gripStudy("");
  other.replace(other.find("\"grip\""), 6, "\"else\"");
  SyntheticDataset(scratch_.file("data"), other).addSession(2, make, 3);
  EXPECT_EQ(code(scratch_.file("data")), 946);
}

}  // namespace
}  // namespace presa::experiment::analysis
