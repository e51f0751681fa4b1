#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <osg/LOD>
#include <set>

#include "framework/geometry/model.h"
#include "modules/view_osg/models/model_levels.h"
#include "modules/view_osg/models/model_node.h"
#include "modules/view_osg/models/model_textures.h"
#include "tests/modules/view_osg/png_picture.h"
#include "tests/support/made_model.h"

namespace presa::view {
namespace {

namespace fs = std::filesystem;
using test::Rgb;
using test::written;
using view_test::Color;
using view_test::PngPicture;

constexpr float kEdge = 0.1F;  // of a square [m]

class Models : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("presa_models_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  DrawnMesh load(const std::string& name) {
    Diagnostics found;
    ImportOptions options;
    options.must_be_closed = false, options.display_only = true;
    DrawnMesh drawn = importDrawn((folder_ / name).string(), options, {}, found);
    EXPECT_FALSE(found.hasErrors()) << found.text();
    return drawn;
  }

  /// A picture from -y of a body in the middle, 200 by 200 pixels; a square of 0.1 m is 100 pixels wide. `series`: as films
  /// are drawn, with the shaders for software rendering.
  PngPicture draw(const DrawnMesh& drawn, bool series = false, double distance = kAway) {
    const std::string file = view_test::tempFile("model.png");
    view_test::PinchRun run = view_test::makePinchRun(RunOptions::View::kOffscreen, series ? "" : file);
    Body& body = run.world->scene.bodies[1];
    body.haptic.reset();
    body.physics.reset();
    body.visual = Geometry{MeshRef{}, Pose{}, {}};
    run.world->scene.materials[1].color = kPlain;
    run.world->meshes[1].visual = std::make_shared<const TriMesh>(drawn.mesh);
    run.world->meshes[1].model = drawn.model;
    run.options.picture.hud = PictureOptions::Hud::kOff;
    run.options.picture.width = run.options.picture.height = 200;
    run.options.picture.camera = CameraPlace{{0, -distance, kUp}, {0, 0, kUp}};
    run.options.show = {"no-hips", "no-proxies", "no-cones", "no-forces"};
    const fs::path pictures = folder_ / "series";
    if (series) {
      fs::create_directories(pictures);
      run.options.screenshot_every = 0.5;
      run.options.screenshots = pictures.string();
    }
    view_test::PinchStates states = view_test::makePinchStates(*run.world, {0, 0, kUp});
    states.device = DeviceState();
    states.contacts = ContactExchange();
    const View::Screenshot made = view_test::drawOnce(run, states);
    if (!series) {
      EXPECT_EQ(made.outcome, View::Screenshot::Outcome::kWritten) << made.message;
      return PngPicture(file);
    }
    for (const auto& one : fs::directory_iterator(pictures)) return PngPicture(one.path().string());
    throw std::runtime_error("no picture in the series");
  }

  static constexpr double kUp = 0.3;  // far from the table, whose shadow and grid are elsewhere [m]

  inline static const double kAway = 1 / std::tan(14 * std::numbers::pi / 180) * 0.1;  // field of view: 28 degrees
  const Vec3 kPlain{0.5, 0.25, 0.1};
  fs::path folder_;
};

int farthest(const Color& a, const Color& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

std::string obj(const std::string& material, const fs::path& folder) {
  written(folder / "a.mtl", "newmtl paint\n" + material);
  written(folder / "a.obj", test::objOf(test::frontSquare(kEdge), "a.mtl"));
  return "a.obj";
}

/// Display value of a channel, 0 to 255.
std::uint8_t display(double linear) {
  return static_cast<std::uint8_t>(
      std::lround(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055)));
}

// The material's colour is linear, the map's is that of a display: the same surface, once painted, once mapped. A level
// of rounding in the map, one in the picture. Fine and for software.
TEST_F(Models, AMapIsTheColourThatItShows) {
  const Rgb color{display(0.5), display(0.25), display(0.1)};
  written(folder_ / "c.png", test::png(color));
  const DrawnMesh mapped = load(obj("map_Kd c.png\n", folder_));
  for (const bool series : {false, true}) {
    DrawnMesh plain = mapped;
    plain.model = nullptr;
    const Color a = draw(mapped, series).at(100, 100), b = draw(plain, series).at(100, 100);
    // the plain body has a little more shine: none here, 34 degrees from the mirror direction
    EXPECT_LE(farthest(a, b), 3) << series << ": " << a.r << ' ' << a.g << ' ' << a.b << " / " << b.r << ' ' << b.g
                                 << ' ' << b.b;
  }
}

// Red at the lower left, green at the lower right, blue at the upper left, grey at the upper right; of 100 pixels.
TEST_F(Models, AMapLiesAsTheFileSays) {
  written(folder_ / "c.png", test::png(64, 64, [](std::uint32_t x, std::uint32_t y) {
            const bool right = x >= 32, upper = y < 32;
            return upper ? (right ? Rgb{180, 180, 180} : Rgb{0, 0, 200}) : (right ? Rgb{0, 200, 0} : Rgb{200, 0, 0});
          }));
  test::writeGltf(folder_, "g", test::frontSquare(kEdge),
                  R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0}})", {"c.png"});
  for (const std::string& name : {obj("map_Kd c.png\n", folder_), std::string("g.gltf")}) {
    for (const bool series : {false, true}) {
      const PngPicture picture = draw(load(name), series);
      const auto is = [&](int x, int y, const char* which) {
        const Color c = picture.at(x, y);
        const bool red = c.r > 2 * c.g && c.r > 2 * c.b, green = c.g > 2 * c.r && c.g > 2 * c.b;
        const bool blue = c.b > 2 * c.r && c.b > 2 * c.g, grey = std::abs(c.r - c.g) < 40 && c.r > 80;
        const std::map<std::string, bool> all{{"red", red}, {"green", green}, {"blue", blue}, {"grey", grey}};
        EXPECT_TRUE(all.at(which)) << name << series << ' ' << which << ": " << c.r << ' ' << c.g << ' ' << c.b;
      };
      is(75, 125, "red"), is(125, 125, "green"), is(75, 75, "blue"), is(125, 75, "grey");
    }
  }
}

// A normal map that leans every normal by 30 degrees towards +x makes the surface as bright as its share of the key light
// then is: light = 0.98 (key) + sky, by the formula of daylight() for a surface that faces -y.
TEST_F(Models, ANormalMapTurnsTheSurfaceToTheLight) {
  const auto map = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    const auto c = [](double x) { return static_cast<std::uint8_t>(std::lround(127.5 * (1 + x))); };
    written(folder_ / "n.png", test::png({c(std::sin(a)), c(0), c(std::cos(a))}));
    return load(obj("Kd 0.3 0.3 0.3\nnorm n.png\n", folder_));
  };
  const Vec3 key = Vec3(0.38, -0.42, 0.95).normalized(), fill = Vec3(0.8, -0.3, 0.25).normalized();
  const auto light = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    const Vec3 n(std::sin(a), -std::cos(a), 0);
    const double sky = (0.16 + 0.30) / 2;
    return 0.3 * (0.98 * std::max(0.0, n.dot(key)) + sky + 0.08 * std::max(0.0, n.dot(fill)));
  };
  for (const double degrees : {-40.0, 0.0, 30.0}) {
    const Color c = draw(map(degrees)).at(100, 100);
    EXPECT_NEAR(c.r, display(light(degrees)), 6) << degrees;  // roughness 0.9 adds up to 0.015 * key
  }
  const int flat = draw(map(0), true).at(100, 100).r, turned = draw(map(30), true).at(100, 100).r;
  EXPECT_NEAR(turned - flat, display(light(30)) - display(light(0)), 12);  // in display space: an approximation
}

TEST_F(Models, ColoursOfVerticesAreDrawn) {
  written(folder_ / "p.ply",
          "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
          "property list uchar int vertex_indices\nend_header\n-0.05 0 -0.05 200 0 0\n0.05 0 -0.05 0 200 0\n"
          "0.05 0 0.05 0 200 0\n-0.05 0 0.05 200 0 0\n3 0 1 2\n3 0 2 3\n");
  const DrawnMesh drawn = load("p.ply");
  for (const bool series : {false, true}) {
    const PngPicture picture = draw(drawn, series);
    const Color left = picture.at(56, 100), right = picture.at(144, 100);
    EXPECT_GT(left.r, 2 * left.g);
    EXPECT_GT(right.g, 2 * right.r);
  }
}

/// A cylinder mantle with a texture seam, one meter high, its ends open.
ModelSurface mantle() {
  const auto turn = [](float u) { return 2 * std::numbers::pi_v<float> * (u < 1 ? u : 0); };
  const test::Sheet s = test::sheet(
      200, 100,
      [&](float u, float v) {
        return std::array<float, 3>{std::cos(turn(u)), std::sin(turn(u)), v};
      },
      [&](float u, float) {
        return std::array<float, 3>{std::cos(turn(u)), std::sin(turn(u)), 0};
      });
  ModelSurface surface;
  for (std::size_t v = 0; v < s.places.size(); ++v) surface.vertices.push_back({s.places[v], s.normals[v], s.at[v]});
  surface.corners = s.corners;
  surface.parts.push_back(
      {0, static_cast<std::uint32_t>(s.places.size()), 0, static_cast<std::uint32_t>(s.corners.size()), {}});
  return surface;
}

// Each level is a quarter; its error is the sagitta of its chords; between the two rims no edge has only one triangle
// when corners in one place count as one: no seam has torn.
TEST(ModelLevels, KeepSeamsClosedAndTellTheirError) {
  const ModelSurface surface = mantle();
  const std::vector<std::uint32_t> places = placesOf(surface.vertices);
  const std::vector<ModelLevel> levels = levelsOf(surface);
  ASSERT_GE(levels.size(), 3u);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double sagitta = 0;
    for (std::size_t c = 0; c < levels[i].corners[0].size(); ++c) {
      const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
      const std::uint32_t a = levels[i].corners[0][c], b = levels[i].corners[0][next];
      ++edges[std::minmax(places[a], places[b])];
      const auto& p = surface.vertices[a].position;
      const auto& q = surface.vertices[b].position;
      sagitta = std::max(sagitta, 1 - std::hypot(p[0] + q[0], p[1] + q[1]) / 2.0);
    }
    for (const auto& [edge, count] : edges) {
      const auto height = [&](std::uint32_t place) {
        for (std::size_t v = 0; v < places.size(); ++v)
          if (places[v] == place) return surface.vertices[v].position[2];
        return -1.0F;
      };
      if (count % 2 == 0) continue;  // of both sides; four where two layers touch
      EXPECT_EQ(height(edge.first), height(edge.second)) << "level " << i;  // along a rim
      EXPECT_TRUE(height(edge.first) == 0 || height(edge.first) == 1);
    }
    if (i == 0) continue;
    EXPECT_LT(levels[i].triangles, levels[i - 1].triangles / 2);
    EXPECT_GT(levels[i].error, levels[i - 1].error);
    // the vertices of the finest level lie within 1 % of the chords' middles, and diagonals are not farther than chords
    EXPECT_NEAR(levels[i].error, sagitta, 0.1 * sagitta);
  }
}

// A level comes where its error is half a pixel: by its own formula, from OSG's pixel size, the diameter of the sphere.
TEST_F(Models, LevelsChangeWhereTheirErrorIsHalfAPixel) {
  const ModelSurface surface = mantle();
  auto model = std::make_shared<Model>();
  model->vertices = surface.vertices, model->corners = surface.corners, model->parts = surface.parts;
  const osg::ref_ptr<osg::Node> node = modelNode(model, false);
  const auto* lod = dynamic_cast<const osg::LOD*>(node.get());
  ASSERT_NE(lod, nullptr);
  const std::vector<ModelLevel> levels = levelsOf(surface);
  ASSERT_EQ(lod->getNumChildren(), levels.size());
  for (unsigned i = 0; i + 1 < levels.size(); ++i) {
    const double pixels = lod->getMinRange(i), diameter = 2.0 * lod->getBound().radius();
    EXPECT_NEAR(levels[i + 1].error / diameter * pixels, 0.5, 1e-4);
    EXPECT_EQ(lod->getMaxRange(i + 1), lod->getMinRange(i));
  }
}

TEST_F(Models, OnePictureServesAllScalesOfAFile) {
  written(folder_ / "c.png", test::png({10, 20, 30}));
  const std::string name = obj("map_Kd c.png\n", folder_);
  Diagnostics found;
  const auto scaled = [&](double by) {
    ImportOptions options;
    options.must_be_closed = false, options.display_only = true, options.scale = Vec3::Constant(by);
    return importDrawn((folder_ / name).string(), options, {}, found).model;
  };
  const auto small = scaled(1), large = scaled(3);
  ASSERT_TRUE(small && large) << found.text();
  const osg::ref_ptr<osg::Texture2D> texture = textureOf(*small, 0, TextureUse::kColor);
  EXPECT_EQ(texture, textureOf(*large, 0, TextureUse::kColor));
  EXPECT_EQ(texture->getImage(), imageOf(*large, 0).get());
  EXPECT_EQ(texture->getImage(), textureOf(*small, 0, TextureUse::kQuickColor)->getImage());
}

TEST_F(Models, ADamagedPictureIsAnError) {
  const std::string whole = test::png({1, 2, 3});
  written(folder_ / "c.png", whole.substr(0, whole.size() - 20));
  const DrawnMesh drawn = load(obj("map_Kd c.png\n", folder_));
  try {
    modelNode(drawn.model, false);
    FAIL() << "a damaged picture was drawn";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("E266"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace presa::view
