#include "devices/hand/motion_schema.h"
#include "framework/scene/xml/xml.h"
#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

const std::string kRig = R"(<rig version="1.0" name="desk">
  <device role="thumb" driver="scripted" serial="A1"><set key="motion" value="../motions/a.xml"/><set key="gain" value="../2"/></device>
  <device role="index" driver="replay"><set key="file" value="/data/run.h5"/></device>
</rig>
)";

Diagnostics rigFindings(const std::string& text) {
  Diagnostics findings;
  parseRig(text, "rig.xml", "/lab/rigs", findings);
  return findings;
}

// Only settings that name a file are resolved as paths; all other settings belong to the driver.
TEST(Rig, ReadsBindingsAndResolvesFiles) {
  Diagnostics findings;
  const Rig rig = parseRig(kRig, "rig.xml", "/lab/rigs", findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_EQ(rig.name, "desk");
  ASSERT_EQ(rig.devices.size(), 2U);
  EXPECT_EQ(rig.devices[0].role, "thumb");
  EXPECT_EQ(rig.devices[0].driver, "scripted");
  EXPECT_EQ(rig.devices[0].settings.at("serial").value, "A1");
  EXPECT_EQ(rig.devices[0].settings.at("motion").value, "/lab/motions/a.xml");
  EXPECT_EQ(rig.devices[0].settings.at("gain").value, "../2");
  EXPECT_EQ(rig.devices[1].settings.at("file").value, "/data/run.h5");
  const SourceLocation& where = rig.devices[0].settings.at("gain").where;
  const Marked expected = marked(edited(kRig, "value=\"../2\"", "@value=\"../2\""));
  EXPECT_EQ(where.line, expected.line);
  EXPECT_EQ(where.column, expected.column);
}

TEST(Rig, ReadsFrames) {
  Diagnostics findings;
  const std::string text = edited(kRig, "  <device role=\"thumb\"",
                                  "  <frame name=\"head\" in=\"user\" pos=\"0 0 1.6\" quat=\"2 0 0 0\"/>\n"
                                  "  <frame name=\"user\"><key time=\"1\" pos=\"1 2 3\"/></frame>\n"
                                  "  <device in=\"head\" role=\"thumb\"");
  const Rig rig = parseRig(text, "rig.xml", "/lab/rigs", findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  ASSERT_EQ(rig.frames.size(), 2U);
  EXPECT_EQ(rig.frames[0].parent, "user");
  EXPECT_EQ(rig.frames[0].X_PF.p, Vec3(0, 0, 1.6));
  EXPECT_EQ(rig.frames[1].parent, "world");
  ASSERT_EQ(rig.frames[1].keys.size(), 1U);
  EXPECT_EQ(rig.frames[1].keys[0].X_PF.p, Vec3(1, 2, 3));
  EXPECT_EQ(rig.devices[0].frame, "head");
  EXPECT_EQ(rig.devices[1].frame, "world");
}

TEST(Rig, ResolvedTextReadsBackAsTheSameRig) {
  Diagnostics findings;
  const Rig rig = parseRig(kRig, "rig.xml", "/lab/rigs", findings);
  const Rig again = parseRig(rig.resolved_xml, "resolved", "/elsewhere", findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_EQ(again.resolved_xml, rig.resolved_xml);
  EXPECT_EQ(again.devices[0].settings.at("motion").value, "/lab/motions/a.xml");
}

TEST(Rig, ExampleIsGood) {
  Diagnostics findings;
  const Rig rig = loadRig(PRESA_SOURCE_DIR "/config/rigs/pinch_cube.xml", findings);
  EXPECT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_EQ(rig.devices.size(), 2U);
}

TEST(Rig, MistakesGiveOneMessageAtTheirPlace) {
  struct Slip {
    int code;
    const char* from;
    const char* to;
  };
  const Slip kSlips[] = {
      {412, "version=\"1.0\"", "@version=\"3.0\""},
      {413, "role=\"index\"", "@role=\"thumb\""},
      {414, "key=\"gain\"", "@key=\"motion\""},
      {414, "key=\"gain\"", "@key=\"serial\""},
      {416, "role=\"index\"", "role=\"index\" @in=\"dsk\""},
      {416, "</rig>", "<frame name=\"a\" @in=\"b\"/></rig>"},
      {417, "</rig>", "<frame name=\"a\" @in=\"a\"/></rig>"},
      {418, "</rig>", "<frame @name=\"thumb\"/></rig>"},
      {418, "</rig>", "<frame @name=\"world\"/></rig>"},
      {419, "</rig>", "<frame name=\"a\"><key time=\"1\"/><key @time=\"1\"/></frame></rig>"},
      {465, "</rig>", "<frame name=\"a\"><zoom @min=\"2\" max=\"4\"/></frame></rig>"},
      {465, "</rig>", "<frame name=\"a\"><zoom min=\"0.2\" @max=\"0.5\"/></frame></rig>"},
      {466, "</rig>", "<frame name=\"a\"><clutch button=\"1\"/><zoom min=\"1\" max=\"2\" @out=\"1\"/></frame></rig>"},
      {468, "</rig>", "<frame name=\"a\" @velocity=\"0 9 0\"/></rig>"},
      {116, "</rig>", "<frame name=\"a\"><clutch @button=\"32\"/></frame></rig>"},
      {212, "</rig>", "<frame name=\"a\" @quat=\"0 0 0 0\"/></rig>"},
      {115, "<device role=\"index\" driver=\"replay\">", "@<device role=\"index\">"},
      {114, "driver=\"replay\"", "@drivr=\"replay\""},
      {116, "serial=\"A1\"", "@serial=\"\""},
      {111, "<set key=\"gain\"", "@<sett key=\"gain\""},
      {110, "<rig version=\"1.0\" name=\"desk\">", "@<scene>"},
  };
  for (const Slip& slip : kSlips) {
    std::string text = edited(kRig, slip.from, slip.to);
    if (slip.code == 110) text = edited(text, "</rig>", "</scene>");
    const Marked rig = marked(text);
    const Diagnostics findings = rigFindings(rig.text);
    ASSERT_EQ(findings.all().size(), 1U) << slip.to << "\n" << findings.text();
    EXPECT_EQ(findings.all()[0].code, slip.code) << findings.text();
    EXPECT_EQ(findings.all()[0].where.line, rig.line) << findings.text();
    EXPECT_EQ(findings.all()[0].where.column, rig.column) << findings.text();
  }
}

TEST(Rig, NeedsADevice) {
  const Diagnostics findings = rigFindings("<rig version=\"1.0\" name=\"x\"/>");
  ASSERT_EQ(findings.all().size(), 1U);
  EXPECT_EQ(findings.all()[0].code, 113);
}

const std::string kMotion = R"(<motion version="1.0" name="pinch">
  <finger mass="0.1" stiffness="300" damping="auto"/>
  <grasp point="0 0 0.04" axis="1 0 0" width="0.07" open="0.03"/>
  <phase name="reach" duration="0.8" open="0.002"/>
  <phase name="squeeze" duration="0.5" grip="6" move="0 0 0.1"/>
</motion>
)";

Diagnostics motionFindings(const std::string& text) {
  Diagnostics findings;
  const auto document = xml::Document::parse(text, "motion.xml", findings);
  if (document) document->validate(schemas::motion, findings);
  return findings;
}

TEST(MotionSchema, AllowsNumberOrAutoAsDamping) {
  EXPECT_TRUE(motionFindings(kMotion).all().empty()) << motionFindings(kMotion).text();
  const std::string with_number = edited(kMotion, "damping=\"auto\"", "damping=\"12.5\"");
  EXPECT_TRUE(motionFindings(with_number).all().empty()) << motionFindings(with_number).text();
}

TEST(MotionSchema, MistakesGiveOneMessage) {
  struct Slip {
    int code;
    const char* from;
    const char* to;
  };
  const Slip kSlips[] = {
      {116, "damping=\"auto\"", "@damping=\"automatic\""},
      {117, "damping=\"auto\"", "@damping=\"-1\""},
      {117, "duration=\"0.8\"", "@duration=\"0\""},
      {117, "grip=\"6\"", "@grip=\"-6\""},
      {117, "width=\"0.07\"", "@width=\"0\""},
      {117, "open=\"0.002\"", "@open=\"-1\""},
      {118, "axis=\"1 0 0\"", "@axis=\"1 0\""},
      {115, "<phase name=\"reach\" duration=\"0.8\"", "@<phase name=\"reach\""},
      {111, "<grasp point", "@<grap point"},
  };
  for (const Slip& slip : kSlips) {
    const Marked motion = marked(edited(kMotion, slip.from, slip.to));
    const Diagnostics findings = motionFindings(motion.text);
    ASSERT_EQ(findings.all().size(), 1U) << slip.to << "\n" << findings.text();
    EXPECT_EQ(findings.all()[0].code, slip.code) << findings.text();
    EXPECT_EQ(findings.all()[0].where.line, motion.line) << findings.text();
    EXPECT_EQ(findings.all()[0].where.column, motion.column) << findings.text();
  }
}

TEST(MotionSchema, NeedsGraspAndPhase) {
  const Diagnostics findings = motionFindings("<motion version=\"1.0\" name=\"x\"/>");
  EXPECT_EQ(findings.all().size(), 2U) << findings.text();
}

}  // namespace
}  // namespace presa::scene_test
