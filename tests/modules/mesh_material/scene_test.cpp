// What is refused, and the shipped scene from the command line.
#include <gtest/gtest.h>

#include "framework/haptics/surface_effects.h"
#include "tests/modules/mesh_material/mesh_fixture.h"
#include "tests/support/lockstep_run.h"

namespace presa {
namespace {

using test::Block, test::board, test::meshWorld, test::Outcome;

/// The finding of a world whose effects are made.
std::string refused(const World& world) {
  try {
    const SurfaceEffects effects(world);
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return "";
}

constexpr const char* kSoftGel = R"(<material_part name="gel" stiffness="0.4"/>)";

TEST(MeshMaterial, OfAGoodMeshIsMade) {
  EXPECT_EQ(refused(meshWorld(board().file("board.obj"), kSoftGel)), "");
  const World stretched = meshWorld("", kSoftGel, "", "", R"(<mesh file="board.obj" scale="1 1.5 1"/>)");
  EXPECT_EQ(refused(stretched), "");
}

TEST(BadMeshMaterial, IsRefused) {
  const std::string parts = board().file("board.obj");
  Block plain = board();
  plain.part = [](double, double) { return ""; };
  plain.vertices.clear(), plain.triangles.clear();
  plain.build().file("plain.ply");
  struct Bad {
    const char* elements;
    const char* mesh;
    const char* shape;
    const char* expected;
  };
  for (const Bad& bad : {
           Bad{R"(<material_part name="jelly"/>)", "board.obj", "",
               "has no triangles of a material 'jelly'; materials of its triangles: gel, wood"},
           {R"(<material_part name="gel"/>)", "plain.ply", "",
            "has no triangles of a material 'gel'; materials of its triangles: none"},
           {R"(<material_colour stiffness="0.5"/>)", "board.obj", "", "has no colours of vertices"},
           {kSoftGel, "", R"(<box size="0.1 0.1 0.1"/>)",
            "body 'block' is felt as a primitive; a material_part needs a mesh from a file"},
           {R"(<material_colour stiffness="0.4"/>)", "", R"(<sphere radius="0.05"/>)",
            "a material_colour needs a mesh from a file"},
           {R"(<material_part name="gel" stiffness="0.5"/><material_part name="gel" friction="0.5"/>)", "board.obj", "",
            "the material has two <material_part> of the name 'gel'"},
           // half of 0.95 over 5 mm / 10, at 0.05
           {R"(<material_part name="gel" stiffness="0.05"/>)", "", R"(<mesh file="board.obj" scale="0.1 1 1"/>)",
            "the stiffness changes too steeply in the triangle at (-0.000"},
       }) {
    const std::string found = refused(meshWorld(bad.mesh, bad.elements, "", "", bad.shape));
    EXPECT_NE(found.find("error[E596]"), std::string::npos) << found;
    EXPECT_NE(found.find(bad.expected), std::string::npos) << found;
  }
}

// One material has one law of colours; parts are told apart by their names.
TEST(BadMeshMaterial, OfTwoColoursIsRefused) {
  try {
    meshWorld("", "<material_colour/><material_colour/>", "", "", R"(<box size="0.1 0.1 0.1"/>)");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(error.diagnostics().text().find("error[E112]"), std::string::npos) << error.diagnostics().text();
  }
}

// The steepest triangle has half of 1 - s over a cell of w, between a vertex of s and one of (1 + s) / 2: it leans by
// 45 degrees at 2 mm if 0.001 (1 - s) / 2 / w = s.
TEST(BadMeshMaterial, IsAsSteepAs45DegreesAtTwoMillimetres) {
  board().file("board.obj");
  for (const auto& [wide, is_good] : {std::pair(1.01, true), {0.99, false}}) {
    // w = 0.001 * 0.5 * 0.8 / 0.2 = 2 mm
    const std::string scale = std::to_string(wide * 0.002 / 0.005);
    const std::string found = refused(meshWorld("", R"(<material_part name="gel" stiffness="0.2"/>)", "", "",
                                                "<mesh file=\"board.obj\" scale=\"" + scale + " 1 1\"/>"));
    EXPECT_EQ(found.empty(), is_good) << found;
    EXPECT_EQ(found.find("would lean by 45 degrees, more than 45") != std::string::npos, !is_good) << found;
  }
}

// Names of materials are the file's.
TEST(BadMeshMaterial, ListsUpToTwentyNamesWithoutControlCharacters) {
  Block block = board();
  block.part = [](double x, double y) {
    const auto cell = std::lround(1000 * x) * 100 + std::lround(1000 * y);
    return cell < 0 ? "red\033[31m" : "part" + std::to_string(cell);
  };
  block.vertices.clear(), block.triangles.clear();
  const std::string found = refused(meshWorld(block.build().file("many.obj"), R"(<material_part name="gel"/>)"));
  EXPECT_EQ(found.find('\033'), std::string::npos);
  EXPECT_NE(found.find("red?[31m"), std::string::npos) << found;
  EXPECT_NE(found.find(" more"), std::string::npos) << found;
  EXPECT_LT(found.size(), 1000U) << found;
}

// A file that changes between the two times it is read.
TEST(BadMeshMaterial, OfAnotherFileThanTheWorldsIsRefused) {
  const World world = meshWorld(board().file("board.obj"), kSoftGel);
  Block other = board();
  other.z = [](double, double) { return 0.021; };
  other.vertices.clear(), other.triangles.clear();
  other.build().file("board.obj");
  EXPECT_NE(refused(world).find("has changed since the scene was read"), std::string::npos);
}

TEST(SceneWithMeshMaterial, ReadsAttributesOnlyWhereItIsNamed) {
  const Outcome plain = test::presa("explain " + test::source("config/scenes/pinch_and_lift.xml"));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_EQ(plain.out.find("presa_mesh_material.so"), std::string::npos) << plain.out;
  const Outcome there = test::presa("explain " + test::source("config/scenes/mesh_material.xml"));
  EXPECT_EQ(there.status, 0) << there.err;
  EXPECT_NE(there.out.find("material of the mesh's part gel: 40 % of the stiffness, 20 % of the friction; material by "
                           "the colours of the mesh's vertices, black: 40 % of the stiffness, 20 % of the friction"),
            std::string::npos)
      << there.out;
  EXPECT_NE(there.out.find("from place to place, as the surface effects say"), std::string::npos) << there.out;
}

TEST(SceneWithMeshMaterial, IsStrokedToTheEndOfTheScript) {
  const test::LockstepRun run(test::source("config/scenes/mesh_material.xml"));
  EXPECT_TRUE(run.faults().empty()) << run.faults().front();
  EXPECT_GT(run.maxNormalForce("index"), 1);
}

TEST(SceneWithMeshMaterial, TakesOverridesByTheNameOfAPart) {
  const std::string scene = test::source("config/scenes/mesh_material.xml");
  const Outcome changed = test::presa("explain " + scene + " --set material/inlay/material_part/gel/stiffness=0.25");
  EXPECT_NE(changed.out.find("part gel: 25 % of the stiffness"), std::string::npos) << changed.out << changed.err;
  const Outcome unknown = test::presa("check " + scene + " --set material/inlay/material_part/gell/stiffness=0.25");
  EXPECT_NE(unknown.err.find("error[E202]"), std::string::npos) << unknown.err;
}

TEST(BadMeshMaterial, IsRefusedWithItsPlace) {
  const Outcome bad = test::presa("run " + test::source("config/scenes/mesh_material.xml") +
                                  " --lockstep --view none --set material/shade/material_colour/friction=1.5");
  EXPECT_EQ(bad.status, 2);
  Block block = board();
  block.file("board.obj");
  const std::string scene = test::cubeWith("parts.xml", [&](std::string& xml) {
    xml.insert(xml.find("<friction "), R"(<material_part name="gel" stiffness="0.5"/>)");
  });
  const Outcome cube = test::withTestPlugins("run", scene, " --lockstep --view none");
  EXPECT_EQ(cube.status, 2);
  EXPECT_NE(cube.err.find("parts.xml:8:80: error[E596]"), std::string::npos) << cube.err;
  EXPECT_NE(cube.err.find("body 'cube' is felt as a primitive"), std::string::npos) << cube.err;
}

}  // namespace
}  // namespace presa
