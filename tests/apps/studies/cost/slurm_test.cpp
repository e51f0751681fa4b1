// A study on a real Slurm cluster of one node: merged it is the whole study to the bit, although a task is killed on the
// way; a shard that never finishes, and no cluster.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "tests/apps/studies/cost/shard_support.h"
#include "tests/support/slurm_cluster.h"

namespace presa {
namespace {

using test::accuracyOf;
using test::kStudy;
using test::shell;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kProgram = PRESA_BINARY_DIR "/bin/presa";

class Slurm : public test::SlurmCluster {
 protected:
  nlohmann::json read(const std::string& file) const { return nlohmann::json::parse(contentsOf(in(file))); }
  /// The study in three shards, of which number 2 is killed once while it runs.
  test::Outcome submitAndKill(const std::string& study, const std::string& more) const {
    return presaAndKill(study + more + " --slurm --tasks 3 --out " + in("merged"), 2, in("merged/shards/2/runs"));
  }
  static std::string submitted(const std::string& study) { return "cost submit" + study.substr(4); }
};

TEST_F(Slurm, MakesTheStudyAlthoughATaskIsKilled) {
  if (!runs_) GTEST_SKIP() << why_;
  const std::string study = kStudy + ",averaged";
  ASSERT_EQ(test::presa(study + " --out " + in("whole")).status, 0);
  const auto outcome = submitAndKill(submitted(study), "");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(accuracyOf(read("whole/cost.json")), accuracyOf(read("merged/cost.json")));
  EXPECT_THAT(outcome.out, HasSubstr("None of the "));
  // the task was there twice
  const std::string log = contentsOf(in("merged/shards/task_2.log"));
  EXPECT_NE(log.find("part 2, job "), log.rfind("part 2, job ")) << log;
}

TEST_F(Slurm, SaysWhichShardNeverFinished) {
  if (!runs_) GTEST_SKIP() << why_;
  const auto outcome = submitAndKill(submitted(kStudy), " --retries 0");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("shard 2/3: error[E814]: never finished, after 1 attempt"));
  EXPECT_THAT(outcome.err, HasSubstr("merged/shards/task_2.log"));
  // what was done is kept
  const auto again = shell(kProgram + " " + submitted(kStudy) + " --slurm --tasks 3 --resume --out " + in("merged"));
  EXPECT_EQ(again.status, 0) << again.err;
}

// What an earlier submission made stays, until Slurm has taken the job; --resume asks whose it is.
TEST_F(Slurm, ThatRefusesTheJobIsQuoted) {
  if (!runs_) GTEST_SKIP() << why_;
  const std::string first = kProgram + " " + submitted(kStudy) + " --slurm --tasks 2 --out '" + in("my 100% out") + "'";
  ASSERT_EQ(shell(first).status, 0);
  EXPECT_EQ(shell(first + " --sbatch=--partition=none").status, 2);
  EXPECT_TRUE(fs::exists(in("my 100% out/shards/2/shard.json")));
  const auto other = shell(first + " --resume --seed 7");
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(read("my 100% out/cost.json").at("seed"), 7);
  const auto outcome =
      shell(kProgram + " " + submitted(kStudy) + " --slurm --sbatch=--partition=none --out " + in("merged"));
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("error[E813]: Slurm refuses the job: "));
  EXPECT_THAT(outcome.err, HasSubstr("invalid partition"));
}

TEST(NoSlurm, IsSaidBeforeAnyWork) {
  const std::string out = test::scratch("nowhere");
  const auto outcome = shell("PATH=/nowhere " + kProgram + " cost submit" + kStudy.substr(4) + " --slurm --out " + out);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("error[E813]: no job can be submitted from here: sbatch is not on the PATH"));
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace presa
