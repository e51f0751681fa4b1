#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/common/terminal/waiting.h"
#include "apps/presa/check/file_checks.h"
#include "apps/presa/check/overlap.h"
#include "apps/presa/check/start_warnings.h"
#include "framework/scene/load.h"
#include "tests/apps/support/support.h"
#include "tests/support/made_model.h"

namespace presa {
namespace {

using check::Overlap;
using test::presa;
using test::scratch;
using test::source;

/// Bodies of one scene without devices.
std::shared_ptr<const World> worldOf(const std::string& bodies) {
  const std::string xml = R"(<scene version="1.0" name="s"><world gravity="0 0 -9.81"/>
    <materials><material name="m" stiffness="500"/></materials>)" +
                          bodies + "</scene>";
  Diagnostics diagnostics;
  const Loaded loaded = loadWorldFromText({.scene_xml = xml, .name = "s.xml", .rig_xml = {}}, {}, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return loaded.world;
}

std::string body(const std::string& name, const std::string& place, const std::string& shape, bool fixed = false) {
  return "<body name=\"" + name + "\" " + place + (fixed ? " fixed=\"true\"" : "") + "><physics" +
         (fixed ? "" : " mass=\"0.1\"") + ">" + shape + "</physics></body>";
}

std::vector<Overlap> overlapsOf(const std::string& bodies) { return check::overlapsOf(*worldOf(bodies), 5e-4); }

const std::string kBox = R"(<box size="0.1 0.1 0.1"/>)";

// Boxes: the shortest way out lies along a face or an edge of one of them, so the depth is known to rounding.
TEST(Overlap, OfBoxesIsTheShortestWayOut) {
  const auto sunk = overlapsOf(body("table", "pos=\"0 0 -0.05\"", R"(<box size="1 1 0.1"/>)", true) +
                               body("cube", "pos=\"0.2 0 0.0377\"", kBox));
  ASSERT_EQ(sunk.size(), 1u);
  EXPECT_NEAR(sunk[0].depth, 0.05 - 0.0377, 1e-9);
  EXPECT_NEAR((sunk[0].nhat_W - Vec3::UnitZ()).norm(), 0, 1e-9);
  const auto corner =
      overlapsOf(body("a", "pos=\"0 0 0\"", kBox) + body("b", "pos=\"0.1 0 0\" euler_deg=\"0 0 45\"", kBox));
  ASSERT_EQ(corner.size(), 1u);
  EXPECT_NEAR(corner[0].depth, 0.05 + 0.05 * std::sqrt(2) - 0.1, 1e-9);
}

// Round shapes: the way along the line between the centres. The last step of the search is 1e-4 rad, which changes the
// depth by (0.2 m)(1e-4)^2 / 2 = 1e-9 m.
TEST(Overlap, OfSpheresIsAlongTheirCentres) {
  const Vec3 p(0.03, 0.05, 0.04);
  const auto found = overlapsOf(body("a", "pos=\"0 0 0\"", R"(<sphere radius="0.05"/>)") +
                                body("b", "pos=\"0.03 0.05 0.04\"", R"(<sphere radius="0.04"/>)"));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.09 - p.norm(), 1e-8);
  EXPECT_NEAR(found[0].nhat_W.dot(p.normalized()), 1, 1e-6);
}

// Bodies that touch, that lie beside each other, or that are fixed do not count.
TEST(Overlap, LeavesOutWhatOnlyTouches) {
  EXPECT_TRUE(overlapsOf(body("a", "pos=\"0 0 0\"", kBox) + body("b", "pos=\"0 0 0.1\"", kBox)).empty());
  EXPECT_TRUE(overlapsOf(body("a", "pos=\"0 0 0\"", kBox) + body("b", "pos=\"0 0 0.0997\"", kBox)).empty());
  EXPECT_TRUE(overlapsOf(body("a", "pos=\"0 0 0\"", kBox, true) + body("b", "pos=\"0 0 0.05\"", kBox, true)).empty());
  // boxes that turn about different axes pass by an edge at 1 mm: no face parts them
  EXPECT_TRUE(overlapsOf(body("a", "pos=\"0 0 0\" euler_deg=\"45 0 0\"", R"(<box size="1 0.1 0.1"/>)") +
                         body("b", "pos=\"0 0 0.14242\" euler_deg=\"0 45 0\"", R"(<box size="0.1 1 0.1"/>)"))
                  .empty());
}

/// The shipped cube with a change, checked with the shipped rig.
test::Outcome checked(const std::string& name, const std::string& from, const std::string& to) {
  const std::string file = test::cubeWith(name, [&](std::string& xml) {
    const std::size_t at = xml.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    xml.replace(at, from.size(), to);
  });
  return presa("check " + file + " --rig " + source("config/rigs/pinch_cube.xml") + " --allow-folder " +
               source("config"));
}

// A scene that loads well and is meant otherwise is told with a figure and a cure; the shipped one is silent.
TEST(Check, WarnsOfWhatIsMeantOtherwise) {
  EXPECT_EQ(presa("check " + source("config/scenes/cube.xml")).err, "");
  const auto sunk = checked("sunk.xml", "pos=\"0 0 0.035\"", "pos=\"0 0 0.030\"");
  EXPECT_EQ(sunk.status, 0);
  EXPECT_NE(sunk.err.find("warning[W241]: 'table' and 'cube' overlap by 5.00 mm at the start"), std::string::npos)
      << sunk.err;
  EXPECT_NE(sunk.err.find("help: move 'cube' by 0.0000 0.0000 0.0050 m"), std::string::npos) << sunk.err;
  const auto far = checked("far.xml", "pos=\"0 0 0.035\"", "pos=\"0 0 35\"");
  EXPECT_EQ(far.err.find("W243"), std::string::npos) << far.err;  // the table is still near
}

// Fingers whose motion is written in another unit start far from everything: 1000 times the grasp's height of 0.04 m.
TEST(Check, WarnsOfFingersThatStartFarAway) {
  const std::string motion = scratch("motion.xml"), rig = scratch("far_rig.xml");
  std::ofstream(motion) << R"(<motion version="1.0" name="m"><grasp point="0 0 40" axis="1 0 0" width="0.07"/>
    <phase name="a" duration="1"/></motion>)";
  std::ofstream(rig)
      << R"(<rig version="1.0" name="r"><device role="thumb" driver="scripted"><set key="motion" value=")" << motion
      << R"("/></device><device role="index" driver="scripted"><set key="motion" value=")" << motion
      << R"("/></device></rig>)";
  const auto outcome = presa("check " + source("config/scenes/cube.xml") + " --rig " + rig);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning[W243]: the finger 'thumb' starts 39.9"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lengths are in metres"), std::string::npos) << outcome.err;
}

// A mesh in millimetres is a thousand times too large: the cup, 0.1 m with its handle, would be a tower.
TEST(Check, WarnsOfMillimetresTakenForMetres) {
  const std::string scene = scratch("tower.xml");
  std::ofstream(scene) << R"(<scene version="1.0" name="t"><world gravity="0 0 -9.81"/>
    <materials><material name="m" stiffness="500"/></materials><body name="cup" fixed="true">
    <haptic><mesh file=")"
                       << source("config/meshes/cup.obj") << R"(" scale="1000 1000 1000"/></haptic></body></scene>)";
  const auto outcome = presa("check " + scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning[W242]: the mesh "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("help: scale=\"1 1 1\" makes it 0.1 m wide"), std::string::npos) << outcome.err;
}

TEST(Check, PrintsAnOldSceneInTheFormatOfToday) {
  const std::string scene = scratch("old.xml");
  std::ofstream(scene) << "<scene version=\"1.0\" name=\"t\"><!-- kept --><world gravity=\"0 0 -1\"/>"
                          "<collision max_triangles=\"9\" margin=\"0.001\"/></scene>";
  const auto outcome = presa("check --print-upgraded " + scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("version=\"1.1\""), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("<!-- kept -->"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("<collision margin=\"0.001\"/>"), std::string::npos) << outcome.out;
  EXPECT_EQ(presa("check --print-upgraded " + source("config/rigs/pinch_cube.xml")).status, 2);
}

// A hall that stands still may be that large.
TEST(Check, WarnsOfABodyAsLargeAsAHouse) {
  const std::string scene = scratch("house.xml");
  std::ofstream(scene) << R"(<scene version="1.0" name="t"><world gravity="0 0 -9.81"/>
    <materials><material name="m" stiffness="500"/></materials>
    <body name="hall" fixed="true"><haptic><box size="50 100 80"/></haptic></body>
    <body name="block"><physics mass="1"><box size="50 100 80"/></physics></body></scene>)";
  const auto outcome = presa("check " + scene);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning[W242]: 'block' is 100 m wide"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("0.1 m for 100 mm"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("'hall' is"), std::string::npos) << outcome.err;
}

// The time of a step is measured; here it is given, as tests have no clock.
TEST(Check, WarnsOfMeshesThatDoNotKeepThePeriod) {
  const auto world = worldOf("<body name=\"cup\"><physics mass=\"0.1\"><mesh file=\"" +
                             source("config/meshes/cup.obj") + "\"/></physics></body>");
  Diagnostics kept, missed;
  check::warnOfSlowMeshes(*world, 0.0049, kept);
  EXPECT_TRUE(kept.all().empty());
  check::warnOfSlowMeshes(*world, 0.0412, missed);
  ASSERT_EQ(missed.all().size(), 1u);
  EXPECT_NE(missed.text().find("triangles as its physics, and a step of the dynamics takes 41.2 ms here, more than its "
                               "period of 5 ms"),
            std::string::npos)
      << missed.text();
}

// The kind of a file is that of its root element; rigs, motions and experiments are checked alone, with their own lines.
// All at once, each at the line that names the model.
TEST(Check, FindsTexturesThatAreMissingTooLargeOrOutside) {
  std::string bodies;
  for (const std::string name : {"gone", "wide", "out"}) {
    test::written(scratch(name + ".mtl"),
                  std::string("newmtl paint\nmap_Kd ") + (name == "out" ? "../" : "") + name + ".png\n");
    test::written(scratch(name + ".obj"), test::objOf(test::frontSquare(0.1F), name + ".mtl"));
    bodies +=
        "<body name=\"" + name + "\" fixed=\"true\">\n<visual><mesh file=\"" + name + ".obj\"/></visual></body>\n";
  }
  test::written(scratch("wide.png"), test::pngHead(100'000, 100'000));
  const std::string scene = scratch("textured.xml");
  std::ofstream(scene) << "<scene version=\"1.0\" name=\"s\"><world gravity=\"0 0 0\"/>"
                          "<materials><material name=\"m\" stiffness=\"500\"/></materials>\n"
                       << bodies << "</scene>";
  const test::Outcome found = presa("check " + scene);
  EXPECT_EQ(found.status, 2);
  for (const char* text :
       {"textured.xml:3:1: error[E260]", "textured.xml:5:1: error[E262]", "textured.xml:7:1: error[E692]"})
    EXPECT_NE(found.err.find(text), std::string::npos) << found.err;
}

// What is printed is a scene of its own.
TEST(Check, PrintsASceneAsItIsRead) {
  test::written(scratch("part.xml"),
                "<scene version=\"1.0\" name=\"p\"><world gravity=\"0 0 0\"/><body name=\"box\" "
                "fixed=\"true\"><visual><sphere radius=\"0.1\"/></visual></body></scene>");
  const std::string scene = scratch("whole.xml");
  test::written(scene,
                "<scene version=\"1.0\" name=\"w\"><world gravity=\"0 0 0\"/><materials><material name=\"m\" "
                "stiffness=\"500\"/></materials><include file=\"part.xml\" prefix=\"a_\" pos=\"0 0 1\"/></scene>");
  const test::Outcome printed = presa("check --print-resolved " + scene);
  ASSERT_EQ(printed.status, 0) << printed.err;
  EXPECT_NE(printed.out.find("<body name=\"a_box\""), std::string::npos) << printed.out;
  EXPECT_EQ(printed.out.find("<include"), std::string::npos);
  const std::string again = scratch("again.xml");
  test::written(again, printed.out);
  EXPECT_EQ(presa("check --print-resolved " + again).out, printed.out);
}

TEST(Check, TakesRigsMotionsAndExperiments) {
  using check::FileKind;
  EXPECT_EQ(check::kindOf(source("config/rigs/pinch_cube.xml")), FileKind::kRig);
  EXPECT_EQ(check::kindOf(source("config/motions/rub.csv")), FileKind::kMotion);
  EXPECT_EQ(check::kindOf(source("experiments/stiffness_2afc/experiment.xml")), FileKind::kExperiment);
  EXPECT_EQ(check::kindOf(source("config/cave/cave.xml")), FileKind::kWalls);
  EXPECT_EQ(check::kindOf(source("README.md")), FileKind::kScene);
  const std::string motion = scratch("bad_motion.xml"), keys = scratch("bad_keys.csv"), rig = scratch("bad_rig.xml"),
                    experiment = scratch("bad_experiment.xml");
  std::ofstream(motion) << "<motion version=\"1.0\" name=\"m\">\n"
                        << "<grasp point=\"0 0 0\" axis=\"1 0 0\" width=\"0.1\"/>\n"
                        << "<phase name=\"up\" duration=\"1\" intent=\"hoist\"/></motion>";
  std::ofstream(keys) << "time_s,role,x_m,y_m,z_m\n0,thumb,0,0,0\n0,index,0,0,0\n0,index,0,0,zero\n";
  std::ofstream(rig) << "<rig version=\"1.0\" name=\"r\">\n"
                     << "<device role=\"a\" driver=\"scripted\"><set key=\"motoin\" value=\"x\"/></device></rig>";
  std::ofstream(experiment) << "<experiment version=\"1.0\" name=\"e\">\n<nonsense/></experiment>";
  const auto found = [](const std::string& file, const std::string& line) {
    const auto outcome = presa("check " + file);
    EXPECT_EQ(outcome.status, 2) << file;
    EXPECT_NE(outcome.err.find(file + line), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find(" error"), std::string::npos) << outcome.out;
  };
  found(motion, ":3:");
  found(keys, ":4:");
  found(rig, ":2:");
  found(experiment, ":2:");
  const auto json = nlohmann::json::parse(presa("check " + experiment + " " + motion + " --format json").out);
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0].at("kind"), "experiment");
  EXPECT_EQ(json[1].at("kind"), "motion");
  EXPECT_EQ(json[1].at("findings")[0].at("line"), 3);
}

// The line that tells of a long load fits the terminal, and its file stays readable.
TEST(Check, SaysWhatIsBeingLoaded) {
  EXPECT_EQ(terminal::waitingText("loading a.xml", 4, 80), "loading a.xml, 4 s");
  EXPECT_EQ(terminal::waitingText("loading some/long/folder/a.xml", 12, 20), "/folder/a.xml, 12 s");
}

}  // namespace
}  // namespace presa
