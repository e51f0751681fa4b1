#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/common/scratch_folder.h"
#include "apps/experiment/analysis/analyse.h"
#include "apps/experiment/dataset.h"
#include "tests/apps/experiment/contents.h"

// The small dataset shipped with each experiment is complete and unaltered, and its analysis gives the same findings.
// Made with `presa experiment run … --lockstep --no-recording`; golden.json is its analysis.json.
namespace presa::experiment {
namespace {

using Json = nlohmann::ordered_json;
using testing::IsEmpty;

// Systems differ in the last bits of exp and log, which resampling amplifies; nothing else may differ.
constexpr double kRelative = 1e-6, kAbsolute = 1e-9;

/// Lists the differences of two documents; numbers within the tolerance are equal.
void compare(const Json& found, const Json& expected, const std::string& at, std::vector<std::string>& differences) {
  if (found.is_number() && expected.is_number()) {
    const double a = found.get<double>(), b = expected.get<double>();
    if (std::abs(a - b) <= kAbsolute + kRelative * std::abs(b)) return;
  } else if (found.is_structured() && found.type() == expected.type() && found.size() == expected.size()) {
    for (const auto& [key, value] : expected.items()) {
      const bool there = found.is_array() || found.contains(key);
      if (!there) differences.push_back(at + "/" + key + " is missing");
      if (there)
        compare(found.is_array() ? found.at(std::stoul(key)) : found.at(key), value, at + "/" + key, differences);
    }
    return;
  } else if (found == expected) {
    return;
  }
  differences.push_back(at + ": " + found.dump().substr(0, 80) + " where " + expected.dump().substr(0, 80) + " was");
}

class GoldenDataset : public testing::TestWithParam<const char*> {
 protected:
  const std::string experiment_ = std::string(PRESA_SOURCE_DIR) + "/experiments/" + GetParam();
};

TEST_P(GoldenDataset, IsWholeAndUnaltered) {
  const auto sessions = sessionsIn(experiment_ + "/golden");
  ASSERT_FALSE(sessions.empty());
  for (const SessionFolder& folder : sessions) {
    EXPECT_THAT(validate(folder).findings, IsEmpty()) << folder.path;
  }
}

TEST_P(GoldenDataset, GivesTheSameNumbers) {
  const auto result = analysis::analyse({experiment_ + "/golden", ""}, [](auto...) { return true; });
  Json found = Json::parse(analysis::reportJson(result));
  Json expected = Json::parse(contentsOf(experiment_ + "/golden.json"));
  ASSERT_FALSE(expected.at("analyses").empty());
  for (const char* of_its_run : {"presa", "analysis_file"}) {
    found.erase(of_its_run);
    expected.erase(of_its_run);
  }
  std::vector<std::string> differences;
  compare(found, expected, "", differences);
  EXPECT_THAT(differences, IsEmpty());
}

// Runs the shortest of them again from the shipped file: every trial, its order and every value are the same.
TEST(GoldenSession, MadeAgainHasTheSameRows) {
  const std::string experiment = std::string(PRESA_SOURCE_DIR) + "/experiments/slip_reaction";
  ScratchFolder scratch;
  ASSERT_EQ(std::system((std::string(PRESA_BINARY_DIR) + "/bin/presa experiment run " + experiment +
                         "/experiment.xml --subject S01 --simulated L1 --lockstep --data " + scratch.file("data") +
                         " > " + scratch.file("log") + " 2>&1")
                            .c_str()),
            0)
      << contentsOf(scratch.file("log"));
  const auto logOf = [](const SessionFolder& folder) {
    return readLog(folder.journal(), Journal::read(folder.journal()).records);
  };
  const SessionLog made = logOf(folderOf(scratch.file("data"), "S01", 1));
  const SessionLog golden = logOf(folderOf(experiment + "/golden", "S01", 1));
  ASSERT_EQ(made.runs.size(), golden.runs.size());
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < made.runs.size(); ++i) {
    const std::string at = "run " + std::to_string(i);
    for (const char* name : {"trial", "condition", "seed"})
      compare(made.runs[i].begin[name], golden.runs[i].begin[name], at, differences);
    for (const char* name : {"outcome", "phases", "values"})
      compare(made.runs[i].end[name], golden.runs[i].end[name], at, differences);
  }
  EXPECT_THAT(differences, IsEmpty());
  // the recordings replay bit-exactly, including the change of friction
  int replayed = 0;
  for (const LoggedRun& run : made.runs) {
    if (run.begin["condition"]["slippery"] != "1" || replayed == 2) continue;
    ++replayed;
    const std::string file = folderOf(scratch.file("data"), "S01", 1).file(run.files().front());
    EXPECT_EQ(std::system((std::string(PRESA_BINARY_DIR) + "/bin/presa replay " + file + " --verify > " +
                           scratch.file("log") + " 2>&1")
                              .c_str()),
              0)
        << contentsOf(scratch.file("log"));
  }
  EXPECT_EQ(replayed, 2);
}

INSTANTIATE_TEST_SUITE_P(Experiments, GoldenDataset,
                         testing::Values("friction_jnd", "grip_slip", "slip_reaction", "stiffness_2afc", "weight_2ifc"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace presa::experiment
