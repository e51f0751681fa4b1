// A study in shards: merged it is the whole study to the bit, whatever was killed on the way; what does not belong
// together is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/common/file_text.h"
#include "tests/apps/studies/cost/shard_support.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

using nlohmann::json;
using test::accuracyOf;
using test::kStudy;
using test::presa;
using test::shell;
using test::source;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder of studies, empty at first.
class Shards : public testing::Test {
 protected:
  Shards() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string in(const std::string& name) const { return folder_ + "/" + name; }
  /// The study in `count` shards "part_1", "part_2", …
  void make(const std::string& study, int count) const {
    for (int i = 1; i <= count; ++i) {
      const std::string number = std::to_string(i);
      const auto outcome =
          presa(study + " --shard " + number + "/" + std::to_string(count) + " --out " + in("part_" + number));
      ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
  }
  test::Outcome merge(const std::string& parts, const std::string& more = "", const std::string& out = "merged") const {
    std::string command = "cost merge";
    for (const char part : parts) command += " " + in(std::string("part_") + part);
    return presa(command + " --out " + in(out) + more);
  }
  void expectRefused(const std::string& parts, const std::string& code, const std::string& what,
                     const std::string& out = "merged") const {
    const auto outcome = merge(parts, "", out);
    EXPECT_EQ(outcome.status, 2) << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr("error[" + code + "]"));
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_FALSE(fs::exists(in("merged/cost.json")));
  }
  json read(const std::string& file) const { return json::parse(contentsOf(in(file))); }
  void write(const std::string& file, const std::string& text) const { std::ofstream(in(file)) << text; }

  const std::string folder_ = test::scratch("shards");
};

TEST_F(Shards, MergedAreTheWholeStudyToTheBit) {
  ASSERT_EQ(presa(kStudy + " --out " + in("whole")).status, 0);
  make(kStudy, 3);
  const auto merged = merge("312");
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("None of the 4 settings failed."));
  const json whole = read("whole/cost.json"), together = read("merged/cost.json");
  EXPECT_EQ(accuracyOf(whole), accuracyOf(together));
  for (const json& setting : together.at("settings")) EXPECT_EQ(setting.at("repeats").size(), 2u);
  EXPECT_TRUE(fs::exists(in("merged/report.html")));
}

// Decimated meshes lie in the folder of each shard: the runs are the same all the same.
TEST_F(Shards, ShareMeshesThatEachWrites) {
  const std::string study =
      "cost " + source("config/scenes/pinch_and_lift.xml") + " --quick --for 1.2 --knob haptic_mesh=1,1/4,1/8";
  ASSERT_EQ(presa(study + " --out " + in("whole")).status, 0);
  make(study, 2);
  const auto merged = merge("12");
  ASSERT_EQ(merged.status, 0) << merged.err;
  json whole = read("whole/cost.json"), together = read("merged/cost.json");
  for (json* result : {&whole, &together})
    for (json& setting : result->at("settings")) setting["set"] = nullptr;  // paths of its own folder
  EXPECT_EQ(accuracyOf(whole), accuracyOf(together));
}

// One is killed at any moment and goes on, another one is lost and made again.
TEST_F(Shards, SurviveTheLossOfAMachine) {
  ASSERT_EQ(presa(kStudy + " --out " + in("whole")).status, 0);
  make(kStudy, 2);
  fs::remove_all(in("part_1"));
  const std::string first = kStudy + " --shard 1/2 --out " + in("part_1");
  for (const char* seconds : {"0.1", "0.4", "0.7"}) {
    shell(std::string("timeout -s KILL ") + seconds + " " + PRESA_BINARY_DIR + "/bin/presa " + first + " --resume");
    if (!fs::exists(in("part_1/shard.json"))) expectRefused("12", "E810", "holds no finished shard");
  }
  ASSERT_EQ(presa(first + " --resume").status, 0);
  fs::remove_all(in("part_2"));
  expectRefused("1", "E812", "shard 2/2: error[E812]: is missing");
  ASSERT_EQ(presa(kStudy + " --shard 2/2 --out " + in("part_2")).status, 0);
  ASSERT_EQ(merge("12").status, 0);
  EXPECT_EQ(accuracyOf(read("whole/cost.json")), accuracyOf(read("merged/cost.json")));
}

TEST_F(Shards, OfOtherStudiesAreRefused) {
  make(kStudy, 2);
  expectRefused("11", "E811", "is shard 1/2, which");
  fs::rename(in("part_2"), in("part_5"));
  ASSERT_EQ(presa(kStudy + ",averaged --shard 2/2 --out " + in("part_2")).status, 0);
  expectRefused("12", "E811", "is of another study than");
  ASSERT_EQ(presa(kStudy + " --shard 2/4 --out " + in("part_3")).status, 0);
  expectRefused("13", "E811", "is shard 2/4, ");
  json other = read("part_5/shard.json");
  other["version"] = "0.1";
  fs::copy(in("part_5"), in("part_4"), fs::copy_options::recursive);
  write("part_4/shard.json", other.dump());
  expectRefused("14", "E811", "was made by Presa 0.1, this is");
  expectRefused("15", "E811", "is the folder of shard", "part_5");
}

TEST_F(Shards, OfAChangedSceneAreRefused) {
  const std::string scene = test::cubeWith("sharded", [](std::string&) {});
  make("cost " + scene + " --rig " + source("config/rigs/pinch_cube.xml") +
           " --for 1 --quick --knob dynamics_rate=100,200",
       2);
  std::string text = contentsOf(scene);
  text.replace(text.find("mass=\"0.2\""), 10, "mass=\"0.3\"");
  std::ofstream(scene) << text;
  expectRefused("12", "E811", "the study is not as it was");
}

TEST_F(Shards, ThatAreDamagedAreRefused) {
  make(kStudy, 2);
  write("part_1/shard.json", contentsOf(in("part_1/shard.json")).substr(0, 200));
  expectRefused("12", "E810", "cannot be read as a shard");
  make(kStudy, 1);
  fs::remove_all(in("part_1"));
  make(kStudy, 2);
  for (const char* kind : {".trace", ".json"}) {
    std::string lost;
    for (const auto& entry : fs::directory_iterator(in("part_2/runs")))
      if (entry.path().extension() == kind) lost = entry.path();
    const std::string text = contentsOf(lost);
    fs::resize_file(lost, text.size() / 2);
    expectRefused("12", "E810", "is damaged");
    fs::remove(lost);
    expectRefused("12", "E810", "is damaged");
    std::ofstream(lost, std::ios::binary) << text;
  }
  EXPECT_EQ(merge("12").status, 0);
}

// Costs of two machines are in no front together: with --mixed all are measured where the shards are merged.
TEST_F(Shards, OfSeveralMachinesKeepTheirErrorsAlone) {
  make(kStudy, 2);
  for (const auto& entry : fs::directory_iterator(in("part_2/runs"))) {
    if (entry.path().string().find(".time") == std::string::npos) continue;
    json cost = json::parse(contentsOf(entry.path()));
    cost["hardware"] = "Slow 486, 1 available";
    cost["cpu_per_simulated_s"] = 1e6;
    std::ofstream(entry.path()) << cost.dump();
  }
  expectRefused("12", "E811", "has costs of another machine than");
  const auto merged = merge("12", " --mixed");
  ASSERT_EQ(merged.status, 0) << merged.err;
  const json result = read("merged/cost.json");
  for (const json& setting : result.at("settings")) {
    EXPECT_EQ(setting.at("repeats").size(), 2u);
    EXPECT_LT(setting.at("cpu_per_simulated_s").at("high"), 1e3);
  }
  EXPECT_EQ(contentsOf(in("merged/runs.csv")).find("Slow 486"), std::string::npos);
}

// Of a mesh that changed between two shards only the name is the same.
TEST_F(Shards, OfAChangedMeshAreRefused) {
  fs::create_directories(in("scene"));
  fs::copy(source("config/meshes"), in("scene/meshes"), fs::copy_options::recursive);
  std::string text = contentsOf(source("config/scenes/pinch_and_lift.xml"));
  for (std::size_t at = 0; (at = text.find("../meshes/", at)) != std::string::npos;) text.erase(at, 3);
  write("scene/scene.xml", text);
  const std::string study = "cost " + in("scene/scene.xml") + " --rig " + source("config/rigs/pinch_and_lift.xml") +
                            " --quick --for 0.5 --knob dynamics_rate=100,200";
  ASSERT_EQ(presa(study + " --shard 1/2 --out " + in("part_1")).status, 0);
  for (const auto& mesh : fs::directory_iterator(in("scene/meshes")))
    if (mesh.path().extension() == ".obj") std::ofstream(mesh.path(), std::ios::app) << "# touched\n";
  ASSERT_EQ(presa(study + " --shard 2/2 --out " + in("part_2")).status, 0);
  expectRefused("12", "E811", "is of another study than");
}

// A run that is killed for want of memory says nothing about its setting.
TEST_F(Shards, WithAKilledRunAreNotFinished) {
  const std::string shard = kStudy + " --shard 1/1 --jobs 1 --out " + in("part_1");
  const auto killed =
      shell(std::string("sh -c '") + PRESA_BINARY_DIR + "/bin/presa " + shard +
            " & pid=$!; until starter=$(pgrep -P $pid) && pkill -KILL -P $starter; do sleep 0.002; done; wait $pid'");
  EXPECT_EQ(killed.status, 1) << killed.err;
  EXPECT_THAT(killed.err, HasSubstr("killed from outside"));
  EXPECT_FALSE(fs::exists(in("part_1/shard.json")));
  ASSERT_EQ(presa(shard + " --resume").status, 0);
  const auto merged = merge("1");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_THAT(merged.out, HasSubstr("None of the 4 settings failed."));
}

TEST_F(Shards, AreNumberedFromOne) {
  for (const std::string bad : {"0/3", "4/3", "2", "a/b", "1/0", "1/2/3"}) {
    const auto outcome = presa(kStudy + " --shard " + bad + " --out " + in("never"));
    EXPECT_EQ(outcome.status, 2) << bad;
    EXPECT_THAT(outcome.err, HasSubstr("expects I/N with I from 1 to N, as 2/8, found '" + bad + "'"));
  }
  const auto applied = presa(kStudy + " --shard 1/2 --apply " + in("better.xml"));
  EXPECT_EQ(applied.status, 2);
  EXPECT_THAT(applied.err, HasSubstr("--apply: error[E123]: needs the whole study"));
  const auto none = presa("cost");
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("SCENE is missing"));
}

}  // namespace
}  // namespace presa
