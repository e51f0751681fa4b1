// Non-convex against non-convex: a cog dragged through a cog, two rabbits pressed together, a key in its lock. Forces stay
// bounded and smooth, depths small, and no energy comes from nothing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "framework/haptics/virtual_coupling.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_files.h"
#include "tests/support/alloc_lock_guard.h"
#include "tests/support/mesh_file.h"
#include "tests/support/one_tool.h"

namespace presa::hard_pairs_test {
namespace {

using test::OneTool;
using test::toolWorld;
using test::turned;

constexpr double kPi = std::numbers::pi;

std::string meshTool(const std::string& file, const std::string& attributes = "") {
  return "<tool " + attributes + "><mesh file=\"" PRESA_SOURCE_DIR "/config/meshes/" + file + "\"/></tool>";
}
std::string meshBody(const std::string& file, const std::string& material) {
  return "<body name=\"other\" fixed=\"true\" material=\"" + material +
         "\"><haptic><mesh file=\"" PRESA_SOURCE_DIR "/config/meshes/" + file + "\"/></haptic></body>";
}

/// Max step of the force: a tick moves no point of the tool farther than four voxels, of 1/200 of the body's side.
constexpr double maxStep(double handle, double side) { return handle * 4 * side / 200; }

/// What a tool did along the way of a hand.
struct Course {
  double force = 0, torque = 0, step = 0, depth = 0, energy = 0;  ///< largest; energy to the hand [N, N m, N, m, J]
  std::uint32_t late = 0, ticks = 0;
};

template <class Hand>
Course drive(OneTool& tool, int ticks, const Hand& hand) {
  Course course;
  Pose last = hand(0);
  Vec3 force = tool.rest(last, 300).f_H_W;
  const std::uint32_t late = tool.state().late;
  for (int i = 1; i <= ticks; ++i) {
    const Pose now = hand(i);
    const FingerContact& contact = tool.tick(now);
    course.force = std::max(course.force, contact.f_H_W.norm());
    course.torque = std::max(course.torque, contact.t_H_W.norm());
    course.step = std::max(course.step, (contact.f_H_W - force).norm());
    course.depth = std::max(course.depth, tool.state().depth);
    course.energy += contact.f_H_W.dot(now.p - last.p) + contact.t_H_W.dot(turnBetween(last.q, now.q));
    force = contact.f_H_W;
    last = now;
  }
  course.late = tool.state().late - late;
  course.ticks = static_cast<std::uint32_t>(ticks);
  std::printf("force %.2f N, step %.3f N, torque %.3f N m, depth %.1f um, energy %.2e J, late %u of %u\n", course.force,
              course.step, course.torque, 1e6 * course.depth, course.energy, course.late, course.ticks);
  return course;
}

// The haptic thread runs all of this.
TEST(HardPairs, NeitherAllocateNorLock) {
  OneTool tool(toolWorld(meshTool("cog.obj"), meshBody("cog.obj", "rough")));
  tool.rest({{0.06, 0, 0}, turned({0, 0, 1}, 15)}, 50);
  const RealTimeGuard guard;
  for (int i = 0; i < 3000; ++i)
    tool.tick({{0.06 - 0.014 * std::min(1.0, i / 1000.0), 0.001 * std::sin(0.01 * i), 0},
               turned({0.1, 0, 1}, 15 + 0.01 * i)});
  EXPECT_EQ(guard.violations(), 0) << guard.first();
  EXPECT_GT(tool.state().points, 0U);
}

// Its axis goes round the other's at 47 mm, a millimetre nearer than they mesh, and does not turn with it: every tooth
// has to be climbed.
TEST(HardPairs, ACogDraggedThroughACog) {
  for (const char* material : {"smooth", "rough"}) {
    OneTool tool(toolWorld(meshTool("cog.obj"), meshBody("cog.obj", material)));
    tool.rest({{0.06, 0, 0}, turned({0, 0, 1}, 15)}, 50);
    for (int i = 0; i < 500; ++i) tool.tick({{0.06 - 0.013 * i / 500, 0, 0}, turned({0, 0, 1}, 15)});
    const Course course = drive(tool, 20000, [](int i) {
      const double phi = 2 * kPi * i / 20000;
      return Pose{{0.047 * std::cos(phi), 0.047 * std::sin(phi), 0}, turned({0, 0, 1}, 15)};
    });
    EXPECT_LE(course.force, 8 + 1e-9) << material;
    EXPECT_LT(course.step, maxStep(1000, 0.056)) << "a tooth lets go";
    EXPECT_LT(course.depth, 0.056 / 200) << "a voxel";
    EXPECT_LT(course.energy, 0);
  }
}

TEST(HardPairs, TwoRabbitsPressedTogetherAndTurned) {
  for (const char* material : {"smooth", "rough"}) {
    // 20 N need a handle that gives them
    OneTool tool(
        toolWorld(meshTool("bunny.obj", R"(stiffness="2000" turn_stiffness="20" max_force="24" max_torque="3")"),
                  meshBody("bunny.obj", material)));
    const Quat facing = turned({0, 0, 1}, 180);
    for (int i = 0; i <= 1000; ++i) tool.tick({{0.13 - 0.062e-3 * i, 0.003, 0}, facing});
    const Course course = drive(tool, 20000, [&](int i) {
      const double t = 1e-3 * i;
      return Pose{{0.068, 0.003, 0.004 * std::sin(t)},
                  turned({std::cos(t), std::sin(t), 0.3}, 10 * std::sin(0.7 * t)) * facing};
    });
    EXPECT_GT(course.force, 15) << material;
    EXPECT_LE(course.force, 24 + 1e-9);
    EXPECT_LT(course.step, maxStep(2000, 0.102));
    EXPECT_LT(course.energy, 0);
    EXPECT_LT(course.depth, 0.102 / 200) << "a voxel";
  }
}

// The bunny that everybody knows, from Debian's libcgal-demo, scaled to 150 mm.
TEST(HardPairs, TwoBunniesPressedTogetherAndTurned) {
  const test::MeshFile bunny(test::realMesh("bunny00"), "bunny");
  OneTool tool(toolWorld(R"(<tool stiffness="2000" turn_stiffness="20" max_force="24" max_torque="3"><mesh file=")" +
                             bunny.path() + "\"/></tool>",
                         bunny.body("bunny", "rough")));
  const Quat facing = turned({0, 1, 0}, 180);
  const double apart = 0.1;
  for (int i = 0; i <= 1000; ++i) tool.tick({{0.2 - (0.2 - apart) * 1e-3 * i, 0, 0}, facing});
  // a closed way, so that no spring is tighter at its end
  const Course course = drive(tool, 10000, [&](int i) {
    const double phi = 2 * kPi * i / 10000;
    return Pose{{apart, 0.003, 0.004 * std::sin(2 * phi)},
                turned({std::cos(2 * phi), std::sin(2 * phi), 0.3}, 10 * std::sin(phi)) * facing};
  });
  EXPECT_GT(course.force, 15);
  EXPECT_LE(course.force, 24 + 1e-9);
  EXPECT_LT(course.step, maxStep(2000, 0.15));
  EXPECT_LT(course.energy, 0);
  EXPECT_LT(course.depth, 0.15 / 200) << "a voxel";
}

/// A prism: a closed outline in x and y, counter-clockwise and star-shaped about `middle`, between z = low and high.
TriMesh prism(const std::vector<Vec3>& outline, const Vec3& middle, double low, double high) {
  TriMesh mesh;
  const int n = static_cast<int>(outline.size());
  for (const double z : {low, high}) {
    for (const Vec3& p : outline) mesh.vertices.emplace_back(p.x(), p.y(), z);
  }
  mesh.vertices.emplace_back(middle.x(), middle.y(), low);
  mesh.vertices.emplace_back(middle.x(), middle.y(), high);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
    mesh.triangles.push_back({2 * n, j, i});
    mesh.triangles.push_back({2 * n + 1, n + i, n + j});
  }
  return mesh;
}

/// Cross section of a key: a round shaft with a bit. `wider`: the keyway around it [m].
std::vector<Vec3> keySection(double wider) {
  std::vector<Vec3> outline;
  const double r = 0.003 + wider, half = 0.001 + wider, reach = 0.009 + wider;
  const double first = std::asin(half / r);
  outline.emplace_back(reach, -half, 0);
  outline.emplace_back(reach, half, 0);
  for (int i = 0; i <= 40; ++i) {
    const double a = first + (2 * kPi - 2 * first) * i / 40;
    outline.emplace_back(r * std::cos(a), r * std::sin(a), 0);
  }
  return outline;
}

/// A block with a keyway through it, 0.2 mm wider than the key: a ring between the keyway and a square.
TriMesh lock() {
  const std::vector<Vec3> inner = keySection(0.0002);
  TriMesh mesh;
  const int n = static_cast<int>(inner.size());
  for (const double z : {0.0, 0.02}) {
    for (const Vec3& p : inner) mesh.vertices.emplace_back(p.x(), p.y(), z);
    for (const Vec3& p : inner) {
      const Vec3 out = 0.02 / std::max(std::abs(p.x()), std::abs(p.y())) * p;
      mesh.vertices.emplace_back(out.x(), out.y(), z);
    }
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n, up = 2 * n;
    const auto quad = [&](int a, int b, int c, int d) {
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    };
    quad(i, up + i, up + j, j);                    // keyway, seen from inside of it
    quad(n + i, n + j, up + n + j, up + n + i);    // outside
    quad(i, j, n + j, n + i);                      // below
    quad(up + i, up + n + i, up + n + j, up + j);  // above
  }
  return mesh;
}

TEST(HardPairs, AKeyInItsLock) {
  const test::MeshFile key(prism(keySection(0), Vec3::Zero(), -0.03, 0), "key"), hole(lock(), "lock");
  for (const char* material : {"smooth", "rough"}) {
    OneTool tool(toolWorld("<tool turn_stiffness=\"0.5\"><mesh file=\"" + key.path() + "\"/></tool>",
                           hole.body("lock", material), R"(<pointshell stiffness="500000"/>)"));
    // in, then turned against the keyway by 25 degrees to both sides and rocked
    for (int i = 0; i <= 2000; ++i) tool.tick({{0, 0, 0.055 - 0.03 * i / 2000}, Quat::Identity()});
    const Course course = drive(tool, 20000, [](int i) {
      const double t = 1e-3 * i;
      return Pose{{0, 0, 0.025}, turned({0, 0, 1}, 25 * std::sin(2 * t)) * turned({1, 0, 0}, 8 * std::sin(0.9 * t))};
    });
    EXPECT_LT(tool.state().X_WT.p.z(), 0.027) << "it went in";
    EXPECT_LT(tool.state().X_WT.q.angularDistance(Quat::Identity()), 0.2) << "the lock holds it";
    EXPECT_GT(course.torque, 0.1);
    EXPECT_LE(course.force, 8 + 1e-9) << material;
    EXPECT_LT(course.step, maxStep(1000, 0.04));
    EXPECT_LT(course.depth, 0.04 / 200) << "a voxel";
  }
}

}  // namespace
}  // namespace presa::hard_pairs_test
