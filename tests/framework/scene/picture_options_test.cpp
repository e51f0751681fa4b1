#include "framework/scene/picture_options.h"

#include <gtest/gtest.h>

namespace presa {
namespace {

std::string troubleWith(const std::string& camera) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parseCamera(camera, diagnostics).has_value()) << camera;
  return diagnostics.text();
}

// Each kind of wrong camera is named with what was found, and the help says what is allowed.
TEST(PictureOptions, RefuseWrongCameras) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "neither a name"},
      {"frnt", "did you mean"},
      {"0.3,0.1", "neither a name nor an eye and a target, found '0.3,0.1'"},
      {"0.3,0.1:0,0,0", "the eye needs three numbers x,y,z, found '0.3,0.1'"},
      {"1,2,3,4:0,0,0", "the eye needs three numbers"},
      {"1,2,3:0,0", "the target needs three numbers x,y,z, found '0,0'"},
      {"1,2,3:", "the target needs three numbers"},
      {"1,2,3:0,0,0:0,0,1", "neither a name"},
      {"nan,0,0:0,0,0", "the eye has 'nan', which is not a finite number"},
      {"0,inf,0:0,0,0", "the eye has 'inf', which is not a finite number"},
      {"0,0,0:0,1e400,0", "the target has '1e400', which is not a finite number"},
      {"a,0,0:0,0,0", "the eye has 'a'"},
      {"1,2,3m:0,0,0", "the eye has '3m'"},
      {"1, 2,3:0,0,0", "the eye has ' 2'"},
      {"20000,0,0:20001,0,0", "beyond 10 km"},
      {"1,2,3:1,2,3", "eye and target are the same point"},
      {"0,0,0.001:0,0,0", "0.01 to 500 m apart, found 0.001 m"},
      {"0,0,501:0,0,0", "0.01 to 500 m apart, found 501 m"}};
  for (const auto& [camera, words] : cases) {
    const std::string text = troubleWith(camera);
    EXPECT_TRUE(text.starts_with("--camera: error[E706]: ")) << text;
    EXPECT_NE(text.find(words), std::string::npos) << camera << ": " << text;
    EXPECT_NE(text.find("EYE:TARGET in metres"), std::string::npos) << text;
  }
}

TEST(PictureOptions, TakeNamedSidesAndPlaces) {
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < kViewSideNames.size(); ++i)
    EXPECT_EQ(std::get<ViewSide>(*parseCamera(std::string(kViewSideNames[i]), diagnostics)), static_cast<ViewSide>(i));
  const auto place = std::get<CameraPlace>(*parseCamera("-0.5,.25,1e-1:0,0,-0.1", diagnostics));
  EXPECT_EQ(place.eye, Vec3(-0.5, 0.25, 0.1));
  EXPECT_EQ(place.target, Vec3(0, 0, -0.1));
  EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.text();
}

// The text that the window tells gives the same camera again, to the 0.01 mm that it promises.
TEST(PictureOptions, TellACameraInTheSameSyntax) {
  EXPECT_EQ(cameraText({{0.5, -0.8, 0.4}, {0, -1e-9, 0.1}}), "0.5,-0.8,0.4:0,0,0.1");
  const CameraPlace place{{-12.345678, 1.0 / 3, 100}, {0.000014, -0.2, 7}};
  Diagnostics diagnostics;
  const auto again = std::get<CameraPlace>(*parseCamera(cameraText(place), diagnostics));
  EXPECT_LE((again.eye - place.eye).cwiseAbs().maxCoeff(), 0.5e-5 * (1 + 1e-9));
  EXPECT_LE((again.target - place.target).cwiseAbs().maxCoeff(), 0.5e-5 * (1 + 1e-9));
}

TEST(PictureOptions, RefuseWrongSizes) {
  for (const char* size : {"", "640", "640x", "x360", "640x360x2", "640X360", "6.4x360", "-640x360", "63x360",
                           "640x8193", "99999999999x360", "640 x360"}) {
    Diagnostics diagnostics;
    PictureOptions options;
    parsePictureSize(size, options, diagnostics);
    EXPECT_TRUE(diagnostics.text().starts_with("--picture-size: error[E707]: ")) << size << diagnostics.text();
    EXPECT_NE(diagnostics.text().find("each from 64 to 8192"), std::string::npos) << diagnostics.text();
    EXPECT_EQ(options.width, 1280);
  }
  for (const auto& [size, width, height] : {std::tuple{"64x8192", 64, 8192}, {"1920x1080", 1920, 1080}}) {
    Diagnostics diagnostics;
    PictureOptions options;
    parsePictureSize(size, options, diagnostics);
    EXPECT_FALSE(diagnostics.hasErrors());
    EXPECT_EQ(options.width, width);
    EXPECT_EQ(options.height, height);
  }
}

}  // namespace
}  // namespace presa
