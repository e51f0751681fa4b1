#include <filesystem>
#include <fstream>

#include "framework/scene/xml/xml.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

/// One mistake in the scene: `to` replaces `from` and marks with '@' the expected place of the message.
struct Slip {
  const char* name;
  int code;
  const char* from;
  const char* to;
  const char* says;  ///< words expected in the message or its help
};

class OneSlip : public testing::TestWithParam<Slip> {};

// Every kind of mistake gives exactly one message, at its place, with a helpful hint, and no follow-up errors.
TEST_P(OneSlip, GivesOneMessageAtItsPlace) {
  const Slip& slip = GetParam();
  const Marked scene = marked(edited(kScene, slip.from, slip.to));
  const Diagnostics findings = findingsOf(scene.text);
  ASSERT_EQ(findings.all().size(), 1U) << findings.text();
  const Diagnostic& finding = findings.all()[0];
  EXPECT_EQ(finding.code, slip.code) << findings.text();
  EXPECT_EQ(finding.where.file, "scene.xml");
  EXPECT_EQ(finding.where.line, scene.line) << findings.text();
  EXPECT_EQ(finding.where.column, scene.column) << findings.text();
  EXPECT_NE((finding.message + "\n" + finding.help).find(slip.says), std::string::npos) << findings.text();
}

const Slip kWellFormedness[] = {
    {"WrongEndTag", 104, "</haptic>\n    <physics><box", "@</haptik>\n    <physics><box",
     "</haptik> does not close <haptic>"},
    {"ForgottenEndTag", 104, "  </devices>\n</scene>", "  @</scene>", "opened in line"},
    {"NoQuotes", 104, "fingertip_radius=\"0.008\"", "@fingertip_radius=0.008", "'fingertip_radius' is not in quotes"},
    {"NoValue", 104, "fixed=\"true\"", "@fixed", "'fixed' has no value"},
    {"RepeatedAttribute", 104, "mass=\"0.2\"", "mass=\"0.2\" @mass=\"0.3\"", "'mass' twice"},
    {"OpenQuote", 104, "radius=\"0.035\"/>", "@radius=\"0.035/>", "'radius' is not closed with a quote"},
    {"Doctype", 105, "<!-- Größe", "@<!DOCTYPE scene [<!ENTITY a \"b\">]><!-- Größe", "DOCTYPE"},
    {"Ampersand", 104, "description=\"two bodies, two fingers\"", "description=\"this &that;@ too\"", "&amp;"},
};
const Slip kNames[] = {
    {"Element", 111, "<cylinder", "@<cyllinder", "did you mean 'cylinder'"},
    {"Container", 111, "<rates haptic", "@<rate haptic", "did you mean 'rates'"},
    {"ElementElsewhere", 111, "<haptic><sphere", "@<friction static=\"1\"/><haptic><sphere", "belongs in <material>"},
    {"AttributeAsElement", 111, "<physics mass=\"0.2\">", "<physics>@<mass>0.2</mass>", "it is an attribute"},
    {"UnknownElement", 111, "<haptic><sphere radius=\"0.035\"/>", "<haptic>@<torus radius=\"0.035\"/>",
     "mesh, box, sphere"},
    {"Attribute", 114, "stiffness=\"1000\"", "@stifness=\"1000\"", "did you mean 'stiffness'"},
    {"PlaceOfAHapticShape", 114, "<sphere radius=\"0.035\"", "<sphere @pos=\"0 0 1\" radius=\"0.035\"",
     "allowed: radius"},
    {"DecomposedVisual", 114, "file=\"meshes/cube.obj\"", "file=\"meshes/cube.obj\" @decompose=\"true\"",
     "allowed: file, scale"},
    {"AttributeCase", 114, "fixed=\"true\"", "@Fixed=\"true\"", "did you mean 'fixed'"},
    {"AttributeElsewhere", 114, "<body name=\"cube\"", "<body @density=\"200\" name=\"cube\"", "belongs on <physics>"},
    {"ElementAsAttribute", 114, "name=\"rubber\" stiff", "name=\"rubber\" @friction=\"1\" stiff",
     "an element of its own"},
    {"Namespace", 120, "> <scene version", "> @<scene xmlns=\"http://example.org\" version", "no XML namespace"},
    {"StrayText", 119, "<materials>\n", "<materials>\n  @rubber\n", "only elements may stand"},
};
const Slip kCounts[] = {
    {"SecondWorld", 112, "  <rates", "  @<world gravity=\"0 0 0\"/><rates", "only one <world>"},
    {"SecondRates", 112, "  <materials>", "  @<rates/><materials>", "only one <rates>"},
    {"SecondMaterials", 112, "  <devices>", "  @<materials/><devices>", "only one <materials>"},
    {"SecondDevices", 112, "</scene>", "@<devices/></scene>", "only one <devices>"},
    {"SecondShape", 112, "<sphere radius=\"0.035\"/>", "<sphere radius=\"0.035\"/>@<box size=\"1 1 1\"/>",
     "only one of"},
    {"NoPhysicsShape", 113, "<physics mass=\"0.2\"><cylinder radius=\"0.03\" length=\"0.07\"/></physics>",
     "@<physics mass=\"0.2\"/>", "needs one of <mesh>, <box>"},
    {"NoShape", 113, "<haptic><sphere radius=\"0.035\"/></haptic>", "@<haptic/>", "needs one of <mesh>, <box>"},
    {"NoWorld", 113,
     "> <scene version=\"1.0\" name=\"test\"\n       description=\"two bodies, two fingers\">\n  <world gravity=\"0 0 "
     "-9.81\"/>",
     "> @<scene version=\"1.0\" name=\"test\">\n", "needs <world>"},
    {"NoStiffness", 115, "<material name=\"wood\" stiffness=\"2000\"/>", "@<material name=\"wood\"/>", "[N/m]"},
    {"NoVersion", 115, "> <scene version=\"1.0\"", "> @<scene", "no 'version'"},
};
const Slip kValues[] = {
    {"Word", 116, "mass=\"0.2\"", "@mass=\"heavy\"", "a number > 0, found 'heavy'"},
    {"Unit", 116, "mass=\"0.2\"", "@mass=\"200g\"", "without a unit"},
    {"DecimalComma", 116, "static=\"0.8\"", "@static=\"0,8\"", "0.8"},
    {"FrictionPreset", 116, "static=\"0.8\"", "@preset=\"sand_paper\"", "did you mean 'sandpaper'"},
    {"CollisionIndex", 116, "<body name=\"table\"", "<collision @index=\"hcolide\"/><body name=\"table\"",
     "did you mean 'hcollide'"},
    {"Pieces", 116, "<cylinder radius=\"0.03\" length=\"0.07\"/>",
     "<mesh file=\"a.obj\" decompose=\"true\" @max_pieces=\"257\"/>", "a whole number from 1 to 256"},
    {"Empty", 116, "mass=\"0.2\"", "@mass=\"\"", "found ''"},
    {"Boolean", 116, "fixed=\"true\"", "@fixed=\"yes\"", "'true' or 'false', found 'yes'"},
    {"Name", 116, "<body name=\"table\"", "<body @name=\"my table\"", "a name"},
    {"Version", 116, "> <scene version=\"1.0\"", "> <scene @version=\"one\"", "such as 1.0"},
    {"EmptyFile", 116, "file=\"meshes/cube.obj\"", "@file=\"\"", "not empty"},
    {"MassZero", 117, "mass=\"0.2\"", "@mass=\"0\"", "> 0, found '0'"},
    {"MassNegative", 117, "mass=\"0.2\"", "@mass=\"-0.2\"", "> 0"},
    {"MassNaN", 117, "mass=\"0.2\"", "@mass=\"NaN\"", "finite"},
    {"MassInfinite", 117, "mass=\"0.2\"", "@mass=\"INF\"", "finite"},
    {"MassTooLarge", 117, "mass=\"0.2\"", "@mass=\"1e999\"", "finite"},
    {"DensityNegative", 117, "mass=\"0.2\"", "@density=\"-1\"", "[kg/m^3]"},
    {"Stiffness", 117, "stiffness=\"1000\"", "@stiffness=\"0\"", "[N/m]"},
    {"Damping", 117, "damping=\"1\"", "@damping=\"-1\"", ">= 0"},
    {"Color", 117, "color=\"0.75 0.25 0.2\"", "@color=\"0.75 0.25 20\"", "in [0, 1], found '20'"},
    {"FrictionNegative", 117, "dynamic=\"0.6\"", "@dynamic=\"-0.6\"", ">= 0"},
    {"Radius", 117, "radius=\"0.035\"", "@radius=\"-0.035\"", "[m]"},
    {"Size", 117, "<physics><box size=\"0.6 0.4 0.04\"", "<physics><box @size=\"0.6 0 0.04\"",
     "3 numbers > 0, found '0'"},
    {"Fingertip", 117, "fingertip_radius=\"0.008\"", "@fingertip_radius=\"-0.001\"", "[m]"},
    {"Watchdog", 117, "watchdog_ms=\"20\"", "@watchdog_ms=\"-20\"", "[ms]"},
    {"CollisionRateTooLow", 117, "collision=\"100\"", "@collision=\"8\"", "[10, 40000]"},
    {"HapticRate", 117, "haptic=\"1000\"", "@haptic=\"50\"", "[100, 40000]"},
    {"GravityNaN", 117, "gravity=\"0 0 -9.81\"", "@gravity=\"0 nan 0\"", "finite"},
    {"VectorShort", 118, "gravity=\"0 0 -9.81\"", "@gravity=\"0 -9.81\"", "3 numbers, found 2"},
    {"VectorLong", 118, "pos=\"0 0 0.035\"", "@pos=\"0 0 0.035 1\"", "3 numbers, found 4"},
    {"QuatShort", 118, "euler_deg=\"0 0 90\"", "@quat=\"1 0 0\"", "4 numbers, found 3"},
};
const Slip kMeaning[] = {
    {"Major", 201, "> <scene version=\"1.0\"", "> <scene @version=\"2.0\"", "reads 1.x"},
    {"DuplicateBody", 203, "<body name=\"cube\"", "<body @name=\"table\"", "the first is in line 10"},
    {"DuplicateMaterial", 203, "<material name=\"wood\" stiffness=\"2000\"/>",
     "<material name=\"wood\" stiffness=\"2000\"/><material @name=\"wood\" stiffness=\"1\"/>", "second material"},
    {"DuplicateRole", 203, "role=\"index\"", "@role=\"thumb\"", "second device role"},
    {"Material", 204, "material=\"rubber\"", "@material=\"ruber\"", "did you mean 'rubber'"},
    {"NoMaterialOfBody", 205, "<body name=\"cube\" material=\"rubber\"", "@<body name=\"cube\"", "rubber, wood"},
    {"NoPhysics", 206, "<body name=\"cube\" material=\"rubber\" pos=\"0 0 0.035\" euler_deg=\"0 0 90\">",
     "@<body name=\"new\" material=\"wood\"/><body name=\"cube\" material=\"rubber\">", "no <physics>"},
    {"NeitherMassNorDensity", 207, "<physics mass=\"0.2\">", "@<physics>", "found neither"},
    {"BothMassAndDensity", 207, "<physics mass=\"0.2\">", "<physics mass=\"0.2\" @density=\"500\">", "found both"},
    {"ChangedFriction", 208, "dynamic=\"0.6\"/>",
     "dynamic=\"0.6\"><changed static=\"0.4\" @dynamic=\"0.5\"/></friction>", "0.5 > 0.4"},
    {"FrictionOfAPreset", 208, "static=\"0.8\" dynamic=\"0.6\"", "preset=\"rayon\" @dynamic=\"0.6\"", "0.6 > 0.42"},
    {"PresetAndStatic", 236, "static=\"0.8\"", "static=\"0.8\" @preset=\"suede\"", "write one of them"},
    {"Friction", 208, "dynamic=\"0.6\"", "@dynamic=\"0.9\"", "0.9 > 0.8"},
    {"DynamicsRate", 209, "dynamics=\"200\"", "@dynamics=\"300\"", "250, 500"},
    {"CollisionRate", 209, "collision=\"100\"", "@collision=\"2000\"", "1000"},
    {"RatesByDefault", 209, "haptic=\"1000\" collision=\"100\" dynamics=\"200\"", "@haptic=\"900\" collision=\"100\"",
     "900 / 200"},
    {"WatchdogUnderTwoPeriods", 222, "watchdog_ms=\"20\"", "@watchdog_ms=\"9.9\"",
     "at least two periods of the dynamics, found 9.9 ms at 200 Hz\nwrite watchdog_ms=\"10\" or more"},
    {"DynamicsThatHoldsNothing", 223, "dynamics=\"200\"", "@dynamics=\"10\"", "20 Hz or more"},
    {"HapticRateOfTheEnginesSolver", 228, "  <materials>",
     "  <dynamics coupling=\"haptic_rate\" @solver=\"direct\"/><materials>", "auto, newton, small_steps"},
    {"TwoOrientations", 211, "euler_deg=\"0 0 90\"", "euler_deg=\"0 0 90\" @quat=\"1 0 0 0\"", "both"},
    {"ZeroQuatOfAShape", 212, "<cylinder radius", "<cylinder @quat=\"0 0 0 0\" radius", "zero"},
    {"TwoOrientationsOfAShape", 211, "<cylinder radius", "<cylinder euler_deg=\"0 0 90\" @quat=\"1 0 0 0\" radius",
     "both"},
    {"ZeroQuat", 212, "euler_deg=\"0 0 90\"", "@quat=\"0 0 0 0\"", "zero"},
    {"MassOfFixed", 220, "<physics><box", "<physics @mass=\"3\"><box", "no effect"},
    {"NoGeometry", 221, "  <devices>", "  @<body name=\"ghost\" fixed=\"true\" material=\"wood\"/><devices>",
     "no geometry"},
    {"NewerMinor", 201, "> <scene version=\"1.0\"", "> <scene @version=\"1.7\"", "newer"},
};
// Accepted, with a warning that has the value and the sane range (CONTRIBUTING.md).
const Slip kSanity[] = {
    {"SaneGravity", 227, "gravity=\"0 0 -9.81\"", "@gravity=\"0 0 -1e6\"",
     "found |0 0 -1e6| = 1e+06 m/s^2, sane: 0 to 100"},
    {"SaneMass", 227, "mass=\"0.2\"", "@mass=\"1e9\"", "<physics> in body 'cube': found 1e+09 kg, sane: 1e-05 to 1000"},
    {"SaneMassSmall", 227, "mass=\"0.2\"", "@mass=\"1e-9\"", "found 1e-09 kg"},
    {"SaneDensity", 227, "mass=\"0.2\"", "@density=\"1e6\"", "sane: 0.1 to 25000 kg/m^3"},
    {"SaneForce", 227, "mass=\"0.2\"", "mass=\"0.2\" @force=\"0 0 1e5\"", "sane: 0 to 10000 N"},
    {"SaneStiffness", 227, "stiffness=\"1000\"", "@stiffness=\"1e10\"", "found 1e+10 N/m, sane: 1 to 1e+06"},
    {"SaneDamping", 227, "damping=\"1\"", "@damping=\"1e5\"", "sane: 0 to 1000 N s/m"},
    {"SaneFriction", 227, "static=\"0.8\"", "@static=\"80\"", "found 80, sane: 0 to 10"},
    {"SaneTorsion", 227, "static=\"0.8\"", "static=\"0.8\" @torsion=\"4\"", "sane: 0 to 0.1 m"},
    {"SaneBox", 227, "<physics><box size=\"0.6 0.4 0.04\"", "<physics><box @size=\"600 400 1e-6\"",
     "found 1e-06 m, sane: 1e-05 to 1000"},
    {"SaneSphere", 227, "radius=\"0.035\"", "@radius=\"35000\"", "sane: 1e-05 to 1000 m"},
    {"SaneCylinder", 227, "length=\"0.07\"", "@length=\"7e4\"", "sane: 1e-05 to 1000 m"},
    {"SaneScale", 227, "scale=\"0.001 0.001 0.001\"", "@scale=\"0.001 0.001 1e7\"", "found 1e+07, sane: 1e-06 to 1000"},
    {"SanePlace", 227, "pos=\"0 0 0.035\"", "@pos=\"0 0 35000\"", "sane: 0 to 10000 m"},
    {"SaneVelocity", 227, "euler_deg=\"0 0 90\"", "euler_deg=\"0 0 90\" @velocity=\"0 0 1e4\"", "sane: 0 to 100 m/s"},
    {"SaneTurning", 227, "euler_deg=\"0 0 90\"", "euler_deg=\"0 0 90\" @angular_velocity=\"0 0 1e4\"",
     "0 to 1000 rad/s"},
    {"SaneFingertip", 227, "fingertip_radius=\"0.008\"", "@fingertip_radius=\"8\"", "sane: 0 to 0.1 m"},
};

std::string nameOf(const testing::TestParamInfo<Slip>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(WellFormedness, OneSlip, testing::ValuesIn(kWellFormedness), nameOf);
INSTANTIATE_TEST_SUITE_P(Names, OneSlip, testing::ValuesIn(kNames), nameOf);
INSTANTIATE_TEST_SUITE_P(Counts, OneSlip, testing::ValuesIn(kCounts), nameOf);
INSTANTIATE_TEST_SUITE_P(Values, OneSlip, testing::ValuesIn(kValues), nameOf);
INSTANTIATE_TEST_SUITE_P(Meaning, OneSlip, testing::ValuesIn(kMeaning), nameOf);
INSTANTIATE_TEST_SUITE_P(Sanity, OneSlip, testing::ValuesIn(kSanity), nameOf);

std::vector<int> codesOf(const Diagnostics& findings) {
  std::vector<int> codes;
  for (const Diagnostic& finding : findings.all()) codes.push_back(finding.code);
  std::sort(codes.begin(), codes.end());
  return codes;
}

// The ends of a range are within it, and a value that the schema refuses is not judged again.
TEST(SaneRanges, HoldTheirEnds) {
  for (const char* set : {"world/gravity=0 0 -100", "body/cube/physics/mass=1000", "body/cube/physics/mass=1e-5",
                          "material/rubber/stiffness=1e6", "material/rubber/stiffness=1", "material/wood/damping=1000",
                          "device/thumb/fingertip_radius=0"}) {
    const std::string text = set;
    const std::size_t equals = text.find('=');
    const Diagnostics findings = findingsOf(kScene, {{text.substr(0, equals), text.substr(equals + 1)}});
    EXPECT_TRUE(findings.all().empty()) << findings.text();
  }
}

TEST(SaneRanges, WarnAndKeepTheValue) {
  Diagnostics findings;
  const Scene scene = parseScene(kScene, "scene.xml", "/lab", {{"body/cube/physics/mass", "1e9"}}, findings);
  ASSERT_EQ(codesOf(findings), std::vector<int>{227}) << findings.text();
  EXPECT_FALSE(findings.hasErrors());
  EXPECT_EQ(scene.bodies.at(1).mass, 1e9);
}

// A misspelt list must neither hide the mistakes within it nor make references to its content look wrong.
TEST(SceneErrors, AreAllToldAtOnce) {
  std::string scene = edited(kScene, "<materials>", "<materals>");
  scene = edited(scene, "</materials>", "</materals>");
  scene = edited(scene, "stiffness=\"1000\"", "stifness=\"-5\"");
  scene = edited(scene, "dynamic=\"0.6\"", "dynamic=\"0.9\"");
  scene = edited(scene, "material=\"rubber\"", "material=\"ruber\"");
  scene = edited(scene, "mass=\"0.2\"", "mas=\"0\"");
  scene = edited(scene, "role=\"index\"", "role=\"thumb\"");
  scene = edited(scene, "collision=\"100\"", "colision=\"70\"");
  const Diagnostics findings = findingsOf(scene);
  EXPECT_EQ(codesOf(findings), (std::vector<int>{111, 114, 114, 114, 117, 117, 203, 204, 208, 209})) << findings.text();
}

// The parser notices an unclosed tag at the end of the file; the message must point to the tag.
TEST(SceneErrors, TruncatedFileNamesTheOpenElement) {
  const Marked scene = marked(kScene.substr(0, kScene.find("<haptic><sphere")) + "@<haptic>");
  const Diagnostics findings = findingsOf(scene.text);
  ASSERT_EQ(codesOf(findings), std::vector<int>{104}) << findings.text();
  EXPECT_EQ(findings.all()[0].message, "<haptic> is not closed before the end of the file");
  EXPECT_EQ(findings.all()[0].where.line, scene.line);
  EXPECT_EQ(findings.all()[0].where.column, scene.column);
}

TEST(SceneErrors, WrongRootElementIsTheOnlyMessage) {
  const Diagnostics findings = findingsOf("<secne version=\"1.0\"><nonsense/></secne>");
  ASSERT_EQ(codesOf(findings), std::vector<int>{110}) << findings.text();
  EXPECT_EQ(findings.all()[0].message, "the root element is <secne>, expected <scene> (did you mean 'scene'?)");
}

TEST(SceneErrors, EmptySceneNeedsABody) {
  const Diagnostics findings = findingsOf("<scene version=\"1.0\" name=\"x\"><world gravity=\"0 0 0\"/></scene>");
  EXPECT_EQ(codesOf(findings), std::vector<int>{213}) << findings.text();
}

TEST(SceneErrors, BodiesNeedAMaterialInTheScene) {
  const Diagnostics findings = findingsOf(
      "<scene version=\"1.0\" name=\"x\"><world gravity=\"0 0 0\"/><body name=\"a\" fixed=\"true\">"
      "<haptic><sphere radius=\"1\"/></haptic></body></scene>");
  EXPECT_EQ(codesOf(findings), std::vector<int>{205}) << findings.text();
}

// The scene sizes all memory, so a typing error must not ask for any amount of it.
TEST(SceneErrors, CapacityIsAHardLimit) {
  std::string devices;
  for (int i = 2; i < kMaxFingers; ++i) devices += "<device role=\"d" + std::to_string(i) + "\"/>\n";
  std::string scene = edited(kScene, "  <devices>\n", "<devices>\n" + devices);
  EXPECT_TRUE(findingsOf(scene).all().empty()) << findingsOf(scene).text();
  scene = edited(scene, "<devices>\n", "<devices>\n<device role=\"last\"/>");
  EXPECT_EQ(codesOf(findingsOf(scene)), std::vector<int>{210});
}

// Ten levels of ten entities would expand to 10^10 characters; the file is refused before anything expands.
TEST(SceneErrors, EntityBombIsRefused) {
  std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE scene [<!ENTITY a0 \"ha\">";
  for (int i = 1; i <= 10; ++i) {
    bomb += "<!ENTITY a" + std::to_string(i) + " \"";
    for (int k = 0; k < 10; ++k) bomb += "&a" + std::to_string(i - 1) + ";";
    bomb += "\">";
  }
  bomb += "]><scene version=\"1.0\" name=\"&a10;\"/>";
  const Diagnostics findings = findingsOf(bomb);
  ASSERT_EQ(codesOf(findings), std::vector<int>{105}) << findings.text();
  EXPECT_EQ(findings.all()[0].where.line, 2);
  EXPECT_EQ(findings.all()[0].where.column, 1);
}

// A binary file is reported at the first non-text byte; an empty file has a place too.
TEST(SceneErrors, WhatIsNoTextHasAPlace) {
  const Diagnostics zero = findingsOf(std::string("<scene>\n <a\0/>", 14));
  ASSERT_EQ(codesOf(zero), std::vector<int>{103}) << zero.text();
  EXPECT_EQ(zero.all()[0].where.line, 2);
  EXPECT_EQ(zero.all()[0].where.column, 4);
  for (const char* text : {"", "\xFF\xFE<"}) EXPECT_EQ(findingsOf(text).all().at(0).where.line, 1);
}

TEST(SceneErrors, DepthIsLimited) {
  std::string deep = "<scene>";
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(codesOf(findingsOf(deep)), std::vector<int>{107});
}

TEST(SceneErrors, SizeIsLimited) {
  EXPECT_EQ(codesOf(findingsOf("<scene>" + std::string(xml::Document::kMaxBytes, ' ') + "</scene>")),
            std::vector<int>{106});
}

TEST(SceneErrors, WhatIsNoTextIsSaidToBeNone) {
  EXPECT_EQ(codesOf(findingsOf("")), std::vector<int>{102});
  EXPECT_EQ(codesOf(findingsOf(" \n\t ")), std::vector<int>{102});
  EXPECT_EQ(codesOf(findingsOf(std::string("<scene\0>", 8))), std::vector<int>{103});
  EXPECT_EQ(codesOf(findingsOf("\xFF\xFE<")), std::vector<int>{103});
  EXPECT_EQ(codesOf(findingsOf("<scene name=\"\xE4\"/>")), std::vector<int>{103});
  EXPECT_EQ(codesOf(findingsOf("hello")), std::vector<int>{104});
}

TEST(SceneErrors, MissingFileAndDirectoryAreTold) {
  Diagnostics findings;
  const Scene scene = loadScene("no/such/file.xml", {}, findings);
  EXPECT_EQ(scene.file, "no/such/file.xml");
  loadScene(PRESA_SOURCE_DIR "/config", {}, findings);
  EXPECT_EQ(codesOf(findings), (std::vector<int>{101, 101})) << findings.text();
  EXPECT_NE(findings.text().find("directory"), std::string::npos);
}

// Editors find the XSD by this hint; it is not an error, and Presa does not open the file.
TEST(SceneErrors, SchemaHintForEditorsIsAllowed) {
  const std::string hint =
      "> <scene xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" xsi:noNamespaceSchemaLocation=\"no/such.xsd\" ";
  const Diagnostics findings = findingsOf(edited(kScene, "> <scene ", hint));
  EXPECT_TRUE(findings.all().empty()) << findings.text();
}

}  // namespace
}  // namespace presa::scene_test
