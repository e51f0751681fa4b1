#include "framework/scene/world.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "framework/scene/inertia.h"
#include "framework/scene/physics_shapes.h"
#include "framework/scene/piece_cache.h"

namespace presa {
namespace {

using std::numbers::pi;

constexpr const char* kAmphora = PRESA_SOURCE_DIR "/config/meshes/amphora.obj";

Body freeBody(const Shape& shape, double mass, const Pose& X_BG = {}) {
  Body body;
  body.name = "thing";
  body.mass = mass;
  body.physics = Geometry{shape, X_BG, {"scene.xml", 3, 1}};
  return body;
}

// The closed form of a shape and the divergence theorem on its refined triangulation agree.
TEST(Inertia, ClosedFormsAgreeWithTheirTriangulations) {
  const auto compare = [](const Shape& shape, const TriMesh& mesh, double tolerance) {
    const MassProperties exact = massPropertiesOf(shape, nullptr), meshed = massProperties(mesh);
    EXPECT_NEAR(meshed.volume / exact.volume, 1, tolerance);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(meshed.inertia(i, i) / exact.inertia(i, i), 1, 2 * tolerance);
  };
  compare(Box{{0.1, 0.2, 0.3}}, makeBox({0.1, 0.2, 0.3}), 1e-14);
  // an inscribed polygon of n sides lacks (2 pi / n)^2 / 6 of the circle's area; a faceted sphere lacks about twice
  // that
  const double lack = std::pow(2 * pi / 2000, 2) / 6;
  compare(Cylinder{0.03, 0.2}, makeCylinder(0.03, 0.2, 2000), 2 * lack);
  const double coarse = std::pow(2 * pi / 400, 2) / 6;
  compare(Capsule{0.03, 0.2}, makeCapsule(0.03, 0.2, 400), 4 * coarse);
  compare(Sphere{0.03}, makeCapsule(0.03, 0.0, 400), 4 * coarse);
}

// Offset geometry shifts the centre of mass and rotates the inertia; mass and density give the same result.
TEST(Inertia, FollowsTheGeometryInTheBody) {
  const Pose X_BG{Vec3(0.1, 0, -0.2), Quat(Eigen::AngleAxisd(pi / 2, Vec3::UnitX()))};
  Diagnostics diagnostics;
  Body body = freeBody(Box{{0.1, 0.2, 0.4}}, 0.6, X_BG);
  const BodyInertia by_mass = inertiaOf(body, {}, diagnostics);
  EXPECT_LT((by_mass.p_BCm - X_BG.p).norm(), 1e-15);
  EXPECT_LT((by_mass.inertia - Mat3(Vec3(0.05 * 0.20, 0.05 * 0.05, 0.05 * 0.17).asDiagonal())).norm(), 1e-15);
  body.mass.reset();
  body.density = 0.6 / (0.1 * 0.2 * 0.4);
  EXPECT_LT((inertiaOf(body, {}, diagnostics).inertia - by_mass.inertia).norm(), 1e-15);
  EXPECT_TRUE(diagnostics.all().empty());
}

// A dumbbell: closed forms of its balls, moved by the parallel axis theorem, and of its bar. Equal density
// everywhere, and each shape counts in full, where they overlap, too.
TEST(Inertia, OfADumbbellIsTheSumOfItsShapes) {
  const double r = 0.03, d = 0.1, bar = 0.01, length = 0.18;
  const Quat q(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const Pose X_BG{Vec3(0.1, -0.2, 0.3), q};
  Compound dumbbell;
  dumbbell.parts.push_back({Sphere{r}, {Vec3(0, 0, d), Quat::Identity()}, {}});
  dumbbell.parts.push_back({Sphere{r}, {Vec3(0, 0, -d), Quat::Identity()}, {}});
  dumbbell.parts.push_back({Cylinder{bar, length}, {}, {}});
  const double density = 2000, ball = density * 4.0 / 3.0 * pi * r * r * r, rod = density * pi * bar * bar * length;
  const double along = 2 * 0.4 * ball * r * r + rod * bar * bar / 2;
  const double across = 2 * (0.4 * ball * r * r + ball * d * d) + rod * (bar * bar / 4 + length * length / 12);
  const Mat3 R = q.toRotationMatrix(), expected = R * Vec3(across, across, along).asDiagonal() * R.transpose();
  Body body = freeBody(dumbbell, 2 * ball + rod, X_BG);
  Diagnostics diagnostics;
  for (const bool by_density : {false, true}) {
    if (by_density) {
      body.mass.reset();
      body.density = density;
    }
    const BodyInertia found = inertiaOf(body, {}, diagnostics);
    EXPECT_NEAR(found.mass, 2 * ball + rod, 1e-14);
    EXPECT_LT((found.p_BCm - X_BG.p).norm(), 1e-15);
    EXPECT_LT((found.inertia - expected).norm(), 1e-15);
  }
  EXPECT_TRUE(diagnostics.all().empty());
}

// Values of the scene replace those of the shapes.
TEST(Inertia, OfTheSceneCounts) {
  Body body = freeBody(Box{{0.1, 0.2, 0.4}}, 0.6);
  body.p_BCm = Vec3(0.01, 0, 0.02);
  Mat3 given;
  given << 3, 0.1, 0, 0.1, 4, 0, 0, 0, 5;
  body.inertia_B = 1e-3 * given;
  Diagnostics diagnostics;
  const BodyInertia found = inertiaOf(body, {}, diagnostics);
  EXPECT_EQ(found.mass, 0.6);
  EXPECT_EQ(found.p_BCm, *body.p_BCm);
  EXPECT_EQ(found.inertia, *body.inertia_B);
  EXPECT_TRUE(diagnostics.all().empty());
  // a moment larger than the sum of the others
  body.inertia_B = Vec3(1e-3, 1e-3, 3e-3).asDiagonal();
  EXPECT_EQ(inertiaOf(body, {}, diagnostics).mass, 0);
  ASSERT_TRUE(diagnostics.hasErrors());
  EXPECT_EQ(diagnostics.all().front().code, 321);
}

TEST(Inertia, RefusesWhatCannotMove) {
  for (const Body& body : {freeBody(Box{{0.1, 0, 0.1}}, 1), freeBody(Sphere{0.1}, -1), freeBody(Sphere{0.1}, 0)}) {
    Diagnostics diagnostics;
    inertiaOf(body, {}, diagnostics);
    ASSERT_EQ(diagnostics.errorCount(), 1u);
    EXPECT_EQ(diagnostics.all()[0].code, 321);
  }
  Diagnostics diagnostics;
  Body ghost;
  inertiaOf(ghost, {}, diagnostics);
  EXPECT_EQ(diagnostics.all().at(0).code, 320);
}

// Each file is read once per scale, however many bodies use it.
TEST(BuildWorld, ReadsEachFileOncePerScale) {
  Scene scene;
  Body body = freeBody(Box{{0.05, 0.05, 0.14}}, 0.25);
  body.visual = body.haptic = Geometry{MeshRef{kAmphora, Vec3::Ones()}, {}, {}};
  scene.bodies = {body, body};
  scene.bodies[1].haptic->shape = MeshRef{kAmphora, Vec3::Constant(2)};
  Diagnostics diagnostics;
  const World world = buildWorld(scene, {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  EXPECT_EQ(world.meshes[0].visual, world.meshes[0].haptic);
  EXPECT_EQ(world.meshes[0].visual, world.meshes[1].visual);
  ASSERT_TRUE(world.meshes[1].haptic);
  EXPECT_NEAR(radiusOf(*world.meshes[1].haptic), 2 * radiusOf(*world.meshes[0].haptic), 1e-15);
  EXPECT_FALSE(world.meshes[0].physics);
  EXPECT_EQ(world.inertias[1].mass, 0.25);
}

// The cup of the scene: alone it may have a hollow; beside another shape it has to be cut.
TEST(BuildWorld, WantsConvexMeshesAmongSeveralShapes) {
  const std::string cup = PRESA_SOURCE_DIR "/config/meshes/cup.obj";
  Compound with_handle;
  with_handle.parts.push_back({MeshRef{cup}, {}, {"scene.xml", 7, 5}});
  with_handle.parts.push_back({Capsule{0.005, 0.05}, {Vec3(0.05, 0, 0.05), Quat::Identity()}, {}});
  Scene scene;
  scene.bodies = {freeBody(with_handle, 0.2)};
  Diagnostics refused;
  buildWorld(scene, {}, refused);
  ASSERT_EQ(refused.errorCount(), 1U) << refused.text();
  EXPECT_EQ(refused.all()[0].code, 322);
  EXPECT_EQ(refused.all()[0].where.line, 7);
  std::get<MeshRef>(std::get<Compound>(scene.bodies[0].physics->shape).parts[0].shape).decompose.emplace();
  Diagnostics diagnostics;
  const World world = buildWorld(scene, {}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  EXPECT_EQ(physicsShapes(world.scene.bodies[0], world.meshes[0]).size(), 26U);
  EXPECT_LT(world.meshes[0].decomposed.at(0).error, 1e-7);
  // in one piece the mouth is closed, and the warning says how far
  scene.bodies = {freeBody(MeshRef{cup, Vec3::Ones(), Decomposition{1, 0.001}}, 0.2)};
  Diagnostics far;
  buildWorld(scene, {}, far);
  ASSERT_EQ(far.all().size(), 1U) << far.text();
  EXPECT_EQ(far.all()[0].code, 323);
}

// What was kept reads back to the bit; a file that is cut off, or has a piece with a hollow, is none.
TEST(PieceCache, GivesBackWhatItKeeps) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "piece_cache";
  std::filesystem::remove_all(folder);
  ASSERT_EQ(setenv("XDG_CACHE_HOME", folder.c_str(), 1), 0);
  const TriMesh box = makeBox({0.1, 0.2, 0.3});
  const std::string file = pieceCacheFile(box, {}), other = pieceCacheFile(box, {12, 0.001});
  EXPECT_NE(file, other);
  EXPECT_NE(file, pieceCacheFile(makeBox({0.1, 0.2, 0.31}), {}));
  EXPECT_FALSE(readPieces(file));
  keepPieces(file, {{std::make_shared<TriMesh>(box), std::make_shared<TriMesh>(makeSphere(0.1, 2))}, 0.25});
  const std::optional<ConvexPieces> kept = readPieces(file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->error, 0.25);
  ASSERT_EQ(kept->pieces.size(), 2U);
  EXPECT_EQ(kept->pieces[0]->vertices, box.vertices);
  EXPECT_EQ(kept->pieces[0]->triangles, box.triangles);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_FALSE(readPieces(file));
  TriMesh dented = box;
  dented.vertices[0] *= 0.1;
  keepPieces(other, {{std::make_shared<TriMesh>(dented)}, 0});
  EXPECT_FALSE(readPieces(other));
  unsetenv("XDG_CACHE_HOME");
}

TEST(BuildWorld, ReportsAMissingMeshOnce) {
  Scene scene;
  Body body = freeBody(MeshRef{"none.obj", Vec3::Ones()}, 1);
  body.haptic = body.physics;
  scene.bodies = {body};
  Diagnostics diagnostics;
  buildWorld(scene, {}, diagnostics);
  EXPECT_EQ(diagnostics.errorCount(), 1u) << diagnostics.text();
}

}  // namespace
}  // namespace presa
