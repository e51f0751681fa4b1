// Scenes that include others: what comes in, where it stands, how it is called, and what is refused.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "framework/input/folders.h"
#include "framework/scene/scene_copy.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Include : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("presa_include_" + std::to_string(getpid())) / "in";
    fs::create_directories(folder_ / "parts");
    write("parts/pair.xml", R"(<scene version="1.0" name="pair"><world gravity="0 0 -1"/>
  <rates dynamics="500"/>
  <materials><material name="wood" stiffness="700"/><material name="steel" stiffness="900"/></materials>
  <body name="base" fixed="true" pos="0 0 1" material="steel"><visual><mesh file="base.obj"/></visual></body>
  <body name="arm" pos="1 0 0" euler_deg="0 0 90" velocity="1 0 0"><physics mass="1" force="0 2 0">
    <sphere radius="0.1"/></physics></body>
  <joint name="pin" type="hinge" body="arm" to="base"><axis dir="0 0 1"/></joint>
  <devices><device role="thumb"/></devices></scene>)");
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  std::string write(const std::string& name, const std::string& text) {
    const std::string file = (folder_ / name).string();
    std::ofstream(file) << text;
    return file;
  }
  Scene load(const std::string& content, const std::vector<Override>& overrides = {}) {
    found_ = {};
    const std::string file = write(
        "main.xml", "<scene version=\"1.0\" name=\"main\"><world gravity=\"0 0 -9.81\"/>\n" + content + "</scene>");
    return loadScene(file, overrides, found_);
  }
  void expectError(int code, int line, const std::string& text) {
    ASSERT_TRUE(found_.hasErrors());
    EXPECT_EQ(found_.all().front().code, code) << found_.text();
    EXPECT_EQ(found_.all().front().where.line, line);
    EXPECT_THAT(found_.all().front().message, HasSubstr(text));
  }

  fs::path folder_;
  Diagnostics found_;
};

// Twice the same file: bodies, joints and materials under names of their own, moved as rigid wholes; rates and devices of
// the included file are not those of this scene.
TEST_F(Include, BringsBodiesJointsAndMaterialsMovedAndRenamed) {
  const Scene scene = load(R"(<include file="parts/pair.xml" prefix="left_"/>
<include file="parts/pair.xml" prefix="right_" pos="0 0 5" euler_deg="0 0 90"/>)");
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  ASSERT_EQ(scene.bodies.size(), 4u);
  ASSERT_EQ(scene.materials.size(), 4u);
  ASSERT_EQ(scene.joints.size(), 2u);
  EXPECT_EQ(scene.gravity.z(), -9.81);
  EXPECT_EQ(scene.rates.dynamics, 200);
  EXPECT_TRUE(scene.devices.empty());
  const Body &base = scene.bodies[2], &arm = scene.bodies[3];
  EXPECT_EQ(base.name, "right_base");
  EXPECT_EQ(scene.materials[base.material].name, "right_steel");
  EXPECT_EQ(scene.materials[arm.material].name, "right_wood");  // the first of its own file
  EXPECT_EQ(std::get<MeshRef>(base.visual->shape).file, (folder_ / "parts/base.obj").string());
  EXPECT_LT((base.X_WB.p - Vec3(0, 0, 6)).norm(), 1e-12);
  EXPECT_LT((arm.X_WB.p - Vec3(0, 1, 5)).norm(), 1e-12);
  EXPECT_LT(arm.X_WB.q.angularDistance(Quat(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitZ()))), 1e-12);
  EXPECT_LT((arm.v_WCm - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_LT((arm.force_W - Vec3(-2, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(scene.joints[1].name, "right_pin");
  EXPECT_EQ(scene.joints[1].body, 3);
  EXPECT_EQ(scene.joints[1].to, 2);
}

TEST_F(Include, IsWrittenOutAndReadBackTheSame) {
  const Scene scene = load(R"(<include file="parts/pair.xml" pos="0 0 5" euler_deg="10 20 30"/>)");
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_EQ(scene.resolved_xml.find("<include"), std::string::npos);
  const Scene again = parseScene(scene.resolved_xml, "again", ".", {}, found_);
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  ASSERT_EQ(again.bodies.size(), 2u);
  EXPECT_EQ(again.bodies[1].X_WB.p, scene.bodies[1].X_WB.p);
  EXPECT_EQ(again.bodies[1].X_WB.q.coeffs(), scene.bodies[1].X_WB.q.coeffs());
}

TEST_F(Include, NestsAndTakesOverrides) {
  write("parts/both.xml", R"(<scene version="1.0" name="both"><world gravity="0 0 0"/>
    <include file="pair.xml" prefix="a_" pos="1 0 0"/></scene>)");
  const Scene scene =
      load(R"(<include file="parts/both.xml" prefix="b_" pos="0 2 0"/>)", {{"body/b_a_arm/physics/mass", "7"}});
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_LT((scene.bodies[1].X_WB.p - Vec3(2, 2, 0)).norm(), 1e-12);
  EXPECT_EQ(scene.bodies[1].mass, 7);
}

TEST_F(Include, ErrorsAreTellingWhereTheyAre) {
  load("<include file=\"parts/gone.xml\"/>");
  expectError(273, 2, "there is no file");
  write("parts/rig.xml", "<rig version=\"1.0\" name=\"r\"/>");
  load("<include file=\"parts/rig.xml\"/>");
  expectError(273, 2, "is no scene");
  for (const char* version : {"version=\"2.0\"", "version=\"new\"", ""}) {
    write("parts/later.xml", "<scene " + std::string(version) + " name=\"l\"><world gravity=\"0 0 0\"/></scene>");
    load("<include file=\"parts/later.xml\"/>");
    expectError(273, 2, "is not written in format 1.x");
  }
  load("\n<include file=\"../secret.xml\"/>");
  expectError(692, 3, "outside the folder");
  load("<include prefix=\"a\"/>");
  expectError(115, 2, "file");
  load("<include file=\"parts/pair.xml\" pos=\"1 2\"/>");
  expectError(118, 2, "pos");
  load("<include file=\"parts/pair.xml\" euler_deg=\"0 0 1\" quat=\"1 0 0 0\"/>");
  expectError(211, 2, "");
  load("<include file=\"parts/pair.xml\"/><include file=\"parts/pair.xml\"/>");
  expectError(203, 3, "");  // the same names twice: at their place in the included file
  EXPECT_THAT(found_.all().front().where.file, HasSubstr("parts/pair.xml"));
  write("parts/typo.xml", "<scene version=\"1.0\" name=\"t\">\n<world gravity=\"0 0 0\"/>\n<bdy name=\"b\"/></scene>");
  load("<include file=\"parts/typo.xml\"/>");
  expectError(111, 3, "bdy");
  EXPECT_THAT(found_.all().front().where.file, HasSubstr("typo.xml"));
}

TEST_F(Include, OfEachOtherEndsAndSoDoesAFlood) {
  load("<include file=\"main.xml\"/>");
  expectError(274, 2, "includes itself");
  write("parts/w0.xml", R"(<scene version="1.0" name="w"><world gravity="0 0 0"/><body name="b"/></scene>)");
  for (int i = 1; i <= 7; ++i) {
    std::string text = R"(<scene version="1.0" name="w"><world gravity="0 0 0"/>)";
    for (int k = 0; k < 10; ++k)
      text += "<include file=\"w" + std::to_string(i - 1) + ".xml\" prefix=\"p" + std::to_string(k) + "\"/>";
    write("parts/w" + std::to_string(i) + ".xml", text + "</scene>");
  }
  load("<include file=\"parts/w7.xml\"/>");
  ASSERT_TRUE(found_.hasErrors());
  EXPECT_EQ(found_.all().front().code, 274) << found_.text();
  EXPECT_THAT(found_.all().front().message, HasSubstr("more than"));
  for (int i = 1; i <= 12; ++i)
    write("parts/d" + std::to_string(i) + ".xml",
          R"(<scene version="1.0" name="w"><world gravity="0 0 0"/><include file="d)" + std::to_string(i + 1) +
              ".xml\"/></scene>");
  load("<include file=\"parts/d1.xml\"/>");
  ASSERT_TRUE(found_.hasErrors());
  EXPECT_EQ(found_.all().front().code, 274);
  EXPECT_THAT(found_.all().front().message, HasSubstr("deep"));
}

// A copy in another folder includes the same file; what stands in that file cannot be written into the copy.
TEST_F(Include, CopiesOfASceneIncludeTheSameFiles) {
  load(R"(<include file="parts/pair.xml" prefix="a_"/><body name="own" fixed="true" material="a_wood"/>)");
  fs::create_directories(folder_ / "far/off");
  const std::string from = (folder_ / "main.xml").string(), to = (folder_ / "far/off/copy.xml").string();
  const std::string text = sceneCopy(from, {{"body/own/pos", "1 2 3"}}, to, found_);
  EXPECT_THAT(text, HasSubstr("file=\"../../parts/pair.xml\""));
  readCopy(text, to, found_);  // from there, that folder is outside
  EXPECT_THAT(found_.text(), HasSubstr("error[E692]"));
  input::allowFolder(folder_.string());
  found_ = {};
  EXPECT_EQ(readCopy(text, to, found_).bodies.size(), 3u) << found_.text();
  EXPECT_TRUE(sceneCopy(from, {{"body/a_arm/physics/mass", "2"}}, to, found_).empty());
  EXPECT_THAT(found_.text(), HasSubstr("error[E202]"));
}

// A scene that arrives over the bus or from a program must not make this one read files.
TEST_F(Include, OnlyFilesMayInclude) {
  parseScene(R"(<scene version="1.0" name="s"><world gravity="0 0 0"/><include file="parts/pair.xml"/></scene>)",
             "sent", folder_.string(), {}, found_);
  expectError(273, 1, "only a scene in a file");
}

}  // namespace
}  // namespace presa::scene_test
