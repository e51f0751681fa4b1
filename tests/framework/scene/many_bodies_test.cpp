// Scenes with thousands of bodies. A linear search per reference would take minutes, and the test would time out.
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

constexpr int kMany = 5000;

std::string numbered(const std::string& what, int i) { return what + std::to_string(i); }

std::string scene(const std::string& materials, const std::string& content) {
  return "<scene version=\"1.0\" name=\"many\"><world gravity=\"0 0 -9.81\"/><materials>" + materials + "</materials>" +
         content + "</scene>";
}

std::string material(const std::string& name) { return "<material name=\"" + name + "\" stiffness=\"1000\"/>"; }

std::string boxes(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "<body name=\"" + numbered("box", i) + "\" pos=\"" + std::to_string(i) +
            " 0 0\"><physics mass=\"1\"><box size=\"0.1 0.1 0.1\"/></physics></body>";
  }
  return text;
}

TEST(ManyBodies, AreReadInOrder) {
  Diagnostics diagnostics;
  const Scene read = parseScene(scene(material("wood"), boxes(kMany)), "scene.xml", "/lab", {}, diagnostics);
  ASSERT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  ASSERT_EQ(read.bodies.size(), static_cast<std::size_t>(kMany));
  EXPECT_EQ(read.bodies.back().name, numbered("box", kMany - 1));
  EXPECT_EQ(read.bodies.back().X_WB.p.x(), kMany - 1);
  // the resolved text is stored with the run, and a replay parses it again
  EXPECT_EQ(parseScene(read.resolved_xml, "again", ".", {}, diagnostics).bodies.size(), read.bodies.size());
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
}

TEST(ManyBodies, MayEachHaveAMaterialOfTheirOwn) {
  std::string materials, bodies;
  for (int i = 0; i < kMany; ++i) {
    materials += material(numbered("m", i));
    bodies += "<body name=\"" + numbered("b", i) + "\" fixed=\"true\" material=\"" + numbered("m", kMany - 1 - i) +
              "\"><haptic><sphere radius=\"1\"/></haptic></body>";
  }
  Diagnostics diagnostics;
  const Scene read = parseScene(scene(materials, bodies), "scene.xml", "/lab", {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  for (const std::size_t i : {0U, 1234U, 4999U})
    EXPECT_EQ(read.materialOf(read.bodies[i]).name, numbered("m", 4999 - static_cast<int>(i)));
}

// Each goal comes after the one behind it in the file: one pass over the list fills only one goal.
TEST(ManyBodies, MayBePutTogetherFromTheLastToTheFirst) {
  std::string goals = "<assembly>";
  for (int i = 0; i < kMany; ++i) {
    goals += "<goal name=\"" + numbered("g", i) + "\" bodies=\"" + numbered("box", i) + "\"";
    if (i + 1 < kMany) goals += " after=\"" + numbered("g", i + 1) + "\"";
    goals += "/>";
  }
  Diagnostics diagnostics;
  const Scene read =
      parseScene(scene(material("wood"), boxes(kMany) + goals + "</assembly>"), "scene.xml", "/lab", {}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  ASSERT_EQ(read.assembly->goals.size(), static_cast<std::size_t>(kMany));
  EXPECT_EQ(read.assembly->goals[17].bodies, std::vector<std::size_t>{17});
  EXPECT_EQ(read.assembly->goals[17].after, std::vector<std::size_t>{18});
}

TEST(ManyBodies, OneTooManyIsRefusedWithBothNumbers) {
  std::string bodies;
  for (int i = 0; i <= 100'000; ++i) {
    bodies += "<body name=\"" + numbered("b", i) + "\" fixed=\"true\"><haptic><sphere radius=\"1\"/></haptic></body>\n";
  }
  const Diagnostics findings = findingsOf(scene(material("wood"), bodies));
  ASSERT_EQ(findings.errorCount(), 1U);
  EXPECT_EQ(findings.all()[0].code, 210);
  EXPECT_EQ(findings.all()[0].where.line, 100'001);
  EXPECT_NE(findings.text().find("100001 bodies, at most 100000"), std::string::npos) << findings.text();
}

}  // namespace
}  // namespace presa::scene_test
