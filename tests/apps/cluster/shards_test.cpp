// Simulated experiments, hard cases and trials of the temple in shards, by hand and on a real Slurm cluster: the results
// are those of one machine, although a task is killed on the way. tests/apps/studies/cost has those of `presa cost`.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/common/file_text.h"
#include "tests/support/slurm_cluster.h"

namespace presa {
namespace {

using test::presa;
using test::scratch;
using test::source;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// Four sessions of a few simulated seconds.
const std::string kRub =
    "experiment simulate " + source("tests/apps/experiment/fixtures/rub.xml") + " --subjects 2 --seeds 2";
const std::string kColumn = "temple trials --size first --seeds 2 --first-seed 3";
const std::string kCase = "--case coulomb_slide --quick";

std::string submitted(std::string command, const std::string& of) {
  return command.insert(command.find(of) + of.size(), " submit");
}

/// The results of simulated studies, which hold no times of this machine.
std::string numbersOf(const std::string& folder) {
  EXPECT_TRUE(fs::exists(folder + "/studies.csv")) << folder;
  return contentsOf(folder + "/studies.csv") + contentsOf(folder + "/power.csv") +
         contentsOf(folder + "/power_curve.csv");
}

/// A table without the time on the wall.
std::string trialsOf(const std::string& folder) {
  std::istringstream lines(contentsOf(folder + "/trials.csv"));
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t reason = line.rfind(','), wall = line.rfind(',', reason - 1);
    all += line.erase(wall, reason - wall) + "\n";
  }
  return all;
}

std::vector<nlohmann::json> verdictsOf(const std::string& folder) {
  std::ifstream in(folder + "/rows.jsonl");
  std::vector<nlohmann::json> rows;
  for (std::string line; std::getline(in, line);) {
    rows.push_back(nlohmann::json::parse(line));
    rows.back().erase("seconds");
  }
  EXPECT_FALSE(rows.empty()) << folder;
  return rows;
}

TEST(Shards, OfSimulatedStudiesAreTheWhole) {
  const std::string whole = scratch("whole"), merged = scratch("merged");
  ASSERT_EQ(presa(kRub + " --out " + whole).status, 0);
  std::string parts;
  for (const char* shard : {"1", "2"}) {
    const std::string part = scratch(std::string("part_") + shard);
    const auto made = presa(kRub + " --shard " + shard + "/2 --out " + part);
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("2 sessions complete"));
    parts += " " + part;
  }
  const auto outcome = presa("experiment simulate merge" + parts + " --out " + merged);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("4 sessions complete, 4 of them before, 0 failed"));
  EXPECT_EQ(numbersOf(merged), numbersOf(whole));

  const auto refused = [&](const std::string& folders) {
    return presa("experiment simulate merge" + folders + " --out " + scratch("other")).err;
  };
  EXPECT_THAT(refused(parts.substr(0, parts.rfind(' '))), HasSubstr("shard 2/2: error[E812]: is missing"));
  EXPECT_THAT(refused(" " + whole), HasSubstr("error[E810]: holds no finished shard"));
  // a second merge, also into one of the shards, replaces what is there
  EXPECT_EQ(presa("experiment simulate merge" + parts + " --out " + merged).status, 0);
  EXPECT_EQ(presa("experiment simulate merge" + parts + " --out " + whole).status, 0);
  EXPECT_EQ(presa("experiment simulate merge" + parts + " --out " + scratch("part_2")).status, 0);
  EXPECT_EQ(numbersOf(scratch("part_2")), numbersOf(merged));
  fs::remove_all(scratch("part_1") + "/study-002");
  EXPECT_THAT(refused(parts), HasSubstr("error[E810]: is missing: a session of the shard was removed"));
  std::ofstream(scratch("part_1") + "/shard.json") << "{";
  EXPECT_THAT(refused(parts), HasSubstr("error[E810]: cannot be read as a shard"));
  EXPECT_FALSE(fs::exists(scratch("other")));
}

// Each variation has its sessions; a shard that is there already is not run again.
TEST(Shards, OfVariedStudiesAreTheWhole) {
  const std::string varied =
      kRub.substr(0, kRub.find(" --subjects")) + " --subjects 1 --seeds 2 --vary mass=0.3 --power 0.9 --out ";
  ASSERT_EQ(presa(varied + scratch("varied")).status, 0);
  std::string parts;
  for (const char* shard : {"1", "2"}) {
    const std::string part = scratch(std::string("varied_") + shard);
    for (const char* printed : {"1 sessions complete, 0 of them before", ""}) {
      const auto made = presa(varied + part + " --shard " + shard + "/2");
      ASSERT_EQ(made.status, 0) << made.err;
      EXPECT_THAT(made.out, HasSubstr(printed));
      EXPECT_THAT(made.out, HasSubstr("When all shards are there"));
    }
    parts += " " + part;
  }
  const auto outcome = presa("experiment simulate merge" + parts + " --out " + scratch("varied_all"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(contentsOf(scratch("varied_all") + "/variations.csv"), contentsOf(scratch("varied") + "/variations.csv"));
}

TEST(Shards, OfTrialsAreTheWhole) {
  const std::string whole = scratch("trials"), merged = scratch("merged_trials");
  const auto all = presa(kColumn + " --out " + whole);
  ASSERT_EQ(all.status, 0) << all.out << all.err;
  EXPECT_THAT(all.out, HasSubstr("2 of 2 buildings whole: 100 % (95 % interval 34 to 100 %)"));
  EXPECT_THAT(contentsOf(whole + "/trials.html"), HasSubstr("When buildings were whole"));
  std::string parts;
  for (const char* shard : {"1", "2"}) {
    parts += " " + scratch(std::string("trial_") + shard);
    ASSERT_EQ(presa(kColumn + " --shard " + shard + "/2 --out " + scratch(std::string("trial_") + shard)).status, 0);
  }
  ASSERT_EQ(presa("temple trials merge" + parts + " --out " + merged).status, 0);
  EXPECT_EQ(trialsOf(merged), trialsOf(whole));
}

// A trial that does not finish is told with the command that shows it.
TEST(Trials, ThatFailAreNamed) {
  const auto outcome = presa("temple trials --size first --seeds 1 --first-seed 3 --for 3 --out " + scratch("short"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.out, HasSubstr("0 of 1 buildings whole"));
  EXPECT_THAT(outcome.out,
              HasSubstr("seed 3: 0 of 3 blocks placed, 0 dropped, 0 lost: presa temple --auto --lockstep --seed 3 "
                        "--size first --plan vitruvius --for 3"));
}

class Slurm : public test::SlurmCluster {};

TEST_F(Slurm, SimulatesStudiesAlthoughATaskIsKilled) {
  if (!runs_) GTEST_SKIP() << why_;
  ASSERT_EQ(presa(kRub + " --out " + in("whole")).status, 0);
  const auto outcome = presaAndKill(submitted(kRub, "simulate") + " --slurm --tasks 2 --out " + in("merged"), 2,
                                    in("merged/shards/2/study-001/sub-S02"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(numbersOf(in("merged")), numbersOf(in("whole")));
  const std::string log = contentsOf(in("merged/shards/task_2.log"));
  EXPECT_NE(log.find("part 2, job "), log.rfind("part 2, job ")) << log;  // it was there twice
}

TEST_F(Slurm, RunsHardCasesAndTrials) {
  if (!runs_) GTEST_SKIP() << why_;
  const std::string on = " --slurm --tasks 2 --out ";
  ASSERT_EQ(presa("stability " + kCase + " --out " + in("whole")).status, 0);
  const auto cases = presa("stability submit " + kCase + on + in("cases"));
  ASSERT_EQ(cases.status, 0) << cases.err;
  EXPECT_EQ(verdictsOf(in("cases")), verdictsOf(in("whole")));

  ASSERT_EQ(presa(kColumn + " --out " + in("trials")).status, 0);
  const auto trials = presa(submitted(kColumn, "trials") + on + in("cluster_trials"));
  ASSERT_EQ(trials.status, 0) << trials.err;
  EXPECT_EQ(trialsOf(in("cluster_trials")), trialsOf(in("trials")));
}

}  // namespace
}  // namespace presa
