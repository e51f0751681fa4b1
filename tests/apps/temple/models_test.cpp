#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "apps/temple/building/building.h"
#include "apps/temple/building/scene_text.h"
#include "apps/temple/models/block_models.h"
#include "framework/geometry/obj_text.h"

namespace presa::temple {
namespace {

namespace fs = std::filesystem;

class BlockModels : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("presa_block_models_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "models");
    setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
    Diagnostics found;
    building_ = makeBuilding(shippedProportions("first", found), 0.1, 1);
    ASSERT_FALSE(found.hasErrors());
  }
  void TearDown() override { fs::remove_all(folder_); }
  void put(const std::string& name, TriMesh mesh, const Vec3& scale) {
    for (Vec3& v : mesh.vertices) v = scale.cwiseProduct(v) + Vec3(3, 4, 5);  // anywhere, in any unit
    std::ofstream(folder_ / "models" / name) << objText(mesh);
  }
  std::vector<std::string> use() { return useModels(building_, (folder_ / "models").string(), found_); }

  fs::path folder_;
  Building building_;
  Diagnostics found_;
};

// Drums become the model, fitted to the box of the generated drum; capitals, and everything that moves, stay.
TEST_F(BlockModels, AreFittedToTheirBlocksAndMoveAsBefore) {
  const Building before = building_;
  const AxisBox drum = boundsOf(building_.blocks.front().visual);
  ASSERT_EQ(building_.blocks.front().kind, BlockKind::kDrum);
  const double height = (drum.high - drum.low).z(), width = (drum.high - drum.low).x();
  put("drum.obj", makeCylinder(width / 2, height, 160), Vec3::Constant(50));
  const std::vector<std::string> lines = use();
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].find("drum: drum.obj, 640 triangles, "), 0u) << lines[0];
  for (std::size_t i = 0; i < building_.blocks.size(); ++i) {
    const Block &now = building_.blocks[i], &was = before.blocks[i];
    EXPECT_EQ(now.mass, was.mass);
    EXPECT_EQ(now.physics.index(), was.physics.index());
    EXPECT_EQ(now.model.has_value(), now.kind == BlockKind::kDrum);
    if (!now.model) continue;
    const AxisBox felt = boundsOf(now.haptic), box = boundsOf(was.visual);
    EXPECT_LT((felt.low - box.low).norm() + (felt.high - box.high).norm(), 4 * 0.00015) << now.name;
    EXPECT_LT(now.haptic.triangles.size(), 400u);
  }
  const std::string scene = sceneText(building_, assembled(building_));
  EXPECT_NE(scene.find("models/drum.obj\" scale=\""), std::string::npos);
  // a second start takes what is felt from the cache
  Building again = before;
  Diagnostics none;
  EXPECT_EQ(useModels(again, (folder_ / "models").string(), none), lines);
  EXPECT_EQ(again.blocks.front().haptic.triangles.size(), building_.blocks.front().haptic.triangles.size());
  EXPECT_FALSE(fs::is_empty(folder_ / "cache/presa/felt"));
}

// The shipped photographed drum on the program's command line: the column is rebuilt as without it.
TEST_F(BlockModels, TheProgramRebuildsWithThem) {
  fs::copy(PRESA_SOURCE_DIR "/config/meshes/photographed/drum.glb", folder_ / "models/drum.glb");
  const auto temple = [&](const std::string& more) {
    const std::string out = (folder_ / "out").string();
    const int status = std::system(
        (PRESA_BINARY_DIR "/bin/presa temple --size first --auto --lockstep --seed 7 " + more + " >" + out + " 2>&1")
            .c_str());
    std::ifstream in(out);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(status, 0) << text;
    return text;
  };
  const std::string with = temple("--models " + (folder_ / "models").string()), without = temple("");
  EXPECT_NE(with.find("drum: drum.glb, 8448 triangles, "), std::string::npos) << with;
  for (const std::string& text : {with, without})
    EXPECT_NE(text.find("3 of 3 blocks in their places, at most 0.000 mm"), std::string::npos) << text;
}

TEST_F(BlockModels, OfOtherProportionsOrNoneAreErrors) {
  use();
  ASSERT_TRUE(found_.hasErrors());
  EXPECT_EQ(found_.all().front().code, 270);
  put("drum.obj", makeCylinder(0.01, 0.2), Vec3::Ones());
  found_ = {};
  use();
  ASSERT_TRUE(found_.hasErrors());
  EXPECT_EQ(found_.all().front().code, 271) << found_.text();
}

}  // namespace
}  // namespace presa::temple
