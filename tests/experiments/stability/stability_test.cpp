#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/studies/stability/runner.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::stability {
namespace {

namespace fs = std::filesystem;

class Stability : public testing::Test {
 protected:
  void SetUp() override {
    ::setenv("PRESA_EXPERIMENTS", PRESA_SOURCE_DIR "/experiments", 1);
    folder_ = fs::temp_directory_path() / ("presa_stability_" + std::to_string(::getpid()));
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<nlohmann::json> rows() const {
    std::vector<nlohmann::json> all;
    std::ifstream file(folder_ / "rows.jsonl");
    for (std::string line; std::getline(file, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }
  RunnerOptions into(std::vector<std::string> cases = {}) const {
    RunnerOptions options;
    options.cases = std::move(cases);
    options.out = folder_.string();
    return options;
  }

  fs::path folder_;
};

Case caseOf(const std::string& name, Verdict expected, std::function<std::vector<Finding>()> run) {
  Case c;
  c.name = name;
  c.title = c.source = c.oracle = "made for this test";
  c.scene = "grasp_in_air.xml";
  Trial trial;
  trial.parameters = {{"mass", "1 g"}};
  trial.method = kPresa;
  trial.expected = expected;
  trial.run = std::move(run);
  c.trials.push_back(std::move(trial));
  return c;
}

TEST_F(Stability, TheQuickSubsetHolds) {
  RunnerOptions options = into();
  options.quick = true;
  EXPECT_EQ(runCases(options), 0);
  const auto all = rows();
  EXPECT_GT(all.size(), 20u);
  for (const auto& row : all) {
    if (row.at("method") != kPresa || row.at("expected") != "stable") continue;
    EXPECT_EQ(row.at("verdict"), "stable") << row.dump();
  }
}

TEST_F(Stability, EveryRowHasWhatIsPromised) {
  ASSERT_EQ(runCases(into({"made"}),
                     {caseOf("made", Verdict::kStable, [] { return std::vector{finding("m", 0.5, "N", 1, "o")}; })}),
            0);
  ASSERT_EQ(rows().size(), 1u);
  for (const char* key :
       {"case", "parameters", "verdict", "metric", "value", "oracle", "source", "seconds", "expected", "method"}) {
    EXPECT_TRUE(rows()[0].contains(key)) << key;
  }
  EXPECT_EQ(rows()[0].at("parameters").at("mass"), "1 g");
  EXPECT_EQ(rows()[0].at("value"), 0.5);
  EXPECT_TRUE(fs::exists(folder_ / "report.html"));
}

TEST_F(Stability, AWorseVerdictFailsTheRunABetterOneDoesNot) {
  const auto with = [](double value) { return [value] { return std::vector{finding("m", value, "", 1, "o")}; }; };
  EXPECT_EQ(runCases(into(), {caseOf("made", Verdict::kStable, with(1.0))}), 0);
  EXPECT_EQ(runCases(into(), {caseOf("made", Verdict::kStable, with(1.1))}), 1);
  EXPECT_EQ(rows()[0].at("verdict"), "drift");
  EXPECT_EQ(runCases(into(), {caseOf("made", Verdict::kDrift, with(10.1))}), 1);
  EXPECT_EQ(rows()[0].at("verdict"), "unstable");
  EXPECT_EQ(runCases(into(), {caseOf("made", Verdict::kUnstable, with(0.1))}), 0);
  EXPECT_EQ(runCases(into(), {caseOf("made", Verdict::kDrift, with(NAN))}), 1);
  EXPECT_TRUE(rows()[0].at("value").is_null());
}

// A real scene, spoiled: 1 g at 10 N/mm with explicit coupling, declared stable.
TEST_F(Stability, AMethodThatIsNotStableIsFoundOut) {
  std::vector<Case> all = allCases();
  std::erase_if(all, [](const Case& c) { return c.name != "grasp_in_air"; });
  ASSERT_EQ(all.size(), 1u);
  std::erase_if(all[0].trials, [](const Trial& trial) { return trial.method == kPresa || !trial.quick; });
  ASSERT_FALSE(all[0].trials.empty());
  for (Trial& trial : all[0].trials) trial.expected = Verdict::kStable;
  EXPECT_EQ(runCases(into(), all), 1);
}

TEST_F(Stability, ATrialThatCrashesOrThrowsIsARowAndTheOthersGoOn) {
  std::vector<Case> all{
      caseOf("crash", Verdict::kStable,
             []() -> std::vector<Finding> {
               ::raise(SIGKILL);
               return {};
             }),
      caseOf("throw", Verdict::kStable, []() -> std::vector<Finding> { throw std::runtime_error("no such body"); }),
      caseOf("fine", Verdict::kStable, [] { return std::vector{finding("m", 0, "", 1, "o")}; })};
  EXPECT_EQ(runCases(into(), all), 1);
  ASSERT_EQ(rows().size(), 3u);
  EXPECT_EQ(rows()[0].at("verdict"), "failed");
  EXPECT_NE(rows()[0].at("reason").get<std::string>().find("crashed"), std::string::npos);
  EXPECT_EQ(rows()[1].at("verdict"), "failed");
  EXPECT_EQ(rows()[1].at("reason"), "no such body");
  EXPECT_EQ(rows()[2].at("verdict"), "stable");
}

// Three cases in two shards, one of which crashes: the rows and the status are those of one run.
TEST_F(Stability, ShardsAreTheWholeRun) {
  const auto with = [](double value) { return [value] { return std::vector{finding("m", value, "", 1, "o")}; }; };
  const std::vector<Case> all{
      caseOf("fine", Verdict::kStable, with(0.25)),
      caseOf("throw", Verdict::kStable, []() -> std::vector<Finding> { throw std::runtime_error("no such body"); }),
      caseOf("drifts", Verdict::kDrift, with(NAN))};
  const auto timeless = [this] {
    std::vector<nlohmann::json> lines = rows();
    for (nlohmann::json& row : lines) row["seconds"] = 0;
    return lines;
  };
  EXPECT_EQ(runCases(into(), all), 1);
  const auto whole = timeless();
  fs::remove_all(folder_);
  std::vector<std::string> folders;
  for (int i = 1; i <= 2; ++i) {
    RunnerOptions options = into();
    options.out = folders.emplace_back((folder_ / ("part_" + std::to_string(i))).string());
    options.shard = {i, 2};
    EXPECT_EQ(runCases(options, all), 0);
  }
  EXPECT_EQ(mergeCases(folders, into(), all), 1);
  EXPECT_EQ(timeless(), whole);
  const auto refusal = [&](const std::vector<std::string>& parts, const std::vector<Case>& cases) {
    try {
      mergeCases(parts, into(), cases);
    } catch (const InputError& error) {
      return error.diagnostics().text();
    }
    return std::string();
  };
  EXPECT_NE(refusal({folders[1]}, all).find("shard 1/2: error[E812]: is missing"), std::string::npos);
  EXPECT_NE(refusal({folders[1], folders[1]}, all).find("error[E811]"), std::string::npos);
  EXPECT_NE(refusal(folders, {all[0], all[1]}).find("was made with other cases"), std::string::npos);
  std::ofstream(folders[0] + "/shard.json") << "{";
  EXPECT_NE(refusal(folders, all).find("error[E810]"), std::string::npos);
}

TEST_F(Stability, AFolderThatCannotBeWrittenIsRefusedBeforeAnyWork) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  const fs::path ran = folder_.string() + "_ran";
  const auto run = [ran]() -> std::vector<Finding> {
    std::ofstream{ran};
    return {finding("m", 0, "", 1, "o")};
  };
  EXPECT_THROW(runCases(into(), {caseOf("made", Verdict::kStable, run)}), InputError);
  EXPECT_FALSE(fs::exists(ran));
}

struct Outcome {
  int status = -1;
  std::string err;
};
Outcome program(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe = ::popen((PRESA_BINARY_DIR "/bin/presa stability " + arguments + " 2>&1 >/dev/null").c_str(), "r");
  char buffer[256];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) outcome.err += buffer;
  outcome.status = WEXITSTATUS(::pclose(pipe));
  return outcome;
}

TEST_F(Stability, AnUnknownNameIsBadInputWithAHint) {
  const Outcome outcome = program("--case grasp_in_aire");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("did you mean"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("grasp_in_air"), std::string::npos) << outcome.err;
}

TEST_F(Stability, AFolderThatCannotBeWrittenIsBadInput) {
  std::ofstream(folder_.string()) << "a file where the folder should be";
  EXPECT_EQ(program("--case grasp_in_air --out " + folder_.string()).status, 2);
}

}  // namespace
}  // namespace presa::stability
