#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/core/math/random.h"
#include "framework/geometry/closest_point.h"
#include "modules/fca_mesh/mesh_walk.h"
#include "tests/apps/support/support.h"
#include "tests/modules/haptics_proxy/module_fixture.h"
#include "tests/modules/haptics_proxy/renderer_scene.h"
#include "tests/support/alloc_lock_guard.h"

namespace presa {
namespace {

using test::kStiffness;

TriMesh withAdjacency(TriMesh mesh) {
  buildAdjacency(mesh);
  return mesh;
}

World meshWorld(const TriMesh& mesh, const Pose& X_WB = {}, double mu_static = 0, double mu_dynamic = 0) {
  World world = test::worldOf(MeshRef{"mesh"});
  world.meshes[0].haptic = std::make_shared<const TriMesh>(mesh);
  world.scene.bodies[0].X_WB = X_WB;
  world.scene.materials[0].friction_static = mu_static;
  world.scene.materials[0].friction_dynamic = mu_dynamic;
  world.scene.haptics.renderer = "fca_mesh";
  return world;
}

double nearestByBruteForce(const TriMesh& mesh, const Vec3& g) {
  double least = 1e9;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    least = std::min(least, (closestOnTriangle(g, at(0), at(1), at(2)) - g).norm());
  }
  return least;
}

// From any triangle of a ball the walk ends at the nearest point of the whole mesh. From below an edge both sides may hold
// a point whose foot lies in them: they differ by less than the ball's sagitta over a triangle, 2 mm over 50 mm.
TEST(MeshWalk, EndsAtTheNearestPointOfABall) {
  const TriMesh ball = withAdjacency(makeSphere(0.05, 4));
  const fca::WalkMesh walked(ball);
  RandomStream random(1, "walk", 0);
  for (int i = 0; i < 500; ++i) {
    const Vec3 out = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    const Vec3 g = random.uniform(0.045, 0.055) * out;
    std::int32_t from = static_cast<std::int32_t>(random.uniform(0, static_cast<double>(ball.triangles.size())));
    fca::SurfacePoint at;
    at.triangle = from;
    for (int leg = 0; leg < 4; ++leg) at = fca::walk(walked, at.triangle, g);
    const double nearest = nearestByBruteForce(ball, g);
    EXPECT_LE((at.q - g).norm(), nearest + 1e-5) << i;
    EXPECT_EQ((g - at.q).dot(fca::outwardAt(walked, at)) > 0, g.norm() > at.q.norm()) << i;
  }
}

// Hills, hollows and, drawn out along x, needles too thin for the walk from plane to plane. The end is the point of its
// triangle nearest to g and, where it lies on an edge or a corner, no triangle that shares it has a nearer one. Tolerance:
// rounding of a mesh of that length.
TEST(MeshWalk, EndsWhereNoNeighbourIsNearer) {
  for (const double drawn_out : {1.0, 300.0}) {
    TriMesh mesh = makeSphere(0.05, 3);
    for (Vec3& v : mesh.vertices) v *= 1 + 0.1 * std::sin(200 * v.x()) * std::sin(200 * v.y()) * std::sin(200 * v.z());
    for (Vec3& v : mesh.vertices) v.x() *= drawn_out;
    mesh = withAdjacency(mesh);
    const fca::WalkMesh walked(mesh);
    const auto nearestOn = [&](std::size_t t, const Vec3& g) {
      const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i])]; };
      return closestOnTriangle(g, at(0), at(1), at(2));
    };
    RandomStream random(1, "hills", 0);
    int ends_inside = 0;
    for (int i = 0; i < 500; ++i) {
      Vec3 g = random.uniform(0.03, 0.07) * Vec3(random.normal(), random.normal(), random.normal()).normalized();
      g.x() *= drawn_out;
      const auto from = static_cast<std::int32_t>(random.uniform(0, static_cast<double>(mesh.triangles.size())));
      const fca::SurfacePoint end = fca::walk(walked, from, g);
      const double distance = (end.q - g).norm(), rounding = 5e-12 * drawn_out * 0.05;
      EXPECT_NEAR((nearestOn(static_cast<std::size_t>(end.triangle), g) - end.q).norm(), 0, rounding) << i;
      const bool inside = end.feature.edge < 0 && end.feature.corner < 0;
      ends_inside += inside;
      for (std::size_t t = 0; t < mesh.triangles.size() && !inside; ++t) {
        if ((nearestOn(t, end.q) - end.q).norm() > rounding) continue;
        EXPECT_GE((nearestOn(t, g) - g).norm(), distance - rounding) << i << " drawn out " << drawn_out;
      }
    }
    EXPECT_GT(ends_inside, 50);
    EXPECT_LT(ends_inside, 450);
  }
}

// Every step of the way leads to something nearer, so nothing that lies farther is passed: a plate of 1 mm holds from
// above, however deep the device is.
TEST(FcaMesh, StaysOnItsSideOfAThinPlate) {
  test::OneFinger finger(meshWorld(withAdjacency(makeBox({0.1, 0.1, 0.001}))));
  FingerContact contact;
  for (int i = 0; i < 300; ++i) contact = finger.tick({1e-4 * i - 0.015, 0, 0.01 - 1e-4 * i});
  EXPECT_NEAR(contact.f_H_W.z(), kStiffness * (0.0005 + 0.0199), 1e-9);
  EXPECT_NEAR(contact.f_H_W.head<2>().norm(), 0, 1e-9);
}

/// Least distance of a plane of the mesh from the centre: the mesh lies between that and the ball.
double innerRadius(const TriMesh& mesh) {
  double least = 1;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    least = std::min(least, std::abs((at(1) - at(0)).cross(at(2) - at(0)).normalized().dot(at(0))));
  }
  return least;
}

/// Largest angle between neighbouring triangles [rad].
double sharpest(const TriMesh& mesh) {
  const auto normal = [&](std::int32_t triangle) {
    const TriMesh::Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    return Vec3((at(1) - at(0)).cross(at(2) - at(0)).normalized());
  };
  double most = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t) {
    for (const std::int32_t other : mesh.adjacency[static_cast<std::size_t>(t)])
      most = std::max(most, std::acos(std::min(1.0, normal(t).dot(normal(other)))));
  }
  return most;
}

// Around a ball, 2 mm deep, over edges and vertices: k depth, less what the facets lie below the ball; without a step.
TEST(FcaMesh, FollowsABallOverItsFacets) {
  for (const int fineness : {3, 5}) {
    const TriMesh mesh = withAdjacency(makeSphere(0.05, fineness));
    const double sagitta = 0.05 - innerRadius(mesh);
    // the way of a tick, 0.11 mm, times the stiffness, and 2 N that turn over one edge, beside a vertex over two
    const double largest_step = kStiffness * 1.1e-4 + 2 * 2 * sharpest(mesh);
    test::OneFinger finger(meshWorld(mesh));
    Vec3 last = Vec3::Zero();
    for (int i = 0; i < 4000; ++i) {
      const double angle = 2e-3 * i, depth = std::min(0.002, 2e-5 * i - 0.001);
      const Vec3 out(std::sin(angle), 0.3 * std::sin(0.37 * angle), std::cos(angle));
      const Vec3 force = finger.tick((0.05 - depth) * out.normalized()).f_H_W;
      if (i > 200) {
        ASSERT_NEAR(force.norm(), kStiffness * 0.002, kStiffness * sagitta * 1.1) << i;
        ASSERT_LT((force - last).norm(), largest_step) << i;
      }
      last = force;
    }
  }
}

TEST(FcaMesh, LetsGoAboveTheSurface) {
  test::OneFinger finger(meshWorld(withAdjacency(makeSphere(0.05, 4))));
  finger.tick({0, 0, 0.06});
  EXPECT_GT(finger.tick({0, 0, 0.048}).f_H_W.z(), 1);
  EXPECT_EQ(finger.tick({0, 0, 0.0501}).mode, ContactMode::kNone);
  EXPECT_GT(finger.tick({0, 0, 0.048}).f_H_W.z(), 1);
}

// On a tilted side of a box, cut into triangles: break-away and slide. A step of the finger is 0.1 % of the static force.
TEST(FcaMesh, RubsLikeTheCone) {
  const Pose X_WB{Vec3(0.1, -0.2, 0.3), Quat(0.3, -0.5, 0.7, 0.2).normalized()};
  test::OneFinger finger(meshWorld(withAdjacency(makeBox({0.2, 0.2, 0.2})), X_WB, 0.8, 0.6));
  double peak = 0, ratio = 0;
  finger.tick(X_WB * Vec3(-0.03, 0.01, 0.11));
  for (int i = 0; i < 20'000; ++i) {
    const FingerContact& contact = finger.tick(X_WB * Vec3(-0.03 + 2e-6 * i, 0.01 + 1e-6 * i, 0.098));
    ratio = contact.tangential_force_W.norm() / contact.normal_force;
    peak = std::max(peak, ratio);
  }
  EXPECT_NEAR(peak, 0.8, 0.8 * 0.005);
  EXPECT_NEAR(ratio, 0.6, 0.6 * 0.005);
}

TEST(FcaMesh, NeitherAllocatesNorLocks) {
  if (!RealTimeGuard::active()) GTEST_SKIP() << "the sanitizers own these functions";
  test::OneFinger finger(meshWorld(withAdjacency(makeSphere(0.05, 4)), {}, 0.5, 0.4));
  finger.tick({0, 0, 0.06});
  const RealTimeGuard guard;
  for (int i = 0; i < 100; ++i) finger.tick({1e-4 * i, 0, 0.049});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
}

TEST(SceneWithFcaMesh, LoadsItAndNotTheGodObject) { test::expectOwnRenderer("fca_mesh"); }

TEST(SceneWithFcaMesh, RefusesGeometryThatIsNoMesh) {
  const test::Outcome run = test::presa("run " + test::source("config/scenes/cube.xml") +
                                        " --lockstep --for 0.1 --set haptics/renderer=fca_mesh");
  EXPECT_EQ(run.status, 2) << run.out;
  EXPECT_NE(run.err.find("is no mesh"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace presa
