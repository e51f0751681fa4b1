#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "framework/geometry/model.h"
#include "framework/geometry/tri_mesh.h"
#include "tests/support/effort.h"

namespace presa {
namespace {

namespace fs = std::filesystem;

/// Little-endian bytes of a number, for binary formats.
template <class T>
std::string bytes(T value) {
  std::string out(sizeof value, '\0');
  std::memcpy(out.data(), &value, sizeof value);
  return out;
}

std::string number(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

/// glTF and COLLADA (without up_axis) are y up: the point (x, y, z) is written as (x, z, -y).
Vec3 yUp(const Vec3& p) { return {p.x(), p.z(), 0.0 - p.y()}; }

std::string floats(
    const std::vector<Vec3>& points, const std::function<Vec3(const Vec3&)>& map = [](const Vec3& p) { return p; }) {
  std::string out;
  for (const Vec3& p : points) {
    for (int i = 0; i < 3; ++i) out += bytes(static_cast<float>(map(p)[i]));
  }
  return out;
}

std::string obj(const TriMesh& m) {
  std::string out;
  for (const Vec3& v : m.vertices) out += "v " + number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + "\n";
  for (const auto& t : m.triangles) {
    out += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " + std::to_string(t[2] + 1) + "\n";
  }
  return out;
}

std::string stlText(const TriMesh& m) {
  std::string out = "solid s\n";
  for (const auto& t : m.triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const std::int32_t i : t) {
      const Vec3& v = m.vertices[static_cast<std::size_t>(i)];
      out += "vertex " + number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + "\n";
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid s\n";
}

std::string stlBinary(const TriMesh& m) {
  std::string out(80, 'x');
  out += bytes(static_cast<std::uint32_t>(m.triangles.size()));
  for (const auto& t : m.triangles) {
    std::vector<Vec3> rows{Vec3::Zero()};
    for (const std::int32_t i : t) rows.push_back(m.vertices[static_cast<std::size_t>(i)]);
    out += floats(rows) + bytes(std::uint16_t{0});
  }
  return out;
}

std::string plyHeader(const std::string& format, std::size_t vertices, std::size_t faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string plyBinary(const TriMesh& m) {
  std::string out = plyHeader("binary_little_endian", m.vertices.size(), m.triangles.size()) + floats(m.vertices);
  for (const auto& t : m.triangles) {
    out += '\3';
    for (const std::int32_t i : t) out += bytes(i);
  }
  return out;
}

std::string plyText(const TriMesh& m) {
  std::string out = plyHeader("ascii", m.vertices.size(), m.triangles.size());
  for (const Vec3& v : m.vertices) out += number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + "\n";
  for (const auto& t : m.triangles)
    out += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return out;
}

std::string gltfData(const TriMesh& m) {
  std::string out = floats(m.vertices, yUp);
  for (const auto& t : m.triangles) {
    for (const std::int32_t i : t) out += bytes(static_cast<std::uint32_t>(i));
  }
  return out;
}

std::string gltfText(const TriMesh& m, const std::string& uri) {
  const std::string positions = std::to_string(12 * m.vertices.size()),
                    indices = std::to_string(12 * m.triangles.size());
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{)" +
         uri + R"("byteLength":)" + std::to_string(gltfData(m).size()) +
         R"(}],"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" + positions +
         R"(},{"buffer":0,"byteOffset":)" + positions + R"(,"byteLength":)" + indices +
         R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" + std::to_string(m.vertices.size()) +
         R"(,"type":"VEC3"},{"bufferView":1,"componentType":5125,"count":)" + std::to_string(3 * m.triangles.size()) +
         R"(,"type":"SCALAR"}]})";
}

std::string glb(const TriMesh& m) {
  std::string json = gltfText(m, "");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string data = gltfData(m);
  const auto size = [](const std::string& s) { return bytes(static_cast<std::uint32_t>(s.size())); };
  return "glTF" + bytes(std::uint32_t{2}) + bytes(static_cast<std::uint32_t>(28 + json.size() + data.size())) +
         size(json) + "JSON" + json + size(data) + std::string("BIN\0", 4) + data;
}

std::string collada(const TriMesh& m, const std::string& asset, const std::string& node = "") {
  std::string points, indices;
  for (const Vec3& v : m.vertices) points += number(v.x()) + " " + number(v.y()) + " " + number(v.z()) + " ";
  for (const auto& t : m.triangles) {
    for (const std::int32_t i : t) indices += std::to_string(i) + " ";
  }
  const std::string n = std::to_string(m.vertices.size());
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         asset + R"(</asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count=")" +
         std::to_string(3 * m.vertices.size()) + "\">" + points +
         R"(</float_array><technique_common><accessor source="#a" count=")" + n +
         R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>)"
         R"(</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count=")" +
         std::to_string(m.triangles.size()) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" + indices +
         R"(</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">)" +
         node +
         R"(<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

class MeshImport : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("presa_mesh_import_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  TriMesh import(const std::string& name, const std::string& contents, const ImportOptions& options = {}) {
    const fs::path file = folder_ / name;
    std::ofstream(file, std::ios::binary) << contents;
    diagnostics_ = {};
    return importMesh(file.string(), options, {"scene.xml", 7, 5}, diagnostics_);
  }
  /// Expects exactly one finding, at the place in the scene that named the mesh.
  void expectFinding(int code, Diagnostic::Severity severity = Diagnostic::Severity::kError) {
    ASSERT_EQ(diagnostics_.all().size(), 1u) << diagnostics_.text();
    const Diagnostic& found = diagnostics_.all()[0];
    EXPECT_EQ(found.code, code) << diagnostics_.text();
    EXPECT_EQ(found.severity, severity);
    EXPECT_EQ(found.where.line, 7);
    EXPECT_NE(found.message.find(folder_.string()), std::string::npos);
  }

  fs::path folder_;
  Diagnostics diagnostics_;
  const TriMesh box_ = makeBox({0.2, 0.4, 0.6});
};

// Seven encodings of one box (indexed or soup, y up or z up) give one welded, closed mesh with the same mass
// properties.
TEST_F(MeshImport, EveryFormatGivesTheSameWeldedMesh) {
  const MassProperties expected = massProperties(box_);
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.obj", obj(box_)},
      {"a.stl", stlText(box_)},
      {"b.stl", stlBinary(box_)},
      {"a.ply", plyText(box_)},
      {"b.ply", plyBinary(box_)},
      {"a.glb", glb(box_)},
      {"a.dae", collada(box_, R"(<unit meter="1"/><up_axis>Z_UP</up_axis>)")}};
  for (const auto& [name, contents] : files) {
    const TriMesh mesh = import(name, contents);
    EXPECT_TRUE(diagnostics_.all().empty()) << diagnostics_.text();
    EXPECT_EQ(mesh.vertices.size(), 8u) << name;
    EXPECT_EQ(mesh.triangles.size(), 12u) << name;
    EXPECT_EQ(mesh.adjacency.size(), 12u) << name;
    const MassProperties found = massProperties(mesh);
    // coordinates pass through single precision: 6e-8 relative each
    EXPECT_NEAR(found.volume, expected.volume, 3e-7 * expected.volume) << name;
    EXPECT_LT((found.inertia - expected.inertia).norm(), 1e-6 * expected.inertia.norm()) << name;
    EXPECT_LT((boundsOf(mesh).high - Vec3(0.1, 0.2, 0.3)).norm(), 1e-7) << name;
  }
}

TEST_F(MeshImport, GltfTextReadsItsBufferBesideIt) {
  std::ofstream(folder_ / "box.bin", std::ios::binary) << gltfData(box_);
  EXPECT_EQ(import("a.gltf", gltfText(box_, R"("uri":"box.bin",)")).triangles.size(), 12u) << diagnostics_.text();
}

// COLLADA states its unit and its up axis; both must be obeyed, and a mirroring node must not turn the mesh inside out.
TEST_F(MeshImport, ColladaUnitsAxesAndMirrorsAreObeyed) {
  const TriMesh z_up = import("a.dae", collada(box_, R"(<unit meter="0.01"/><up_axis>Z_UP</up_axis>)"));
  EXPECT_LT((boundsOf(z_up).high - Vec3(0.001, 0.002, 0.003)).norm(), 1e-9);
  const TriMesh y_up = import("a.dae", collada(box_, R"(<unit meter="1"/><up_axis>Y_UP</up_axis>)"));
  EXPECT_LT((boundsOf(y_up).high - Vec3(0.1, 0.3, 0.2)).norm(), 1e-7);
  const TriMesh mirrored = import("a.dae", collada(box_, "<up_axis>Z_UP</up_axis>", "<scale>-1 1 1</scale>"));
  EXPECT_TRUE(diagnostics_.all().empty()) << diagnostics_.text();
  EXPECT_GT(massProperties(mirrored).volume, 0);
}

TEST_F(MeshImport, ScaleMayMirrorButNotVanish) {
  EXPECT_NEAR(massProperties(import("a.obj", obj(box_), {.scale = {-2, 1, 1}})).volume, 0.096, 1e-7);
  EXPECT_TRUE(diagnostics_.all().empty());
  EXPECT_TRUE(import("a.obj", obj(box_), {.scale = {1, 0, 1}}).triangles.empty());
  expectFinding(312);
}

TEST_F(MeshImport, EachBadFileIsNamedForWhatItIs) {
  const std::string good = obj(box_);
  diagnostics_ = {};
  importMesh((folder_ / "none.obj").string(), {}, {"scene.xml", 7, 5}, diagnostics_);
  expectFinding(301);
  EXPECT_TRUE(import("a.xyz", good).triangles.empty());
  expectFinding(302);
  for (const char* name : {"a.stl", "a.ply", "a.glb", "a.gltf", "a.dae"}) {
    import(name, std::string(5000, '\0'));
    expectFinding(303);
  }
  import("empty.obj", "");
  expectFinding(303);
  import("zeros.obj", std::string(5000, '\0'));
  expectFinding(304);
  import("points.obj", good.substr(0, good.find('f')));
  expectFinding(304);
  import("index.obj", good + "f 1 2 99\n");
  expectFinding(303);
  import("nan.obj", "v 0 nan 0\n" + good + "f 1 2 3\n");
  expectFinding(305);
  EXPECT_NE(diagnostics_.text().find("corner"), std::string::npos);
  import("huge.ply", plyHeader("binary_little_endian", 8, 10000000) + floats(box_.vertices));
  EXPECT_TRUE(diagnostics_.hasErrors());
}

TEST_F(MeshImport, EachBadSurfaceIsNamedForWhatItIs) {
  TriMesh mesh = box_;
  mesh.triangles.pop_back();
  EXPECT_TRUE(import("open.obj", obj(mesh)).triangles.empty());
  expectFinding(309);
  EXPECT_EQ(import("open.obj", obj(mesh), {.must_be_closed = false}).triangles.size(), 11u);
  expectFinding(309, Diagnostic::Severity::kWarning);
  EXPECT_EQ(import("open.obj", obj(mesh), {.must_be_closed = false, .display_only = true}).triangles.size(), 11u);
  EXPECT_TRUE(diagnostics_.all().empty());

  mesh = box_;
  turnInsideOut(mesh);
  EXPECT_GT(massProperties(import("inverted.obj", obj(mesh))).volume, 0);
  expectFinding(311, Diagnostic::Severity::kWarning);

  mesh = box_;
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  import("flipped.obj", obj(mesh));
  expectFinding(310);

  mesh = box_;
  mesh.vertices.emplace_back(1, 1, 1);
  mesh.triangles.push_back({0, 1, 8});
  import("fin.obj", obj(mesh));
  expectFinding(308);
}

// Nine collapsed triangles are dropped with a warning; ten are an error.
TEST_F(MeshImport, FewDegenerateTrianglesAreDroppedManyAreRefused) {
  TriMesh mesh = box_;
  for (int i = 0; i < 9; ++i) mesh.triangles.push_back({0, 0, 1});
  EXPECT_EQ(import("nine.stl", stlBinary(mesh)).triangles.size(), 12u);
  expectFinding(307, Diagnostic::Severity::kWarning);
  mesh.triangles.push_back({2, 3, 2});
  EXPECT_TRUE(import("ten.stl", stlBinary(mesh)).triangles.empty());
  expectFinding(307);
}

// Damaged files end in a finding or in a mesh that passes every check; never in a crash or an exception.
TEST_F(MeshImport, TwoHundredDamagedFilesAreSurvived) {
  const std::vector<std::pair<std::string, std::string>> seeds{{"f.obj", obj(box_)},
                                                               {"f.stl", stlBinary(box_)},
                                                               {"f.ply", plyBinary(box_)},
                                                               {"f.glb", glb(box_)},
                                                               {"f.dae", collada(box_, "")}};
  std::mt19937_64 random(42);
  int refused = 0;
  constexpr int kFiles = unlessSanitized(200, 60);
  for (int i = 0; i < kFiles; ++i) {
    const auto& [name, seed] = seeds[static_cast<std::size_t>(i) % seeds.size()];
    std::string damaged = seed;
    for (std::uint64_t k = 1 + random() % 4; k > 0; --k) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random());
          break;
        case 1:
          damaged.resize(at + 1);
          break;
        case 2:
          damaged.replace(at, std::min<std::size_t>(4, damaged.size() - at), "\xff\xff\xff\x7f");
          break;
        default:
          damaged.insert(at, damaged.substr(random() % damaged.size(), random() % 40));
          break;
      }
    }
    const TriMesh mesh = import(name, damaged);
    EXPECT_EQ(mesh.triangles.empty(), diagnostics_.hasErrors());
    refused += mesh.triangles.empty();
    const MeshReport report = checkMesh(mesh);
    EXPECT_EQ(report.non_finite + report.bad_index + report.degenerate + report.non_manifold + report.open_edges, 0u);
  }
  EXPECT_GT(refused, kFiles / 4);
}

// The files of a scene share a few processes. Where a reader crashes (a binary PLY without the end of its header) or does
// not end (the same as text), the files behind it are read all the same, and each result stands where its file stood.
TEST_F(MeshImport, FilesReadTogetherDoNotDisturbEachOther) {
  const auto headless = [](std::string ply) { return ply.erase(ply.find("end_header"), 11); };
  const std::vector<std::string> contents{obj(makeBox({1, 1, 1})), headless(plyBinary(box_)), headless(plyBinary(box_)),
                                          obj(makeBox({2, 1, 1})), headless(plyText(box_)),   {},
                                          obj(makeBox({3, 1, 1})), obj(makeBox({4, 1, 1}))};
  const std::vector<double> widths{1, 0, 0, 2, 0, 0, 3, 4};  // 0: refused
  std::vector<MeshOrder> orders;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    const std::string name = std::to_string(i) + (contents[i].starts_with("ply") ? ".ply" : ".obj");
    if (!contents[i].empty()) std::ofstream(folder_ / name, std::ios::binary) << contents[i];
    orders.push_back({(folder_ / name).string(), {}, {"scene.xml", static_cast<int>(i) + 1, 1}, false});
  }
  const std::vector<DrawnMesh> read = importMeshes(orders, diagnostics_);
  ASSERT_EQ(read.size(), widths.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    const TriMesh& mesh = read[i].mesh;
    EXPECT_EQ(mesh.triangles.empty() ? 0 : (boundsOf(mesh).high - boundsOf(mesh).low).x(), widths[i]) << i;
  }
  const std::string text = diagnostics_.text();
  for (const char* line : {"scene.xml:2", "scene.xml:3", "scene.xml:5", "scene.xml:6"})
    EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_EQ(diagnostics_.errorCount(), 4u) << text;
  EXPECT_NE(text.find("the reader crashed on it"), std::string::npos) << text;
  EXPECT_NE(text.find("the reader did not finish in time"), std::string::npos) << text;
}

// The amphora of the pinch_and_lift scene has the width that the scene states at the grip.
TEST(Amphora, IsClosedAndEightyMillimetresWideAtTheGrip) {
  Diagnostics diagnostics;
  const TriMesh mesh = importMesh(PRESA_SOURCE_DIR "/config/meshes/amphora.obj", {}, {"scene.xml", 1, 1}, diagnostics);
  EXPECT_TRUE(diagnostics.all().empty()) << diagnostics.text();
  EXPECT_GE(mesh.triangles.size(), 20000u);
  const AxisBox box = boundsOf(mesh);
  EXPECT_NEAR(box.low.z(), -0.07, 1e-6);
  EXPECT_NEAR(box.high.x(), 0.04, 1e-6);
  EXPECT_NEAR(box.low.x(), -0.04, 1e-6);
  for (const Vec3& v : mesh.vertices) {
    if (std::abs(v.x()) > 0.04 - 1e-9) {
      EXPECT_NEAR(v.z(), 0.012, 1e-6);
    }
  }
}

}  // namespace
}  // namespace presa
