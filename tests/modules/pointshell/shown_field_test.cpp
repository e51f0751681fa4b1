// What pictures show is the renderer's own field; building one tells how far it has come, and can be stopped.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "framework/geometry/long_work.h"
#include "framework/haptics/renderers.h"
#include "framework/scene/load.h"
#include "modules/pointshell/solid.h"

namespace presa::shown_field_test {
namespace {

std::shared_ptr<const World> pegInHole() {
  Diagnostics diagnostics;
  Scene scene = loadScene(std::string(PRESA_SOURCE_DIR) + "/config/scenes/peg_in_hole.xml", {}, diagnostics);
  auto world = std::make_shared<const World>(buildWorld(std::move(scene), {}, diagnostics));
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return world;
}

const FieldSettings kUsual{0, std::size_t{256} << 20U};

TEST(ShownField, IsTheOneThatTheRendererUses) {
  const auto world = pegInHole();
  const std::vector<Solid> solids = solidsOf(*world, kUsual), again = solidsOf(*world, kUsual);
  const std::vector<ToolField> shown = toolFieldsOf(*world);
  ASSERT_EQ(shown.size(), solids.size());
  std::size_t meshes = 0;
  for (std::size_t s = 0; s < solids.size(); ++s) {
    EXPECT_EQ(shown[s].body, solids[s].body);
    EXPECT_EQ(shown[s].voxel, solids[s].voxel());
    EXPECT_EQ(solids[s].field, again[s].field) << "one in memory";
    meshes += solids[s].field ? 1 : 0;
    const SeenSolid seen(solids[s], Pose{});
    for (const Eigen::Vector3f& p : {Eigen::Vector3f(0, 0, 0.01F), Eigen::Vector3f(0.011F, 0.002F, 0.02F)}) {
      SeenPoints points(seen);
      points.add(p);
      points.lookUp();
      // the same lookup by another way of rounding, in voxels of 0.2 mm or so
      EXPECT_NEAR(shown[s].distance(p.cast<double>()), points.distance(0), 1e-9);
    }
  }
  EXPECT_EQ(meshes, 1U);
}

TEST(ShownField, IsBuiltAnewOnceNobodyHasIt) {
  const auto world = pegInHole();
  std::weak_ptr<const DistanceField> last;
  for (const Solid& solid : solidsOf(*world, kUsual))
    if (solid.field) last = solid.field;
  EXPECT_TRUE(last.expired());
}

/// A folder that holds nothing yet, as the user's cache.
class LongWork : public testing::Test {
 protected:
  LongWork() : folder_(std::filesystem::temp_directory_path() / ("presa_long_work_" + std::to_string(getpid()))) {
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  }
  ~LongWork() override {
    unsetenv("XDG_CACHE_HOME");
    std::filesystem::remove_all(folder_);
  }
  std::filesystem::path folder_;
};

TEST_F(LongWork, TellsHowFarAFieldHasCome) {
  const auto world = pegInHole();
  std::vector<double> shares;
  std::string what;
  const LongWorkListener listener([&](const std::string& told, double share) {
    what = told;
    shares.push_back(share);
    return true;
  });
  solidsOf(*world, {.voxel = 0.0008, .max_bytes = kUsual.max_bytes});
  EXPECT_EQ(what, "distance field of body 'socket'");
  ASSERT_GT(shares.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_GE(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
}

TEST_F(LongWork, StopsWithoutAFindingAndKeepsNothing) {
  const auto world = pegInHole();
  int calls = 0;
  const LongWorkListener listener([&](const std::string&, double) { return ++calls < 5; });
  EXPECT_THROW(toolFieldsOf(*world), WorkStopped);  // through the host of plug-ins
  EXPECT_EQ(calls, 5);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "presa" / "fields"));
}

}  // namespace
}  // namespace presa::shown_field_test
