// Which files a viewer opens for a scene received over the bus.
#include "framework/bus/mesh_store.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/record/checksum/checksum.h"
#include "framework/scene/load.h"

namespace presa::bus {
namespace {

namespace fs = std::filesystem;

struct Folders {
  Folders() {
    fs::remove_all(root);
    fs::create_directories(here / "below");
    fs::create_directories(there);
  }
  ~Folders() { fs::remove_all(root); }
  std::string write(const fs::path& file, const std::string& text) const {
    std::ofstream(file) << text;
    return file.string();
  }
  fs::path root = fs::path(testing::TempDir()) / ("mesh_shelf_" + std::to_string(getpid())), here = root / "here",
           there = root / "there";
};

Scene sceneWith(const std::string& mesh, const std::string& second = {}) {
  Diagnostics diagnostics;
  const auto body = [](const std::string& name, const std::string& file) {
    return "<body name=\"" + name + "\" fixed=\"true\"><visual><mesh file=\"" + file + "\"/></visual></body>";
  };
  Scene scene = parseScene(R"(<scene version="1.0" name="s"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="1000"/></materials>)" +
                               body("a", mesh) + (second.empty() ? "" : body("b", second)) + "</scene>",
                           "scene", ".", {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return scene;
}

std::string fileOf(const Scene& scene, std::size_t body = 0) {
  return std::get<MeshRef>(scene.bodies.at(body).visual->shape).file;
}

RunInfo runOf(const Scene& scene) {
  RunInfo run;
  run.mesh_sums = sumsOfMeshes(scene);
  return run;
}

// A mesh is found by its bytes, under any name, also in sub-folders.
TEST(MeshShelf, FindsTheBytesUnderAnyName) {
  const Folders folders;
  const std::string sent = folders.write(folders.there / "cup.obj", "cup"),
                    other = folders.write(folders.there / "jug.stl", "jug"),
                    kept = folders.write(folders.here / "below" / "another_name.OBJ", "cup"),
                    jug = folders.write(folders.here / "jug.stl", "jug");
  folders.write(folders.here / "cup.obj", "another cup");
  Scene scene = sceneWith(sent, other);
  const RunInfo run = runOf(scene);
  EXPECT_EQ(run.mesh_sums, sha256OfText("cup") + " " + sha256OfText("jug"));
  Diagnostics diagnostics;
  takeFromMeshStore(scene, run, {folders.here.string()}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_EQ(fileOf(scene), kept);
  EXPECT_EQ(fileOf(scene, 1), jug);
}

// A file that the element of a plug-in names is neither sent nor opened: effects are those of the run.
TEST(MeshShelf, ForgetsTheFilesOfPlugins) {
  Diagnostics diagnostics;
  Scene scene = parseScene(R"(<scene version="1.0" name="s"><world gravity="0 0 0"/>
    <materials><material name="wood" stiffness="1000"><texture_image file="weave.png" width="0.01" amplitude="0"/>
    </material></materials><body name="a" fixed="true"><haptic><box size="1 1 1"/></haptic></body></scene>)",
                           "scene", "elsewhere", {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_EQ(filesNamedBy(scene).size(), 1U);
  const RunInfo run = runOf(scene);
  EXPECT_EQ(run.mesh_sums, "");
  takeFromMeshStore(scene, run, {}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  EXPECT_TRUE(filesNamedBy(scene).empty());
}

// The path sent over the bus exists and has the right bytes, but is not opened, because its folder is not allowed.
TEST(MeshShelf, OpensNothingOutsideItsFolders) {
  const Folders folders;
  const std::string sent = folders.write(folders.there / "cup.obj", "cup");
  for (const std::vector<std::string>& allowed : {std::vector<std::string>{folders.here.string()}, {}}) {
    Scene scene = sceneWith(sent, sent);
    const RunInfo run = runOf(scene);
    Diagnostics diagnostics;
    takeFromMeshStore(scene, run, allowed, diagnostics);
    EXPECT_EQ(diagnostics.errorCount(), 1u) << diagnostics.text();  // once per file
    EXPECT_NE(diagnostics.text().find("error[E755]"), std::string::npos);
    EXPECT_NE(diagnostics.text().find("cup.obj"), std::string::npos);
    EXPECT_EQ(fileOf(scene), "");
  }
}

// Files that are not regular or not meshes are not read: a pipe would block for ever. Invalid checksums match nothing.
TEST(MeshShelf, ReadsRegularMeshFilesOnly) {
  const Folders folders;
  ASSERT_EQ(mkfifo((folders.here / "pipe.obj").c_str(), 0600), 0);
  folders.write(folders.here / "secret.txt", "cup");
  const std::string sent = folders.write(folders.there / "cup.obj", "cup");
  fs::create_directory_symlink(folders.there, folders.here / "out");
  for (const std::string& sums : {sha256OfText("cup"), std::string(), std::string("nonsense"), std::string(64, '0')}) {
    Scene scene = sceneWith(sent);
    RunInfo run;
    run.mesh_sums = sums;
    Diagnostics diagnostics;
    takeFromMeshStore(scene, run, {folders.here.string(), "/does/not/exist"}, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors()) << sums;
    EXPECT_EQ(fileOf(scene), "");
  }
}

}  // namespace
}  // namespace presa::bus
