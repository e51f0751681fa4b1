#include "framework/geometry/model.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>

#include "framework/geometry/image_size.h"
#include "tests/support/made_model.h"

namespace presa {
namespace {

namespace fs = std::filesystem;
using test::Rgb;
using test::written;

class ModelFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("presa_model_" + std::to_string(getpid())) / "in";
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_.parent_path()); }

  DrawnMesh load(const std::string& name) {
    found_ = {};
    ImportOptions options;
    options.must_be_closed = false, options.display_only = true;
    return importDrawn((folder_ / name).string(), options, {"scene.xml", 7, 3}, found_);
  }
  /// An OBJ square whose material has these lines.
  DrawnMesh loadObj(const std::string& lines) {
    written(folder_ / "a.mtl", "newmtl paint\n" + lines);
    written(folder_ / "a.obj", test::objOf(test::frontSquare(1), "a.mtl"));
    return load("a.obj");
  }
  void expectError(int code, const std::string& text) {
    ASSERT_TRUE(found_.hasErrors());
    EXPECT_EQ(found_.all().front().code, code);
    EXPECT_EQ(found_.all().front().where.line, 7);
    EXPECT_NE(found_.all().front().message.find(text), std::string::npos) << found_.text();
  }

  fs::path folder_;
  Diagnostics found_;
};

TEST_F(ModelFile, ObjHasItsLibrarysColourAndMaps) {
  written(folder_ / "c.png", test::png({10, 20, 30}));
  written(folder_ / "n.png", test::png({128, 128, 255}));
  const DrawnMesh colored = loadObj("Kd 0.5 0.25 0.125\n");
  ASSERT_TRUE(colored.model) << found_.text();
  EXPECT_TRUE(colored.model->parts.at(0).material.color.isApprox(Vec3(0.5, 0.25, 0.125), 1e-6));
  const DrawnMesh mapped = loadObj("Kd 0.5 0.5 0.5\nmap_Kd c.png\nnorm n.png\n");
  ASSERT_TRUE(mapped.model) << found_.text();
  const ModelMaterial& material = mapped.model->parts.at(0).material;
  EXPECT_EQ(material.color, Vec3::Ones());  // beside a map, exporters leave any colour
  ASSERT_GE(material.color_map, 0);
  ASSERT_GE(material.normal_map, 0);
  EXPECT_EQ(mapped.model->textures[static_cast<std::size_t>(material.color_map)].name, "c.png");
  EXPECT_EQ(mapped.model->textures[static_cast<std::size_t>(material.normal_map)].width, 4);
  EXPECT_EQ(mapped.mesh.triangles.size(), 2u);
}

TEST_F(ModelFile, GltfHasFactorsAndMapsAndIsTurnedUpright) {
  for (const char* name : {"c.png", "n.png", "r.png"}) written(folder_ / name, test::png({90, 90, 90}));
  test::writeGltf(folder_, "g", test::frontSquare(1),
                  R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0},)"
                  R"("metallicRoughnessTexture":{"index":2},"roughnessFactor":0.7,"metallicFactor":0.2},)"
                  R"("normalTexture":{"index":1,"scale":0.5}})",
                  {"c.png", "n.png", "r.png"});
  const DrawnMesh drawn = load("g.gltf");
  ASSERT_TRUE(drawn.model) << found_.text();
  const ModelMaterial& material = drawn.model->parts.at(0).material;
  EXPECT_NEAR(material.color.x(), 0.5, 1e-6);
  EXPECT_NEAR(material.roughness, 0.7, 1e-6);
  EXPECT_NEAR(material.metallic, 0.2, 1e-6);
  EXPECT_NEAR(material.relief, 0.5, 1e-6);
  EXPECT_TRUE(material.color_map >= 0 && material.normal_map >= 0 && material.roughness_map >= 0);
  for (const ModelVertex& v : drawn.model->vertices) {
    EXPECT_FLOAT_EQ(v.normal[1], -1);
    EXPECT_FLOAT_EQ(v.at[0], v.position[0] + 0.5F);  // u to the right, v upwards
    EXPECT_FLOAT_EQ(v.at[1], v.position[2] + 0.5F);
  }
}

// PLY has colours as a display shows them: 188 is half of the light (sRGB: 0.5029).
TEST_F(ModelFile, PlyHasColoursOfItsVertices) {
  written(folder_ / "p.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0 0 188 0 255\n1 0 0 188 0 255\n0 0 1 188 0 255\n3 0 "
          "1 2\n");
  const DrawnMesh drawn = load("p.ply");
  ASSERT_TRUE(drawn.model) << found_.text();
  EXPECT_NEAR(drawn.model->vertices.at(0).color[0], 0.5029, 1e-4);
  EXPECT_EQ(drawn.model->vertices.at(0).color[1], 0);
  EXPECT_EQ(drawn.model->vertices.at(0).color[2], 1);
}

TEST_F(ModelFile, WithoutColoursThereIsNoModel) {
  written(folder_ / "a.obj", test::objOf(test::frontSquare(1), ""));
  EXPECT_FALSE(load("a.obj").model);
  EXPECT_EQ(found_.all().size(), 0u) << found_.text();
}

TEST_F(ModelFile, ScaleMirrorsTheModelLikeTheMesh) {
  loadObj("Kd 1 0 0\n");
  ImportOptions options;
  options.must_be_closed = false, options.display_only = true, options.scale = {1, -2, 1};
  const DrawnMesh drawn = importDrawn((folder_ / "a.obj").string(), options, {}, found_);
  ASSERT_TRUE(drawn.model);
  EXPECT_FLOAT_EQ(drawn.model->vertices[0].normal[1], 1);
  const auto place = [&](std::size_t c) {
    const auto& p = drawn.model->vertices[drawn.model->corners[c]].position;
    return Vec3(p[0], p[1], p[2]);
  };
  EXPECT_GT((place(1) - place(0)).cross(place(2) - place(0)).y(), 0);  // counter-clockwise from outside
}

TEST_F(ModelFile, TellsWhichTextureIsMissingOrHostile) {
  loadObj("map_Kd stone.jpg\n");
  expectError(260, "texture 'stone.jpg' is missing");
  written(folder_.parent_path() / "secret.png", test::png({1, 2, 3}));
  loadObj("map_Kd ../secret.png\n");
  expectError(692, "outside the folder");
  written(folder_ / "t.png", "GIF89a");
  loadObj("map_Kd t.png\n");
  expectError(261, "neither a PNG nor a JPEG");
  written(folder_ / "t.png", test::pngHead(100'000, 100'000));
  loadObj("map_Kd t.png\n");
  expectError(262, "100000 by 100000 pixels");
  fs::remove(folder_ / "t.png");
  fs::create_directory(folder_ / "t.png");
  loadObj("map_Kd t.png\n");
  expectError(260, "is a directory");
  fs::remove(folder_ / "t.png");
  ASSERT_EQ(mkfifo((folder_ / "t.png").c_str(), 0600), 0);
  loadObj("map_Kd t.png\n");
  expectError(690, "is a named pipe");
}

// A glTF names its textures by URIs, and may hold them itself.
TEST_F(ModelFile, TexturesOfGltfAreLookedAtAsThoseOfObj) {
  const fs::path secret = folder_.parent_path() / "secret.png";
  written(secret, test::png({1, 2, 3}));
  fs::create_symlink(secret, folder_ / "link.png");
  const auto loadUri = [&](const std::string& uri) {
    test::writeGltf(folder_, "g", test::frontSquare(1), R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                    {uri});
    EXPECT_FALSE(load("g.gltf").model);
  };
  for (const std::string& uri : {std::string("../secret.png"), secret.string(), std::string("link.png")}) {
    loadUri(uri);
    expectError(692, "outside the folder");
  }
  loadUri("%2e%2e/secret.png");  // decoded it would lead out of the folder
  ASSERT_TRUE(found_.hasErrors());
  EXPECT_TRUE(found_.all()[0].code == 692 || found_.all()[0].code == 260) << found_.text();
  loadUri("gone.png");
  expectError(260, "missing");
  // 100 000 by 100 000 pixels, inside the file
  loadUri("data:image/png;base64,iVBORw0KGgoAAAANSUhEUgABhqAAAYagCAIAAAA=");
  expectError(262, "100000 by 100000 pixels");
}

TEST_F(ModelFile, TexturesThatNoPartHasAreNotLookedFor) {
  written(folder_ / "c.png", test::png({10, 20, 30}));
  const DrawnMesh drawn = loadObj("map_Kd c.png\n\nnewmtl unused\nmap_Kd gone.png\n");
  ASSERT_TRUE(drawn.model) << found_.text();
  ASSERT_EQ(drawn.model->textures.size(), 1u);
  EXPECT_EQ(drawn.model->textures[0].name, "c.png");
  EXPECT_EQ(drawn.model->parts.at(0).material.color_map, 0);
}

// A body that is felt and drawn by one file, whose triangles face inwards.
TEST_F(ModelFile, AModelIsTurnedWithItsMesh) {
  for (const char* normal : {"-1", "1"}) {  // as the triangles, and as the surface
    const auto corner = [&](const char* at, int x, int y, int z) {
      const auto n = [&](int side) { return std::to_string(side * std::atoi(normal)) + " "; };
      return std::string(at) + " " + n(x) + n(y) + n(z) + "255 0 0\n";
    };
    written(folder_ / "t.ply",
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 4\n"
            "property list uchar int vertex_indices\nend_header\n" +
                corner("0 0 0", -1, -1, -1) + corner("1 0 0", 1, 0, 0) + corner("0 1 0", 0, 1, 0) +
                corner("0 0 1", 0, 0, 1) + "3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    found_ = {};
    const DrawnMesh drawn = importDrawn((folder_ / "t.ply").string(), {.must_be_closed = true}, {}, found_);
    ASSERT_TRUE(drawn.model) << found_.text();
    EXPECT_EQ(found_.all().at(0).code, 311);
    const Model& model = *drawn.model;
    for (std::size_t c = 0; c < model.corners.size(); c += 3) {
      const auto at = [&](std::size_t i) {
        return Eigen::Map<const Eigen::Vector3f>(model.vertices[model.corners[c + i]].position.data());
      };
      const Eigen::Vector3f outwards = (at(0) + at(1) + at(2)) / 3 - Eigen::Vector3f::Constant(0.2F);
      EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(outwards), 0);
    }
    EXPECT_GT(model.vertices[1].normal[0], 0);
  }
}

TEST_F(ModelFile, AllTexturesTogetherHaveALimit) {
  std::string lines;
  std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 0 1\nvt 0 0\n";
  for (int i = 0; i < 9; ++i) {
    const std::string n = std::to_string(i);
    written(folder_ / (n + ".png"), test::pngHead(4096, 4096));
    lines += "newmtl m" + n + "\nmap_Kd " + n + ".png\n";
    obj += "usemtl m" + n + "\nf 1/1 2/1 3/1\n";
  }
  written(folder_ / "a.mtl", lines);
  written(folder_ / "a.obj", obj);
  load("a.obj");
  expectError(262, "9 textures have 144 million pixels");
}

TEST_F(ModelFile, WarnsOfWhatIsNotDrawn) {
  written(folder_ / "a.obj", test::objOf(test::frontSquare(1), "gone.mtl"));
  EXPECT_FALSE(load("a.obj").mesh.triangles.empty());
  ASSERT_EQ(found_.all().size(), 1u) << found_.text();
  EXPECT_EQ(found_.all().front().code, 264);
  written(folder_ / "t.png", test::png({1, 2, 3}));
  written(folder_ / "a.mtl", "newmtl paint\nmap_Kd t.png\n");
  written(folder_ / "a.obj", "mtllib a.mtl\nusemtl paint\nv 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const DrawnMesh drawn = load("a.obj");
  ASSERT_TRUE(drawn.model);
  EXPECT_EQ(drawn.model->parts[0].material.color_map, -1);
  ASSERT_EQ(found_.all().size(), 1u) << found_.text();
  EXPECT_EQ(found_.all().front().code, 263);
}

TEST(ImageSize, ReadsHeadsAndNothingElse) {
  const auto size = imageSize(test::pngHead(640, 480));
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 640u);
  EXPECT_EQ(size->height, 480u);
  // JPEG: SOI, APP0 of 4 bytes, SOF2 with 300 rows of 500
  const std::string jpeg("\xff\xd8\xff\xe0\0\x04zz\xff\xc2\0\x0b\x08\x01\x2c\x01\xf4\x03", 18);
  const auto photo = imageSize(jpeg);
  ASSERT_TRUE(photo);
  EXPECT_EQ(photo->width, 500u);
  EXPECT_EQ(photo->height, 300u);
  for (std::size_t cut = 0; cut < 17; ++cut) EXPECT_FALSE(imageSize(jpeg.substr(0, cut))) << cut;
  for (const char marker : {'\x01', '\xd0', '\xd9', '\xda'})  // before the frame, as if they had a length
    EXPECT_FALSE(imageSize(std::string("\xff\xd8\xff") + marker + std::string("\0\2", 2) + jpeg.substr(2)));
  EXPECT_FALSE(imageSize(test::pngHead(0, 480)));
  EXPECT_FALSE(imageSize(std::string("\xff\xd8\xff\xe0\0\0zzzzzzzz", 14)));  // a segment shorter than its length
}

}  // namespace
}  // namespace presa
