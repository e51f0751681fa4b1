// A copy of a scene with overrides: the file's own text, and the same scene as loading with --set.
#include "framework/scene/scene_copy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace presa {
namespace {

namespace fs = std::filesystem;

const std::string kScenes = std::string(PRESA_SOURCE_DIR) + "/config/scenes/";

/// All values of the copy are those of the original with the overrides; the order of added elements may differ.
void expectSameScene(const std::string& file, const std::vector<Override>& overrides) {
  SCOPED_TRACE(file);
  const fs::path folder = fs::temp_directory_path() / "presa_scene_copy" / "deeper";
  fs::create_directories(folder);
  for (const std::string& to : {(folder / "copy.xml").string(), kScenes + "copy.xml"}) {
    Diagnostics diagnostics;
    const std::string text = sceneCopy(file, overrides, to, diagnostics);
    const Scene copy = readCopy(text, to, diagnostics);
    const Scene wanted = loadScene(file, overrides, diagnostics);
    ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    std::string a = copy.resolved_xml, b = wanted.resolved_xml;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    EXPECT_EQ(a, b) << text;
  }
}

TEST(SceneCopy, IsTheSceneWithTheOverrides) {
  for (const auto& entry : fs::directory_iterator(kScenes))
    if (entry.path().extension() == ".xml") expectSameScene(entry.path().string(), {});
  expectSameScene(kScenes + "cube.xml", {{"rates/dynamics", "500"},
                                         {"dynamics/coupling", "explicit"},
                                         {"dynamics/solver", "direct"},
                                         {"body/cube/physics/density", "700"},
                                         {"body/cube/euler_deg", "0 0 10"},
                                         {"device/thumb/limits/force", "4"},
                                         {"material/rubber/friction/static", "0.9"}});
}

TEST(SceneCopy, ReportsAnUnknownPath) {
  Diagnostics diagnostics;
  EXPECT_EQ(sceneCopy(kScenes + "cube.xml", {{"body/cub/pos", "0 0 0"}}, "copy.xml", diagnostics), "");
  EXPECT_TRUE(diagnostics.hasErrors());
}

}  // namespace
}  // namespace presa
