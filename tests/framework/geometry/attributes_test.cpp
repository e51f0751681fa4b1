// Names of materials and colours of vertices in mesh files, in the order of the imported triangles.
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "framework/geometry/mesh_attributes.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

class MeshAttributesOf : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("presa_mesh_attributes_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Also compares its triangles with those of importMesh.
  AttributedMesh read(const std::string& name, const std::string& contents, ImportOptions options = {}) {
    const std::string file = (folder_ / name).string();
    std::ofstream(file, std::ios::binary) << contents;
    options.must_be_closed = false;
    found_ = {};
    AttributedMesh read = importAttributed(file, options, {"scene.xml", 7, 3}, found_);
    Diagnostics again;
    const TriMesh plain = importMesh(file, options, {"scene.xml", 7, 3}, again);
    EXPECT_EQ(read.mesh.vertices, plain.vertices);
    EXPECT_EQ(read.mesh.triangles, plain.triangles);
    EXPECT_EQ(found_.text(), again.text());
    EXPECT_EQ(read.attributes.part_of.size(), read.mesh.triangles.size());
    return read;
  }
  /// Grey value at each corner that lies at p.
  static std::vector<float> greyAt(const AttributedMesh& read, const Vec3& p) {
    std::vector<float> all;
    for (std::size_t t = 0; t < read.mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& v = read.mesh.vertices[static_cast<std::size_t>(read.mesh.triangles[t][i])];
        if ((v - p).norm() < 1e-6) all.push_back(read.attributes.corner_grey[t][i]);
      }
    }
    return all;
  }
  /// Name of the part of the triangle whose middle lies nearest to p.
  static std::string partAt(const AttributedMesh& read, const Vec3& p) {
    double nearest = 1e9;
    std::string name;
    for (std::size_t t = 0; t < read.mesh.triangles.size(); ++t) {
      Vec3 middle = Vec3::Zero();
      for (const std::int32_t v : read.mesh.triangles[t]) middle += read.mesh.vertices[static_cast<std::size_t>(v)] / 3;
      if ((middle - p).norm() >= nearest) continue;
      nearest = (middle - p).norm();
      const std::int32_t part = read.attributes.part_of[t];
      name = part < 0 ? "-" : read.attributes.parts[static_cast<std::size_t>(part)];
    }
    return name;
  }
  static void expectAll(const std::vector<float>& values, double expected, double tolerance) {
    EXPECT_FALSE(values.empty());
    for (const float value : values) EXPECT_NEAR(value, expected, tolerance);
  }

  fs::path folder_;
  Diagnostics found_;
};

using Names = std::vector<std::string>;

// A tetrahedron: its corners at the origin and on the axes.
constexpr const char* kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
const Vec3 kBelow(1.0 / 3, 1.0 / 3, 0), kFront(1.0 / 3, 0, 1.0 / 3), kSlope(1.0 / 3, 1.0 / 3, 1.0 / 3),
    kLeft(0, 1.0 / 3, 1.0 / 3);

// The materials' library need not be there. Faces before the first usemtl are of its material, as they are drawn.
TEST_F(MeshAttributesOf, ObjAreItsUsemtl) {
  const AttributedMesh tetra = read("a.obj", std::string("mtllib none.mtl\n") + kCorners +
                                                 "f 1 3 2\nusemtl rubber\nf 1 2 4\nusemtl steel\nf 2 3 4\nusemtl "
                                                 "rubber\nf 1 4 3\n");
  EXPECT_EQ(tetra.attributes.parts, (Names{"rubber", "steel"}));
  EXPECT_EQ(partAt(tetra, kBelow), "rubber");
  EXPECT_EQ(partAt(tetra, kFront), "rubber");
  EXPECT_EQ(partAt(tetra, kSlope), "steel");
  EXPECT_EQ(partAt(tetra, kLeft), "rubber");
  EXPECT_TRUE(tetra.attributes.corner_grey.empty());
}

TEST_F(MeshAttributesOf, APlainFileAreNone) {
  const AttributedMesh tetra = read("a.obj", std::string(kCorners) + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  EXPECT_TRUE(tetra.attributes.parts.empty());
  EXPECT_EQ(tetra.attributes.part_of, std::vector<std::int32_t>(4, -1));
  EXPECT_TRUE(tetra.attributes.corner_grey.empty());
}

// Grey is 0.2126 red + 0.7152 green + 0.0722 blue.
TEST_F(MeshAttributesOf, ObjHaveColours) {
  const AttributedMesh tetra =
      read("a.obj",
           "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 0.5 0.5 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 "
           "4 3\n");
  expectAll(greyAt(tetra, Vec3::Zero()), 0.2126, 1e-6);
  expectAll(greyAt(tetra, Vec3::UnitX()), 0.7152, 1e-6);
  expectAll(greyAt(tetra, Vec3::UnitY()), 0.0722, 1e-6);
  expectAll(greyAt(tetra, Vec3::UnitZ()), 0.5, 1e-6);
}

/// Each vertex of another grey value; its faces turn `inside_out`, one has four corners, one has none of its own area.
std::string plyOf(bool inside_out, bool with_speck) {
  std::string out =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
      "red\nproperty uchar green\nproperty uchar blue\nelement face " +
      std::string(with_speck ? "6" : "5") +
      "\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0 0 0\n1 0 0 51 51 51\n1 1 0 102 102 102\n0 1 0 153 "
      "153 153\n0 0 1 204 204 204\n1e-9 0 0 255 255 255\n";
  if (with_speck) out += "3 0 5 1\n";
  for (const std::string face : {"4 0 3 2 1", "3 0 1 4", "3 1 2 4", "3 2 3 4", "3 3 0 4"}) {
    std::string turned = face;
    if (inside_out) std::reverse(turned.begin() + 2, turned.end());
    out += turned + "\n";
  }
  return out;
}

// Triangles of a face of four corners, of a mesh that is turned, mirrored, or lost a triangle, keep the values of their
// corners.
TEST_F(MeshAttributesOf, PlyFollowTheirTrianglesThroughRepairs) {
  for (const bool inside_out : {false, true}) {
    for (const bool with_speck : {false, true}) {
      for (const double mirror : {1.0, -1.0}) {
        const AttributedMesh pyramid = read("a.ply", plyOf(inside_out, with_speck), {.scale = {1, mirror, 1}});
        EXPECT_FALSE(found_.hasErrors()) << found_.text();
        ASSERT_EQ(pyramid.mesh.triangles.size(), 6u);
        ASSERT_EQ(pyramid.attributes.corner_grey.size(), 6u);
        EXPECT_GT(massProperties(pyramid.mesh).volume, 0);
        expectAll(greyAt(pyramid, {0, 0, 0}), 0, 1e-6);
        expectAll(greyAt(pyramid, {1, 0, 0}), 0.2, 1e-6);
        expectAll(greyAt(pyramid, {1, mirror, 0}), 0.4, 1e-6);
        expectAll(greyAt(pyramid, {0, mirror, 0}), 0.6, 1e-6);
        expectAll(greyAt(pyramid, {0, 0, 1}), 0.8, 1e-6);
      }
    }
  }
}

template <class T>
std::string packed(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) out.append(reinterpret_cast<const char*>(&value), sizeof value);
  return out;
}

/// Two primitives of the tetrahedron, y up: "rubber" with COLOR_0, "steel" without colours.
std::string tetraGlb() {
  const std::string data = packed<float>({0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 1, 0}) +
                           packed<float>({0, 0, 0, 0.25F, 0.25F, 0.25F, 0.5F, 0.5F, 0.5F, 1, 1, 1}) +
                           packed<std::uint32_t>({0, 2, 1, 0, 1, 3}) + packed<std::uint32_t>({1, 2, 3, 0, 3, 2});
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"materials":[{"name":"steel"},{"name":"rubber"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"indices":2,"material":1},)"
      R"({"attributes":{"POSITION":0},"indices":3,"material":0}]}],"buffers":[{"byteLength":144}],"bufferViews":[)"
      R"({"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":48},)"
      R"({"buffer":0,"byteOffset":96,"byteLength":24},{"buffer":0,"byteOffset":120,"byteLength":24}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":2,"componentType":5125,"count":6,"type":"SCALAR"},{"bufferView":3,"componentType":5125,"count":6,"type":"SCALAR"}]})";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t n) { return packed<std::uint32_t>({static_cast<std::uint32_t>(n)}); };
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" + json +
         word(data.size()) + std::string("BIN\0", 4) + data;
}

TEST_F(MeshAttributesOf, GltfHaveMaterialsAndColours) {
  const AttributedMesh tetra = read("a.glb", tetraGlb());
  EXPECT_FALSE(found_.hasErrors()) << found_.text();
  ASSERT_EQ(tetra.mesh.triangles.size(), 4u);
  EXPECT_EQ(tetra.attributes.parts, (Names{"rubber", "steel"}));
  EXPECT_EQ(partAt(tetra, kBelow), "rubber");
  EXPECT_EQ(partAt(tetra, kFront), "rubber");
  EXPECT_EQ(partAt(tetra, kSlope), "steel");
  EXPECT_EQ(partAt(tetra, kLeft), "steel");
  // a corner of a triangle without colours counts as white
  for (std::size_t t = 0; t < 4; ++t) {
    const bool colored = tetra.attributes.parts[static_cast<std::size_t>(tetra.attributes.part_of[t])] == "rubber";
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& v = tetra.mesh.vertices[static_cast<std::size_t>(tetra.mesh.triangles[t][i])];
      EXPECT_NEAR(tetra.attributes.corner_grey[t][i], colored ? 0.25 * v.x() + 0.5 * v.y() + v.z() : 1, 1e-6) << t;
    }
  }
}

TEST_F(MeshAttributesOf, BadFilesAreRefusedAsByImportMesh) {
  for (const std::string contents : {"v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 9\n", "usemtl a\n", ""}) {
    const AttributedMesh bad = read("a.obj", contents);
    EXPECT_TRUE(found_.hasErrors());
    EXPECT_TRUE(bad.mesh.triangles.empty());
    EXPECT_TRUE(bad.attributes.parts.empty());
  }
}

}  // namespace
}  // namespace presa
