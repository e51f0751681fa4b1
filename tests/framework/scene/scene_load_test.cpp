#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/framework/scene/scene_text.h"

namespace presa::scene_test {
namespace {

Scene load(const std::string& text, const std::vector<Override>& overrides = {}) {
  Diagnostics findings;
  Scene scene = parseScene(text, "scene.xml", "/lab", overrides, findings);
  EXPECT_TRUE(findings.all().empty()) << findings.text();
  return scene;
}

std::string poseText(const Pose& pose) {
  std::ostringstream text;
  text.precision(17);
  text << pose.p.transpose() << " | " << pose.q.coeffs().transpose();
  return text.str();
}

std::string shapeText(const Shape& shape) {
  std::ostringstream text;
  text.precision(17);
  if (const auto* mesh = std::get_if<MeshRef>(&shape)) text << "mesh " << mesh->file << " " << mesh->scale.transpose();
  if (const auto* compound = std::get_if<Compound>(&shape)) {
    for (const ShapePart& part : compound->parts)
      text << shapeText(part.shape) << " at " << poseText(part.X_GP) << "; ";
  }
  if (const auto* box = std::get_if<Box>(&shape)) text << "box " << box->size.transpose();
  if (const auto* sphere = std::get_if<Sphere>(&shape)) text << "sphere " << sphere->radius;
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    text << "cylinder " << cylinder->radius << " " << cylinder->length;
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    text << "capsule " << capsule->radius << " " << capsule->length;
  return text.str();
}

/// Every value of a scene (except source locations) to 17 digits: equal texts mean scenes equal to the bit.
std::string contentOf(const Scene& scene) {
  std::ostringstream text;
  text.precision(17);
  text << scene.name << "\n"
       << scene.description << "\n"
       << scene.default_rig << "\n"
       << scene.gravity.transpose() << "\n";
  text << scene.rates.haptic << " " << scene.rates.collision << " " << scene.rates.dynamics << " " << scene.rates.view
       << "\n";
  const DynamicsSettings& settings = scene.dynamics;
  text << settings.engine << static_cast<int>(settings.coupling) << static_cast<int>(settings.solver)
       << static_cast<int>(settings.friction) << static_cast<int>(settings.rotation) << settings.sleeping << " "
       << settings.iterations << " " << settings.substeps << "\n";
  text << scene.haptics.renderer << static_cast<int>(scene.haptics.pose) << " "
       << static_cast<int>(scene.collision.index) << " " << scene.collision.margin << "\n";
  for (const Material& m : scene.materials) {
    text << m.name << " " << m.stiffness << " " << m.damping << " " << m.friction_static << " " << m.friction_dynamic
         << " " << (m.changed_friction ? m.changed_friction->mu_static : -1) << " "
         << (m.changed_friction ? m.changed_friction->mu_dynamic : -1) << " " << m.color.transpose() << "\n";
  }
  for (const Body& b : scene.bodies) {
    text << b.name << " " << b.fixed << " " << b.material << " " << b.mass.value_or(-1) << " " << b.density.value_or(-1)
         << " " << poseText(b.X_WB) << " " << b.v_WCm.transpose() << " " << b.w_WB.transpose() << " "
         << b.force_W.transpose() << "\n";
    for (const auto* geometry : {&b.visual, &b.haptic, &b.physics}) {
      text << (*geometry && (*geometry)->smooth ? "smooth " : "")
           << (*geometry ? shapeText((*geometry)->shape) + " " + poseText((*geometry)->X_BG) : "none") << "\n";
    }
  }
  for (const DeviceRole& d : scene.devices) {
    text << d.role << " " << d.fingertip_radius << " " << d.limits.force << " " << d.limits.force_rate << " "
         << d.limits.watchdog_ms << "\n";
  }
  return text.str();
}

TEST(SceneLoad, ReadsEveryValue) {
  const Scene scene = load(kScene);
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(scene.description, "two bodies, two fingers");
  EXPECT_EQ(scene.file, "scene.xml");
  EXPECT_EQ(scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(scene.rates.haptic, 1000);
  EXPECT_EQ(scene.rates.collision, 100);
  EXPECT_EQ(scene.rates.dynamics, 200);
  EXPECT_EQ(scene.rates.view, 60);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[0].name, "rubber");
  EXPECT_EQ(scene.materials[0].stiffness, 1000);
  EXPECT_EQ(scene.materials[0].damping, 1);
  EXPECT_EQ(scene.materials[0].friction_static, 0.8);
  EXPECT_EQ(scene.materials[0].friction_dynamic, 0.6);
  EXPECT_EQ(scene.materials[0].color, Vec3(0.75, 0.25, 0.2));
  ASSERT_EQ(scene.bodies.size(), 2U);
  const Body &table = scene.bodies[0], &cube = scene.bodies[1];
  EXPECT_TRUE(table.fixed);
  EXPECT_EQ(table.material, 1U);
  EXPECT_FALSE(table.mass || table.density || table.visual);
  EXPECT_EQ(std::get<Box>(table.haptic->shape).size, Vec3(0.6, 0.4, 0.04));
  EXPECT_FALSE(cube.fixed);
  EXPECT_EQ(cube.material, 0U);
  EXPECT_EQ(cube.X_WB.p, Vec3(0, 0, 0.035));
  EXPECT_EQ(cube.mass, 0.2);
  EXPECT_EQ(std::get<MeshRef>(cube.visual->shape).file, "/lab/meshes/cube.obj");
  EXPECT_EQ(std::get<MeshRef>(cube.visual->shape).scale, Vec3::Constant(0.001));
  EXPECT_EQ(std::get<Sphere>(cube.haptic->shape).radius, 0.035);
  EXPECT_EQ(std::get<Cylinder>(cube.physics->shape).radius, 0.03);
  EXPECT_EQ(std::get<Cylinder>(cube.physics->shape).length, 0.07);
  ASSERT_EQ(scene.devices.size(), 2U);
  EXPECT_EQ(scene.devices[0].role, "thumb");
  EXPECT_EQ(scene.devices[0].limits.force, 10);
}

// One shape with a place of its own is a geometry at that place; several are a Compound in the place of <physics>.
TEST(SceneLoad, PhysicsHoldsSeveralShapes) {
  const std::string one = "<cylinder radius=\"0.03\" length=\"0.07\"/>", place = "<physics mass=\"0.2\">";
  const std::string at = "<physics mass=\"0.2\" pos=\"0 0 0.1\" euler_deg=\"0 0 90\">";
  const std::string placed = "<cylinder radius=\"0.03\" length=\"0.07\" pos=\"0.01 0 0\" euler_deg=\"90 0 0\"/>";
  const Scene single = load(edited(edited(kScene, place, at), one, placed));
  const Pose expected = Pose{Vec3(0, 0, 0.1), Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitZ()))} *
                        Pose{Vec3(0.01, 0, 0), Quat(Eigen::AngleAxisd(EIGEN_PI / 2, Vec3::UnitX()))};
  EXPECT_LT((single.bodies[1].physics->X_BG.p - expected.p).norm(), 1e-15);
  EXPECT_LT(single.bodies[1].physics->X_BG.q.angularDistance(expected.q), 1e-7);  // arc cosine near 1
  const std::string mesh = "<mesh file=\"a.obj\" decompose=\"true\" max_pieces=\"12\" max_error=\"0.002\"/>";
  const Scene scene = load(edited(edited(kScene, place, at), one, placed + mesh + "<sphere radius=\"0.02\"/>"));
  const Geometry& physics = *scene.bodies[1].physics;
  EXPECT_EQ(physics.X_BG.p, Vec3(0, 0, 0.1));
  const auto& parts = std::get<Compound>(physics.shape).parts;
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].X_GP.p, Vec3(0.01, 0, 0));
  EXPECT_EQ(std::get<MeshRef>(parts[1].shape).file, "/lab/a.obj");
  EXPECT_EQ(std::get<MeshRef>(parts[1].shape).decompose.value().max_pieces, 12U);
  EXPECT_EQ(std::get<MeshRef>(parts[1].shape).decompose.value().max_error, 0.002);
  EXPECT_EQ(std::get<Sphere>(parts[2].shape).radius, 0.02);
  EXPECT_EQ(parts[2].X_GP.p, Vec3(Vec3::Zero()));
  // the resolved text, which recordings keep, is the same scene
  Diagnostics again;
  const Scene reread = parseScene(scene.resolved_xml, "scene.xml", "/elsewhere", {}, again);
  EXPECT_TRUE(again.all().empty()) << again.text();
  EXPECT_EQ(contentOf(reread), contentOf(scene));
}

// Defaults are stated in the XSD and in scene.h: an omitted value must be the same from both.
TEST(SceneLoad, DefaultsOfTheSchemaAreThoseOfTheHeader) {
  const Scene scene = load(
      "<scene version=\"1.0\" name=\"x\"><world gravity=\"0 0 0\"/>"
      "<materials><material name=\"m\" stiffness=\"500\"/></materials>"
      "<body name=\"b\"><physics density=\"10\"><mesh file=\"b.stl\"/></physics></body>"
      "<devices><device role=\"r\"/></devices></scene>");
  Scene expected;
  expected.name = "x";
  expected.gravity.setZero();
  Material material;
  material.name = "m";
  material.stiffness = 500;
  expected.materials.push_back(material);
  Body body;
  body.name = "b";
  body.density = 10;
  body.physics = Geometry{MeshRef{"/lab/b.stl"}, {}, {}};
  expected.bodies.push_back(body);
  DeviceRole role;
  role.role = "r";
  expected.devices.push_back(role);
  EXPECT_EQ(contentOf(scene), contentOf(expected));
}

// A name that a later format has no more: read in a scene of before, unknown in one of today.
TEST(SceneLoad, ReadsScenesOfOlderFormats) {
  const std::string old = edited(kScene, "<body name=\"cube\"", "<collision max_triangles=\"64\"/><body name=\"cube\"");
  const Scene scene = load(old);
  EXPECT_EQ(contentOf(scene), contentOf(load(kScene)));
  EXPECT_THAT(scene.resolved_xml, testing::HasSubstr("version=\"1.1\""));
  EXPECT_THAT(scene.resolved_xml, testing::Not(testing::HasSubstr("max_triangles")));
  Diagnostics found;
  parseScene(edited(old, "<scene version=\"1.0\"", "<scene version=\"1.1\""), "scene.xml", "", {}, found);
  EXPECT_THAT(found.text(), testing::HasSubstr("unknown attribute 'max_triangles' on <collision>"));
}

TEST(SceneLoad, EveryMethodCanBeNamed) {
  const Scene scene = load(edited(
      edited(
          kScene, "<body name=\"cube\"",
          "<haptics renderer=\"penalty\" pose=\"hold\"/><collision index=\"hcollide\" margin=\"0.002\"/>"
          "<dynamics coupling=\"explicit\" solver=\"direct\" iterations=\"30\" substeps=\"4\" friction=\"pyramid\" "
          "rotation=\"matrix\" sleeping=\"false\"/><body name=\"cube\" velocity=\"1 2 3\" angular_velocity=\"4 5 6\""),
      "mass=\"0.2\"", "mass=\"0.2\" force=\"7 8 9\""));
  EXPECT_EQ(scene.haptics.renderer, "penalty");
  EXPECT_FALSE(scene.haptics.proxy);
  EXPECT_EQ(scene.haptics.pose, HapticSettings::PoseUse::kHold);
  EXPECT_EQ(scene.collision.index, CollisionSettings::Index::kHcollide);
  EXPECT_EQ(scene.collision.margin, 0.002);
  EXPECT_EQ(scene.dynamics.coupling, DynamicsSettings::Coupling::kExplicit);
  EXPECT_EQ(scene.dynamics.solver, DynamicsSettings::Solver::kDirect);
  EXPECT_EQ(scene.dynamics.iterations, 30u);
  EXPECT_EQ(scene.dynamics.substeps, 4u);
  EXPECT_EQ(scene.dynamics.friction, DynamicsSettings::Friction::kPyramid);
  EXPECT_EQ(scene.dynamics.rotation, DynamicsSettings::Rotation::kMatrix);
  EXPECT_FALSE(scene.dynamics.sleeping);
  EXPECT_EQ(scene.bodies[1].v_WCm, Vec3(1, 2, 3));
  EXPECT_EQ(scene.bodies[1].w_WB, Vec3(4, 5, 6));
  EXPECT_EQ(scene.bodies[1].force_W, Vec3(7, 8, 9));
}

TEST(SceneLoad, OneFrictionCoefficientIsBoth) {
  const auto with = [](const char* friction) {
    return load(edited(kScene, "<friction static=\"0.8\" dynamic=\"0.6\"/>", friction)).materials[0];
  };
  EXPECT_EQ(with("<friction static=\"0.5\"/>").friction_dynamic, 0.5);
  EXPECT_EQ(with("<friction dynamic=\"0.4\"/>").friction_static, 0.4);
  EXPECT_EQ(with("<friction/>").friction_static, 0);
  EXPECT_FALSE(with("<friction static=\"0.5\"/>").changed_friction);
  const auto changed = with("<friction static=\"0.5\"><changed static=\"0.3\"/></friction>").changed_friction;
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->mu_static, 0.3);
  EXPECT_EQ(changed->mu_dynamic, 0.3);
}

// The coefficients that section 3.6.1 of the PERCRO paper quotes, typed in here.
TEST(SceneLoad, AFrictionPresetIsAStaticCoefficient) {
  const auto with = [](const std::string& friction, const std::vector<Override>& overrides = {}) {
    return load(edited(kScene, "<friction static=\"0.8\" dynamic=\"0.6\"/>", friction), overrides);
  };
  for (const auto& [name, coefficient] : {std::pair{"rayon", 0.42}, {"suede", 0.61}, {"sandpaper", 1.67}}) {
    const Scene scene = with(std::string("<friction preset=\"") + name + "\" dynamic=\"0.4\"/>");
    EXPECT_EQ(scene.materials[0].friction_static, coefficient);
    EXPECT_EQ(scene.materials[0].friction_dynamic, 0.4);
    EXPECT_EQ(scene.resolved_xml.find("preset"), std::string::npos) << "a recording has the number";
  }
  EXPECT_EQ(with("<friction preset=\"rayon\"/>").materials[0].friction_dynamic, 0.42);
  EXPECT_EQ(
      with("<friction preset=\"rayon\"/>", {{"material/rubber/friction/static", "0.5"}}).materials[0].friction_static,
      0.5);
  EXPECT_EQ(
      with("<friction static=\"0.5\"/>", {{"material/rubber/friction/preset", "suede"}}).materials[0].friction_static,
      0.61);
}

// Intrinsic x-y-z: R = Rx Ry Rz, compared with the product of the three textbook matrices.
TEST(SceneLoad, EulerAnglesTurnAboutXThenNewYThenNewZ) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 50; ++i) {
    double a[3];
    std::string text;
    for (double& angle : a) {
      angle = static_cast<double>(static_cast<long>(random() % 1441) - 720);
      text += std::to_string(angle) + " ";
    }
    const Scene scene = load(edited(kScene, "euler_deg=\"0 0 90\"", "euler_deg=\"" + text + "\""));
    const double k = std::numbers::pi / 180;
    const double cx = std::cos(a[0] * k), sx = std::sin(a[0] * k), cy = std::cos(a[1] * k), sy = std::sin(a[1] * k),
                 cz = std::cos(a[2] * k), sz = std::sin(a[2] * k);
    Mat3 x, y, z;
    x << 1, 0, 0, 0, cx, -sx, 0, sx, cx;
    y << cy, 0, sy, 0, 1, 0, -sy, 0, cy;
    z << cz, -sz, 0, sz, cz, 0, 0, 0, 1;
    // 1e-14: a few roundings of numbers up to 1 and of an angle up to 13 rad
    EXPECT_TRUE(scene.bodies[1].X_WB.q.toRotationMatrix().isApprox(x * y * z, 1e-14)) << text;
  }
}

TEST(SceneLoad, HalfTurnIsExact) {
  const Scene scene = load(edited(kScene, "euler_deg=\"0 0 90\"", "euler_deg=\"0 0 180\""));
  EXPECT_EQ(scene.bodies[1].X_WB.q.coeffs(), Eigen::Vector4d(0, 0, 1, 0));
}

// w x y z of any length, also where the squares of the entries overflow or underflow.
TEST(SceneLoad, QuaternionIsNormalised) {
  for (const char* quat : {"0 2 0 0", "0 1e300 0 0", "0 1e-300 0 0"}) {
    const Scene scene = load(edited(kScene, "euler_deg=\"0 0 90\"", std::string("quat=\"") + quat + "\""));
    EXPECT_EQ(scene.bodies[1].X_WB.q.coeffs(), Eigen::Vector4d(1, 0, 0, 0)) << quat;
  }
}

TEST(SceneLoad, ElementsStandInAnyOrder) {
  const auto start = kScene.find("  <world"), middle = kScene.find("  <body name=\"table\""),
             end = kScene.find("</scene>");
  const std::string turned = kScene.substr(0, start) + kScene.substr(middle, end - middle) +
                             kScene.substr(start, middle - start) + kScene.substr(end);
  EXPECT_EQ(contentOf(load(turned)), contentOf(load(kScene)));
}

// The decimal sign is a point in every locale.
TEST(SceneLoad, NumbersMayHaveSignExponentAndSpace) {
  EXPECT_EQ(load(edited(kScene, "mass=\"0.2\"", "mass=\" +2.5e-1\t\"")).bodies[1].mass, 0.25);
}

// A recording stores the resolved text; a replay must read exactly the same scene from it, from any directory.
TEST(ResolvedScene, ReadsBackAsTheSameScene) {
  for (const char* edit : {"euler_deg=\"0 0 90\"", "quat=\"0.3 0.1 -0.7 2\"", "", "fixed=\"true\""}) {
    Diagnostics findings;
    const Scene scene = parseScene(edited(kScene, "euler_deg=\"0 0 90\"", edit), "scene.xml", "/lab", {}, findings);
    Diagnostics again_findings;
    const Scene again = parseScene(scene.resolved_xml, "resolved", "/elsewhere", {}, again_findings);
    EXPECT_FALSE(again_findings.hasErrors()) << again_findings.text() << scene.resolved_xml;
    EXPECT_EQ(contentOf(again), contentOf(scene));
    EXPECT_EQ(again.resolved_xml, scene.resolved_xml) << "resolving is idempotent";
  }
}

TEST(ResolvedScene, OfTheExampleReadsBackAsTheSameScene) {
  Diagnostics findings;
  const Scene scene = loadScene(PRESA_SOURCE_DIR "/config/scenes/cube.xml", {}, findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_EQ(scene.default_rig, PRESA_SOURCE_DIR "/config/rigs/pinch_cube.xml");
  const Scene again = parseScene(scene.resolved_xml, "resolved", "/elsewhere", {}, findings);
  ASSERT_TRUE(findings.all().empty()) << findings.text();
  EXPECT_EQ(contentOf(again), contentOf(scene));
}

TEST(ResolvedScene, StatesEveryDefault) {
  const std::string text =
      load(edited(kScene, "  <rates haptic=\"1000\" collision=\"100\" dynamics=\"200\" view=\"60\"/>\n", ""))
          .resolved_xml;
  for (const char* part : {"<rates haptic=\"1000\" collision=\"100\" dynamics=\"200\" view=\"60\"/>", "fixed=\"false\"",
                           "fingertip_radius=\"0.008\"", "watchdog_ms=\"20\"", "color=\"0.7 0.7 0.7\"", "damping=\"0\"",
                           "/lab/meshes/cube.obj"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
}

/// A few random edits of the bytes of `text`: cut, duplicate, replace, swap two words.
std::string mutated(std::string text, std::mt19937_64& random) {
  static const std::string kAlphabet = "<>/\"='&;!-[] \n0123456789.eENaxm\xC3\x01";
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1)); };
  for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
    const std::size_t at = below(text.size()), length = 1 + below(30);
    switch (below(5)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 2:
        text[at] = kAlphabet[below(kAlphabet.size())];
        break;
      case 3:
        text.insert(at, 1, kAlphabet[below(kAlphabet.size())]);
        break;
      default:
        text.resize(at);
        break;
    }
    if (text.empty()) break;
  }
  return text;
}

// Any file gives either a scene that reads back as itself, or errors and no scene.
// E199 would be an error that libxml2's validator finds and the rules do not explain.
TEST(SceneLoad, MutatedSceneIsReadWholeOrRefused) {
  std::mt19937_64 random(20261121);
  int good = 0;
  for (int i = 0; i < 1500; ++i) {
    const std::string text = mutated(kScene, random);
    Diagnostics findings;
    const Scene scene = parseScene(text, "scene.xml", "/lab", {}, findings);
    for (const Diagnostic& finding : findings.all()) EXPECT_NE(finding.code, 199) << findings.text() << text;
    if (findings.hasErrors()) {
      EXPECT_TRUE(scene.bodies.empty() && scene.materials.empty() && scene.resolved_xml.empty());
      for (const Diagnostic& finding : findings.all()) EXPECT_FALSE(finding.message.empty());
      continue;
    }
    ++good;
    Diagnostics again_findings;
    const Scene again = parseScene(scene.resolved_xml, "resolved", "/", {}, again_findings);
    EXPECT_FALSE(again_findings.hasErrors()) << again_findings.text() << text;
    EXPECT_EQ(contentOf(again), contentOf(scene)) << text;
  }
  EXPECT_GT(good, 50) << "the mutations must leave some scenes whole, or the second half tests nothing";
}

}  // namespace
}  // namespace presa::scene_test
