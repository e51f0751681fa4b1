// <defaults>: who takes what, and how mistakes in them are told.
#include <gmock/gmock.h>

#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

using testing::HasSubstr;

class Defaults : public testing::Test {
 protected:
  /// A scene with these defaults and bodies.
  Scene load(const std::string& content, const std::vector<Override>& overrides = {}) {
    found_ = {};
    return parseScene(
        "<scene version=\"1.0\" name=\"s\"><world gravity=\"0 0 -9.81\"/>\n"
        "<materials><material name=\"clay\" stiffness=\"500\"/><material name=\"wood\" "
        "stiffness=\"700\"/></materials>\n" +
            content + "</scene>",
        "s.xml", "", overrides, found_);
  }
  /// The only finding.
  void expectOne(int code, int line, const std::string& text) {
    ASSERT_EQ(found_.all().size(), 1u) << found_.text();
    const Diagnostic& only = found_.all().front();
    EXPECT_EQ(only.code, code) << found_.text();
    EXPECT_EQ(only.where.line, line) << found_.text();
    EXPECT_THAT(only.message, HasSubstr(text));
  }
  Diagnostics found_;
};

const std::string kBrick =
    R"(<defaults><body class="brick" material="wood"><haptic shading="smooth"><box size="1 2 3"/></haptic>
<physics density="1800"><box size="1 2 3"/></physics></body></defaults>)";

TEST_F(Defaults, ABodyTakesWhatItLacks) {
  const Scene scene =
      load(kBrick + R"(<body name="a" class="brick" pos="0 0 1"/>)"
                    R"(<body name="b" class="brick" material="clay"><haptic><sphere radius="0.5"/></haptic>)"
                    R"(<physics mass="0.2"><sphere radius="0.5"/></physics></body>)"
                    R"(<body name="c" material="clay"><physics mass="1"><sphere radius="0.5"/></physics></body>)");
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  const Body &a = scene.bodies[0], &b = scene.bodies[1], &c = scene.bodies[2];
  EXPECT_EQ(scene.materials[a.material].name, "wood");
  EXPECT_EQ(a.X_WB.p.z(), 1);
  EXPECT_EQ(std::get<Box>(a.haptic->shape).size, Vec3(1, 2, 3));
  EXPECT_EQ(a.density, 1800);
  // its own shapes and mass stay; the shading is taken
  EXPECT_EQ(scene.materials[b.material].name, "clay");
  EXPECT_EQ(std::get<Sphere>(b.haptic->shape).radius, 0.5);
  EXPECT_EQ(b.mass, 0.2);
  EXPECT_FALSE(b.density);
  EXPECT_FALSE(c.haptic);
}

TEST_F(Defaults, WithoutAClassTheyAreForAll) {
  const Scene scene = load(R"(<defaults><body class="heavy"><physics density="5000"/></body>
<body material="wood"><physics density="100"><box size="1 1 1"/></physics></body>
<joint type="hinge"><axis dir="0 1 0" friction="0.5"/></joint><device fingertip_radius="0.005"/></defaults>
<body name="a"/><body name="b" class="heavy"/><joint name="j" body="a" to="b"/>
<devices><device role="thumb"/><device role="index" fingertip_radius="0.01"/></devices>)");
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_EQ(scene.bodies[0].density, 100);
  EXPECT_EQ(scene.bodies[1].density, 5000);
  EXPECT_TRUE(scene.bodies[1].physics);
  EXPECT_EQ(scene.joints[0].axes[0].friction, 0.5);
  EXPECT_EQ(scene.devices[0].fingertip_radius, 0.005);
  EXPECT_EQ(scene.devices[1].fingertip_radius, 0.01);
}

TEST_F(Defaults, AnEmptyElementTakesWhatIsInIt) {
  const Scene scene = load(kBrick + R"(<body name="a" class="brick"><physics mass="0.2"/></body>)");
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_EQ(scene.bodies[0].mass, 0.2);
  EXPECT_FALSE(scene.bodies[0].density);
  EXPECT_EQ(std::get<Box>(scene.bodies[0].physics->shape).size, Vec3(1, 2, 3));
}

TEST_F(Defaults, OverridesComeAfterThem) {
  const Scene scene = load(kBrick + R"(<body name="a" class="brick"/>)", {{"body/a/physics/mass", "3"}});
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_EQ(scene.bodies[0].mass, 3);
  EXPECT_THAT(scene.resolved_xml, testing::Not(HasSubstr("class=")));
  EXPECT_THAT(scene.resolved_xml, testing::Not(HasSubstr("<defaults")));
}

TEST_F(Defaults, AMassOfItsOwnGoesWithoutTheInertiaOfAnother) {
  const std::string heavy =
      R"(<defaults><body class="h" material="wood"><physics mass="2" inertia="1 1 1 0 0 0" center="0 0 1">
<box size="1 1 1"/></physics></body></defaults>)";
  const Scene scene = load(
      heavy +
          R"(<body name="a" class="h"/><body name="b" class="h"><physics density="9"><box size="1 1 1"/></physics></body>)",
      {{"body/a/physics/mass", "3"}});
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_FALSE(scene.bodies[1].inertia_B);
  EXPECT_FALSE(scene.bodies[1].p_BCm);
  // another mass scales the inertia that was given with the first
  ASSERT_TRUE(scene.bodies[0].inertia_B);
  EXPECT_NEAR((*scene.bodies[0].inertia_B)(0, 0), 1.5, 1e-15);
  const Scene dense = load(heavy + R"(<body name="a" class="h"/>)", {{"body/a/physics/density", "3"}});
  ASSERT_FALSE(found_.hasErrors()) << found_.text();
  EXPECT_FALSE(dense.bodies[0].inertia_B);
}

TEST_F(Defaults, ABombIsRefused) {
  std::string boxes, bodies;
  for (int i = 0; i < 1000; ++i) {
    boxes += "<box size=\"1 1 1\"/>";
    bodies += "<body name=\"b" + std::to_string(i) + "\" class=\"b\"/>";
  }
  load("<defaults><body class=\"b\" material=\"wood\"><physics mass=\"1\">" + boxes + "</physics></body></defaults>" +
       bodies);
  EXPECT_THAT(found_.text(), HasSubstr("error[E278]: <defaults> brings more than 200000 elements"));
}

TEST_F(Defaults, AMistakeIsToldOnceAtItsPlace) {
  const std::string users = R"(
<body name="a" class="x"/><body name="b" class="x"/>)";
  const auto with = [&](const std::string& inside) {
    load("<defaults><body class=\"x\"><physics density=\"9\"><box size=\"1 1 1\"/></physics></body>" + inside +
         "</defaults>" + users);
  };
  load(
      R"(<defaults><body class="x" material="wood"><physics densty="9" mass="1"><box size="1 1 1"/></physics></body></defaults>)" +
      users);
  expectOne(278, 3, "<physics> has no attribute 'densty' (did you mean 'density'?)");
  load(
      R"(<defaults><body class="x" material="wood"><physics mass="-1" density="2"><box size="1 1 1"/></physics></body></defaults>)" +
      users);
  expectOne(278, 3, "'mass' of <physics> must be a number > 0, found '-1'");
  load(
      R"(<defaults><body class="x" material="wood"><fysics/><physics mass="1"><box size="1 1 1"/></physics></body></defaults>)" +
      users);
  expectOne(278, 3, "<body> has no <fysics> (did you mean 'physics'?)");
  load(kBrick + R"(<body name="a" class="brik"/><body name="c" class="brick"/>)");
  EXPECT_THAT(found_.text(),
              HasSubstr("error[E277]: <body> 'a' has class 'brik', which does not exist (did you mean 'brick'?)"));
  EXPECT_THAT(found_.text(), HasSubstr("classes: brick"));
  load(
      R"(<defaults><world gravity="0 0 0"/></defaults><body name="a" fixed="true" material="wood"><haptic><box size="1 1 1"/></haptic></body>)");
  expectOne(278, 3, "<defaults> knows no <world>");
  load(kBrick + R"(<body name="a" fixed="true" material="wood"><haptic><box size="1 1 1"/></haptic></body>)");
  expectOne(279, 3, "no <body> has class 'brick'");
  with("<body name=\"a\" class=\"y\"/>");
  EXPECT_THAT(found_.text(), HasSubstr("'name' belongs to one <body> alone"));
  with("<body class=\"x\"/>");
  EXPECT_THAT(found_.text(), HasSubstr("<defaults> has two <body> of class 'x'"));
}

}  // namespace
}  // namespace presa::scene_test
