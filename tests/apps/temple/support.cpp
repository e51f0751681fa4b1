#include "tests/apps/temple/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include "apps/temple/building/shipped.h"

namespace presa::temple::test {
namespace {

/// Signed distance to the half spaces and cylinder whose intersection is the shape; negative inside. Exact inside,
/// which is sufficient for depths.
double outside(const Block& block, const Vec3& p) {
  if (const Box* box = std::get_if<Box>(&block.physics)) return (p.cwiseAbs() - box->size / 2).maxCoeff();
  if (const Cylinder* rod = std::get_if<Cylinder>(&block.physics))
    return std::max(p.head<2>().norm() - rod->radius, std::abs(p.z()) - rod->length / 2);
  double farthest = -1e300;
  const TriMesh& mesh = block.physics_mesh;
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto at = [&](int i) { return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])]; };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    farthest = std::max(farthest, normal.dot(p - at(0)));
  }
  return farthest;
}

/// Sample points on the surface, including edges.
std::vector<Vec3> surface(const Block& block) {
  std::vector<Vec3> points;
  constexpr int kSteps = 12;
  const auto fill = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const double s = double(i) / kSteps, t = double(j) / kSteps;
        points.push_back((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d);
      }
    }
  };
  if (const Box* box = std::get_if<Box>(&block.physics)) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const Vec3 n = side * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
        const auto corner = [&](double a, double b) { return Vec3(0.5 * box->size.cwiseProduct(n + a * u + b * v)); };
        fill(corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1));
      }
    }
  } else if (const Cylinder* rod = std::get_if<Cylinder>(&block.physics)) {
    for (int i = 0; i < 72; ++i) {
      const double angle = 2 * std::numbers::pi * i / 72;
      const Vec3 rim(rod->radius * std::cos(angle), rod->radius * std::sin(angle), rod->length / 2);
      const Vec3 foot(rim.x(), rim.y(), -rim.z());
      fill(rim, foot, {0, 0, foot.z()}, {0, 0, rim.z()});
      fill(rim, rim, foot, foot);
    }
  } else {
    for (const TriMesh::Triangle& t : block.physics_mesh.triangles) {
      const auto at = [&](int i) {
        return block.physics_mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
      };
      fill(at(0), at(1), at(2), at(0));
    }
  }
  return points;
}

}  // namespace

Proportions shippedWith(const std::string& name, const std::string& from, const std::string& to) {
  const std::map<std::string, const char*> texts{{"first", shipped::first},
                                                 {"column", shipped::column},
                                                 {"facade", shipped::facade},
                                                 {"parthenon_column", shipped::parthenon_column},
                                                 {"parthenon_facade", shipped::parthenon_facade}};
  std::string text = texts.at(name);
  if (!from.empty()) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  }
  const std::string file = scratch("parameters") + "/" + name + ".xml";
  std::ofstream(file) << text;
  Diagnostics diagnostics;
  Proportions proportions = readProportions(file, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  return proportions;
}

Building shippedBuilding(const std::string& name, std::uint64_t seed) {
  return makeBuilding(shippedWith(name), 0.1, seed);
}

double overlap(const Block& A, const Pose& X_WA, const Block& B, const Pose& X_WB) {
  double deepest = -1e300;
  for (const Vec3& point : surface(A)) deepest = std::max(deepest, -outside(B, X_WB.inverseTimes(X_WA * point)));
  for (const Vec3& point : surface(B)) deepest = std::max(deepest, -outside(A, X_WA.inverseTimes(X_WB * point)));
  return deepest;
}

std::string scratch(const std::string& name) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("presa_test_temple_" + std::to_string(::getpid())) / name;
  std::filesystem::create_directories(folder);
  return folder.string();
}

namespace {

/// Removes all scratch folders when the tests have passed.
class Cleaning : public ::testing::Environment {
  void TearDown() override {
    std::error_code ignored;
    if (!::testing::UnitTest::GetInstance()->Failed())
      std::filesystem::remove_all(std::filesystem::path(scratch("")).parent_path(), ignored);
  }
};
const auto* const kCleaning = ::testing::AddGlobalTestEnvironment(new Cleaning);

}  // namespace
}  // namespace presa::temple::test
