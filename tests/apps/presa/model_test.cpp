#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "apps/presa/model/model_files.h"
#include "tests/apps/support/support.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

// What is drawn changes nothing that is felt or moved: the same bits with a model of textures and with a plain cube.
TEST(PhotographedScene, HasTheSameStatesWhateverItLooksLike) {
  RunOptions options;
  options.duration = 2;
  const auto hash = [&](const std::vector<std::string>& sets) {
    return test::runScene("config/scenes/photographed.xml", sets, options)->result().state_hash;
  };
  EXPECT_EQ(hash({}), hash({"body/drum/visual/mesh/file=../meshes/cube.obj"}));
}

class ModelCommand : public testing::Test {
 protected:
  void SetUp() override {
    wanted_.folder = (fs::path(testing::TempDir()) / ("presa_model_command_" + std::to_string(getpid()))).string();
    wanted_.file = PRESA_SOURCE_DIR "/config/meshes/photographed/drum.glb";
    wanted_.haptic_error = 0.001;
    wanted_.pieces = 2;
  }
  void TearDown() override { fs::remove_all(wanted_.folder); }
  model::Wanted wanted_;
};

TEST_F(ModelCommand, WritesABodyThatLoads) {
  Diagnostics found;
  const auto made = model::make(wanted_, found, [](double) { return true; });
  ASSERT_TRUE(made) << found.text();
  EXPECT_EQ(made->name, "drum");
  EXPECT_LE(made->haptic.distance(), 0.001);
  EXPECT_LT(made->haptic.mesh.triangles.size(), made->triangles / 2);
  EXPECT_EQ(made->physics.pieces.size(), 2u);
  const std::string body = model::write(wanted_, *made);
  EXPECT_TRUE(fs::exists(body));
  // the files are closed, and as far apart as was said
  for (const char* file : {"drum_haptic.obj", "drum_piece_1.obj", "drum_piece_2.obj"}) {
    const TriMesh mesh = importMesh((fs::path(wanted_.folder) / file).string(), {}, {}, found);
    EXPECT_TRUE(checkMesh(mesh).closed()) << file;
  }
  EXPECT_TRUE(found.all().empty()) << found.text();
  const std::string text = model::bodyText(wanted_, *made);
  EXPECT_NE(text.find("<haptic><mesh file=\"drum_haptic.obj\"/></haptic>"), std::string::npos) << text;
  EXPECT_NE(text.find("drum.glb\""), std::string::npos) << text;

  Diagnostics again;
  model::checkTarget(wanted_, again);
  ASSERT_TRUE(again.hasErrors());
  EXPECT_EQ(again.all().front().code, 128);
  wanted_.overwrite = true;
  Diagnostics allowed;
  model::checkTarget(wanted_, allowed);
  EXPECT_FALSE(allowed.hasErrors());
}

TEST_F(ModelCommand, StopsWhenToldTo) {
  Diagnostics found;
  EXPECT_FALSE(model::make(wanted_, found, [](double) { return false; }));
  EXPECT_FALSE(found.hasErrors());
}

TEST_F(ModelCommand, NeedsAClosedModel) {
  fs::create_directories(wanted_.folder);
  wanted_.file = wanted_.folder + "/open.obj";
  std::FILE* out = std::fopen(wanted_.file.c_str(), "w");
  std::fputs("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", out);
  std::fclose(out);
  Diagnostics found;
  EXPECT_FALSE(model::make(wanted_, found, [](double) { return true; }));
  ASSERT_TRUE(found.hasErrors());
  EXPECT_EQ(found.all().front().code, 309);
}

}  // namespace
}  // namespace presa
