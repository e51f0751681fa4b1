// The capital's tenon and the mortise of the drum below it: contact alone guides one into the other, or keeps it out.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/temple/building/shipped.h"
#include "apps/temple/building/words.h"
#include "apps/temple/drop.h"
#include "apps/temple/ruins.h"
#include "apps/temple/visit.h"
#include "apps/temple/written_scene.h"
#include "framework/assembly/goal_choice.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

Proportions tenoned(const std::string& name = "column") {
  Diagnostics diagnostics;
  Proportions proportions = shippedProportions(name, diagnostics);
  addTenons(proportions, name, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return proportions;
}

class Tenon : public testing::Test {
 protected:
  /// Height of the capital over its goal half a second after it was let go there, with its tenon's tip on the height of the
  /// drum's face, this far aside [m].
  double restsAt(double aside, double turn = 0) const {
    const std::size_t drum = building.blocks.size() - 2, capital = drum + 1;
    const Pose& goal = building.blocks[capital].X_WB;
    const Pose start{goal.p + Vec3(aside, 0, building.blocks[capital].tenon + 1e-4),
                     Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))};
    const std::string folder = test::scratch("tenon");
    std::filesystem::create_directories(folder);
    for (const SceneFile& file : meshFiles(building, true)) {
      std::filesystem::create_directories((std::filesystem::path(folder) / file.path).parent_path());
      std::ofstream(std::filesystem::path(folder) / file.path) << file.text;
    }
    const DropResult end =
        drop(building, {{drum, building.blocks[drum].X_WB, true}, {capital, start, false}}, 0.5, folder);
    EXPECT_TRUE(end.sound);
    return end.X_WB[1].p.z() - goal.p.z();
  }
  const Proportions proportions = tenoned();
  const Building building = makeBuilding(proportions, 0.1, 1);
  const double module = proportions.module, height = proportions.column.tenon_height * module,
               play = proportions.column.tenon_play * module / 2, chamfer = proportions.column.tenon_chamfer * module;
};

// 0.1 mm: contacts of stones give way by less.
TEST_F(Tenon, GoesInWhereItMeetsTheHole) {
  EXPECT_LT(restsAt(0), 1e-4);
  EXPECT_LT(restsAt(0.9 * play), 1e-4);
}

// The chamfers of hole and tenon reach over each other.
TEST_F(Tenon, SlidesDownTheChamfer) { EXPECT_LT(restsAt(play + chamfer), 1e-4); }

TEST_F(Tenon, StaysOutOneMillimetreBeyondPlayAndChamfers) {
  const double rests = restsAt(play + 2 * chamfer + 1e-3);
  EXPECT_GT(rests, 0.3 * height);  // it leans: one side of the capital lies lower than the other
}

// The corner of the square reaches as far out as half the diagonal, which the hole's sides do not: at 20 degrees by
// cos 20 + sin 20 = 1.28 of its half width.
TEST_F(Tenon, StaysOutAskew) { EXPECT_GT(restsAt(0, 20 * EIGEN_PI / 180), 0.5 * height); }

// Bearing faces touch, and the tip stands clear of the floor, within single numbers in text.
TEST_F(Tenon, FitsItsMortise) {
  const Block &drum = building.blocks[building.blocks.size() - 2], &capital = building.blocks.back();
  EXPECT_EQ(drum.fold, 4);
  EXPECT_EQ(capital.fold, 4);
  double lowest = 1e9;
  for (const Vec3& vertex : capital.haptic.vertices) lowest = std::min(lowest, vertex.z());
  EXPECT_NEAR(lowest, -proportions.column.capital_height * module / 2 - height, 1e-12);
  for (const Block* block : {&drum, &capital}) {
    EXPECT_TRUE(checkMesh(block->haptic).closed()) << block->name;
    EXPECT_TRUE(checkMesh(block->visual).closed()) << block->name;
    for (const Block::Part& part : block->parts) {
      if (part.mesh.triangles.empty()) continue;
      EXPECT_TRUE(checkMesh(part.mesh).closed()) << block->name;
      EXPECT_GT(massProperties(part.mesh).volume, 0) << block->name;
    }
  }
  EXPECT_TRUE(building.blocks.front().parts.empty()) << "only the drum under the capital";
}

TEST(TenonWords, FitOneLineOfThePanelInEachLanguage) {
  for (const std::string& language : shippedLanguages()) {
    Diagnostics diagnostics;
    AssemblyWords words = shippedWords(language, diagnostics);
    const AssemblyWords before = words;
    tellOfTenons(words, language);
    ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
    for (std::size_t e = 0; e < words.elements.size(); ++e) {
      const AssemblyWords::Element &now = words.elements[e], &was = before.elements[e];
      if (now.name != "capital") {
        EXPECT_EQ(now.says, was.says);
        continue;
      }
      EXPECT_NE(now.says, was.says);
      EXPECT_LT(now.says.size(), 108U);
      ASSERT_EQ(now.stories.size(), was.stories.size() + 1);
      EXPECT_LT(now.stories.front().says.size(), 108U);
      EXPECT_FALSE(now.stories.front().source.empty());
    }
  }
}

// E188 without measures; E971 where it stands on the floor of its hole, and where it fills it.
TEST(NoTenon, WhereItsMeasuresDoNotSay) {
  Diagnostics diagnostics;
  Proportions proportions = shippedProportions("column", diagnostics);
  proportions.column.tenon_height = 0;
  addTenons(proportions, "mine.xml", diagnostics);
  EXPECT_NE(diagnostics.text().find("mine.xml: error[E188]"), std::string::npos) << diagnostics.text();
  for (const auto& [from, to] : {std::pair{"<tenon_height value=\"0.18\"", "<tenon_height value=\"0.21\""},
                                 {"<tenon_chamfer value=\"0.04\"", "<tenon_chamfer value=\"0.28\""}}) {
    std::string text = shipped::column;
    text.replace(text.find(from), std::string(from).size(), to);
    const std::string file = test::scratch("tenon_measures") + "/temple.xml";
    std::ofstream(file) << text;
    Diagnostics found;
    readProportions(file, found);
    EXPECT_NE(found.text().find("E971"), std::string::npos) << to;
  }
}

// Without --tenon nothing is changed.
TEST(NoTenon, IsInABuildingThatIsNotAskedForOne) {
  for (const Block& block : test::shippedBuilding("column").blocks) {
    EXPECT_TRUE(block.parts.empty());
    EXPECT_EQ(block.tenon, 0);
  }
}

/// The first task with a tenon, to be built by two simulated fingers.
Loaded tenonedTask(const std::string& folder) {
  const Building first = makeBuilding(tenoned("first"), 0.1, 1);
  SceneSpec spec = assembled(first);
  const Ruins ruins = strewRuins(first, 1, folder, [](std::size_t, std::size_t, const std::string&) { return true; });
  for (SceneSpec::Stone& stone : spec.stones) stone.X_WB = ruins.X_WB[stone.block];
  spec.to_be_built = true;
  spec.rig = PRESA_SOURCE_DIR "/config/rigs/assembling_pair.xml";
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 300;
  Loaded loaded = loadWorld({writeScene(first, spec, folder), "", {}}, options, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  return loaded;
}

// They let go 1 mm above the goal, well inside the hole.
TEST(TenonedTask, IsBuiltByTwoSimulatedFingers) {
  const Rebuilt rebuilt = visit(tenonedTask(test::scratch("tenon_rebuilt")), {.finish = 2, .quiet = true}).rebuilt;
  EXPECT_EQ(rebuilt.placed, 3);
  EXPECT_LT(rebuilt.worst_position_error, 1e-3);
  EXPECT_EQ(rebuilt.faults, 0U);
}

// The goal holds what is in, and does not pull what stands on its tenon, above the hole or beside it.
TEST(TenonedTask, IsSnappedOnlyOnceTheTenonIsIn) {
  const Loaded loaded = tenonedTask(test::scratch("tenon_snap"));
  const Assembly& assembly = *loaded.world->scene.assembly;
  const AssemblyGoal &drum = assembly.goals.front(), &capital = assembly.goals.back();
  const double height = 0.18 * 0.024;  // as in config/temple/first.xml
  const auto pulls = [&](const AssemblyGoal& goal, const Vec3& away) {
    return withinReach(assembly, goal, {goal.X_WB.p + away, goal.X_WB.q}, 1);
  };
  EXPECT_FALSE(pulls(capital, {0, 0, height}));
  EXPECT_FALSE(pulls(capital, {0.003, 0, height}));
  EXPECT_FALSE(pulls(capital, {0, 0, 0.6 * height}));
  EXPECT_TRUE(pulls(capital, {0, 0, 0.4 * height}));
  EXPECT_TRUE(pulls(drum, {0, 0, height})) << "without a tenon as ever, within 20 mm";
}

}  // namespace
}  // namespace presa::temple
