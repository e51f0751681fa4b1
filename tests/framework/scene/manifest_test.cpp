#include "framework/scene/manifest.h"

#include <gtest/gtest.h>

#include <fstream>

#include "apps/common/scratch_folder.h"

namespace presa {
namespace {

class Manifests : public testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const { std::ofstream(folder_.path() / file) << text; }
  static std::string effect(const std::string& name, const std::string& element, const std::string& more = {}) {
    return "<plugin name=\"" + name + "\" version=\"1.0\" kind=\"force_effect\" about=\"a test\"><element name=\"" +
           element + "\" in=\"body\"><attribute name=\"max_force\" type=\"number\" above=\"0\" about=\"a bound\"/>" +
           more + "</element></plugin>";
  }
  std::string errors() const {
    Diagnostics diagnostics;
    readManifests({folder_.path().string()}, diagnostics);
    std::string all;
    for (const Diagnostic& one : diagnostics.all()) all += std::to_string(one.code) + " " + one.message + "\n";
    return all;
  }

  ScratchFolder folder_;
};

TEST_F(Manifests, BringTheirElementsIntoTheSchema) {
  write("presa_wind.xml",
        effect("wind", "wind",
               "<attribute name=\"speed\" type=\"number\" default=\"2\" max=\"9\" unit=\"m/s\" about=\"how fast\"/>"));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_FALSE(diagnostics.hasErrors());
  const std::string xsd = sceneSchemaWith(all);
  EXPECT_NE(xsd.find("<xs:element name=\"wind\" p:implied=\"false\" minOccurs=\"0\">"), std::string::npos);
  EXPECT_NE(xsd.find("how fast [m/s]"), std::string::npos);
}

// An element of a scene may name a file, but not an empty name; one of an experiment may not.
TEST_F(Manifests, SayWhichAttributesAreFiles) {
  write("presa_wind.xml", effect("wind", "wind", "<attribute name=\"map\" type=\"file\" about=\"how strong\"/>"));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors());
  EXPECT_EQ(all.at(0).elements.at(0).attributes.at(1).type, "file");
  EXPECT_NE(sceneSchemaWith(all).find("<xs:attribute name=\"map\" type=\"path\" use=\"required\">"), std::string::npos);
  write(
      "presa_wind.xml",
      "<plugin name=\"wind\" version=\"1.0\" kind=\"method\" about=\"a test\"><element name=\"wind\" in=\"procedure\">"
      "<attribute name=\"map\" type=\"file\" about=\"how strong\"/></element></plugin>");
  EXPECT_EQ(errors(), "595 <wind map> of the method 'wind' is a file\n");
}

TEST_F(Manifests, OfTheFirstFolderCount) {
  write("presa_wind.xml", effect("wind", "wind"));
  const ScratchFolder other;
  std::ofstream(other.path() / "presa_wind.xml") << effect("wind", "gale");
  Diagnostics diagnostics;
  const auto all = readManifests({other.path().string(), folder_.path().string()}, diagnostics);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].elements[0].name, "gale");
}

TEST_F(Manifests, NeedTheNameOfTheirFile) {
  write("presa_wind.xml", effect("gale", "wind"));
  EXPECT_EQ(errors().substr(0, 4), "593 ");
}

TEST_F(Manifests, MayNotBringAnElementTwice) {
  write("presa_gale.xml", effect("gale", "wind"));
  write("presa_wind.xml", effect("wind", "wind"));
  EXPECT_NE(errors().find("594 plug-in 'wind' brings <wind>, which plug-in 'gale'"), std::string::npos) << errors();
}

TEST_F(Manifests, MayNotBringAnElementOfPresa) {
  write("presa_wind.xml", effect("wind", "friction"));
  EXPECT_NE(errors().find("594 plug-in 'wind' brings <friction>, which Presa itself"), std::string::npos) << errors();
}

TEST_F(Manifests, OfForceEffectsBoundTheForce) {
  write(
      "presa_wind.xml",
      "<plugin name=\"wind\" version=\"1.0\" kind=\"force_effect\" about=\"a test\"><element name=\"wind\" in=\"body\">"
      "<attribute name=\"max_force\" type=\"number\" default=\"3\" about=\"a bound\"/></element></plugin>");
  EXPECT_EQ(errors().substr(0, 4), "595 ");
  write(
      "presa_wind.xml",
      "<plugin name=\"wind\" version=\"1.0\" kind=\"force_effect\" about=\"a test\"><element name=\"wind\" in=\"body\">"
      "<attribute name=\"max_torque\" type=\"number\" about=\"a bound\"/></element></plugin>");
  EXPECT_EQ(errors(), "");
}

TEST_F(Manifests, OfFrictionLawsBelongToFriction) {
  const auto law = [](const std::string& place) {
    return "<plugin name=\"wind\" version=\"1.0\" kind=\"friction_law\" about=\"a test\"><element name=\"wind\" in=\"" +
           place + "\"/></plugin>";
  };
  write("presa_wind.xml", law("friction"));
  EXPECT_EQ(errors(), "");
  write("presa_wind.xml", law("body"));
  EXPECT_EQ(errors(), "595 <wind> of the friction law 'wind' cannot stand in=\"body\"\n");
}

std::string renderer(const std::string& elements) {
  return "<plugin name=\"rays\" version=\"1.0\" kind=\"renderer\" gives=\"proxy\" about=\"a test\">" + elements +
         "</plugin>";
}

TEST_F(Manifests, OfRenderersAddAValueToHaptics) {
  write("presa_rays.xml", renderer("<element name=\"rays\" in=\"haptics\"><attribute name=\"count\" type=\"number\" "
                                   "default=\"3\" about=\"how many\"/></element>"));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  EXPECT_FALSE(diagnostics.hasErrors());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(all[0].hasProxy());
  const std::string xsd = sceneSchemaWith(all);
  EXPECT_NE(xsd.find("<xs:enumeration value=\"rays\"/>"), std::string::npos);
  EXPECT_NE(xsd.find("<xs:element name=\"rays\" p:implied=\"false\" minOccurs=\"0\">"), std::string::npos);
}

// A study of accuracy refines numbers that say so.
TEST_F(Manifests, SayWhichNumbersAreMoreAccurate) {
  const auto rays = [](const std::string& attribute) {
    return renderer(
        "<element name=\"rays\" in=\"haptics\"><attribute name=\"count\" default=\"3\" about=\"how many\" " +
        attribute + "/></element>");
  };
  write("presa_rays.xml", rays("type=\"number\" finer=\"up\" tried=\"1 10 100\""));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
  const Manifest::Attribute& count = all.at(0).elements.at(0).attributes.at(0);
  EXPECT_EQ(count.finer, "up");
  EXPECT_EQ(count.tried, (std::vector<std::string>{"1", "10", "100"}));
  write("presa_rays.xml", rays("type=\"boolean\" finer=\"up\""));
  EXPECT_EQ(errors(), "595 <rays count> of the renderer 'rays' has finer=\"…\", but is no number\n");
  write("presa_rays.xml", rays("type=\"number\" tried=\"1 2\""));
  EXPECT_EQ(errors(), "595 <rays count> of the renderer 'rays' has tried=\"…\" without finer=\"…\"\n");
}

TEST_F(Manifests, OfRenderersHaveOneElementWithDefaults) {
  write("presa_rays.xml", renderer("<element name=\"rays\" in=\"haptics\"><attribute name=\"count\" type=\"number\" "
                                   "about=\"how many\"/></element>"));
  EXPECT_EQ(errors(), "595 <rays count> of the renderer 'rays' has no default\n");
  write("presa_rays.xml", renderer("<element name=\"rays\" in=\"haptics\"/><element name=\"beams\" in=\"haptics\"/>"));
  EXPECT_EQ(errors(), "595 the renderer 'rays' has a second element for its settings\n");
  write("presa_rays.xml", renderer("<element name=\"rays\" in=\"body\"/>"));
  EXPECT_EQ(errors(), "595 <rays> of the renderer 'rays' cannot stand in=\"body\"\n");
}

TEST_F(Manifests, OfSurfaceEffectsBelongToABodyAMaterialOrTheScene) {
  const auto effect = [](const std::string& place) {
    return "<plugin name=\"wind\" version=\"1.0\" kind=\"surface_effect\" about=\"a test\"><element name=\"wind\" "
           "in=\"" +
           place + "\"/></plugin>";
  };
  for (const char* place : {"body", "material", "scene"}) {
    write("presa_wind.xml", effect(place));
    EXPECT_EQ(errors(), "");
  }
  write("presa_wind.xml", effect("haptics"));
  EXPECT_EQ(errors(), "595 <wind> of the surface effect 'wind' cannot stand in=\"haptics\"\n");
}

// Their names tell them apart, and a path leads to each by its name.
TEST_F(Manifests, OfMaterialsMayStandSeveralTimesIfTheyHaveAName) {
  const auto schema = [&](const std::string& attribute) {
    write("presa_wind.xml",
          "<plugin name=\"wind\" version=\"1.0\" kind=\"surface_effect\" about=\"a test\"><element name=\"wind\" "
          "in=\"material\"><attribute type=\"text\" about=\"a test\" " +
              attribute + "/></element></plugin>");
    Diagnostics diagnostics;
    return sceneSchemaWith(readManifests({folder_.path().string()}, diagnostics));
  };
  const std::string once = "<xs:element name=\"wind\" p:implied=\"false\" minOccurs=\"0\" p:occurs=\"0..1\">";
  EXPECT_EQ(schema("name=\"name\"").find(once), std::string::npos);
  EXPECT_NE(schema("name=\"name\" default=\"\"").find(once), std::string::npos);
  EXPECT_NE(schema("name=\"from\"").find(once), std::string::npos);
}

TEST_F(Manifests, OnlyOfRenderersGiveAProxy) {
  write("presa_wind.xml",
        "<plugin name=\"wind\" version=\"1.0\" kind=\"friction_law\" gives=\"proxy\" about=\"a test\"/>");
  EXPECT_EQ(errors(), "595 the friction law 'wind' says gives=\"proxy\"\n");
}

TEST_F(Manifests, AreCheckedLikeAnyFile) {
  write("presa_wind.xml", "<plugin name=\"wind\" version=\"1.0\" kind=\"forse_effect\" about=\"a test\"/>");
  EXPECT_NE(errors().find("forse_effect"), std::string::npos) << errors();
}

std::string module(const std::string& attributes, const std::string& children) {
  return "<plugin name=\"tide\" version=\"1.0\" kind=\"module\" about=\"a test\" " + attributes + ">" + children +
         "</plugin>";
}

TEST_F(Manifests, OfModulesSayWhenARunNeedsThem) {
  write("presa_tide.xml", module("rate=\"dynamics\" engine=\"waves\" fingers=\"false\"",
                                 "<wanted when=\"fingers free_body\"/><wanted when=\"assembly\"/>"));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  ASSERT_FALSE(diagnostics.hasErrors()) << diagnostics.all()[0].message;
  const Manifest::ModuleRole& role = all.at(0).module;
  EXPECT_EQ(role.rate, RateGroup::kDynamics);
  EXPECT_FALSE(role.fingers);
  EXPECT_TRUE(role.snap);
  EXPECT_EQ(role.wanted, (std::vector<std::vector<std::string>>{{"fingers", "free_body"}, {"assembly"}}));
  // scenes may choose it
  EXPECT_NE(sceneSchemaWith(all).find("<xs:enumeration value=\"waves\"/>"), std::string::npos);
}

TEST_F(Manifests, OfModulesThatAreNeverNeededAreRefused) {
  write("presa_tide.xml", module("rate=\"view\"", ""));
  EXPECT_EQ(errors(), "595 the module 'tide' is never needed\n");
  write("presa_tide.xml", module("", "<element name=\"tide\" in=\"scene\"/>"));
  EXPECT_EQ(errors(), "595 the module 'tide' has no rate\n");
  write("presa_tide.xml", module("rate=\"view\"", "<wanted when=\"free_bodies\"/>"));
  EXPECT_EQ(errors(), "595 no fact 'free_bodies' (did you mean 'free_body'?)\n");
}

// Otherwise a misplaced line would be ignored.
TEST_F(Manifests, OfOtherKindsSayNothingOfModulesAndDevices) {
  const auto wind = [](const std::string& attributes, const std::string& children) {
    return "<plugin name=\"wind\" version=\"1.0\" kind=\"friction_law\" about=\"a test\" " + attributes + ">" +
           children + "</plugin>";
  };
  write("presa_wind.xml",
        wind("rate=\"view\"", "<wanted when=\"view\"/><setting name=\"a\" type=\"text\" about=\"b\"/>"));
  EXPECT_EQ(errors(),
            "595 the friction law 'wind' says rate=\"…\"\n"
            "595 the friction law 'wind' has <wanted>\n"
            "595 the friction law 'wind' has <setting>\n");
  write("presa_wind.xml", wind("gives=\"view\"", ""));
  EXPECT_EQ(errors(), "595 the friction law 'wind' says gives=\"view\"\n");
  write("presa_wind.xml", wind("gives=\"figure\"", ""));
  EXPECT_EQ(errors(), "595 the friction law 'wind' says gives=\"figure\"\n");
}

TEST_F(Manifests, OfDevicesListTheirSettings) {
  const auto device = [](const std::string& children) {
    return "<plugin name=\"pen\" version=\"1.0\" kind=\"device\" about=\"a test\">" + children + "</plugin>";
  };
  write("presa_pen.xml", device("<setting name=\"path\" type=\"file\" about=\"what it draws\"/>"));
  Diagnostics diagnostics;
  const auto all = readManifests({folder_.path().string()}, diagnostics);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].settings.size(), 1U);
  EXPECT_EQ(all[0].settings[0].type, "file");
  write("presa_pen.xml", device("<element name=\"pen\" in=\"scene\"/>"));
  EXPECT_EQ(errors(), "595 <pen> of the device 'pen' cannot stand in=\"scene\"\n");
}

}  // namespace
}  // namespace presa
