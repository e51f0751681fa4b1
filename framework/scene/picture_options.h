#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"

namespace presa {

/// A side from which a picture shows bodies and fingers, as near as all of them fit; the names of `--camera`.
enum class ViewSide : std::size_t {
  kFront,  ///< from -y, level
  kBack,   ///< from +y, level
  kLeft,   ///< from -x, level
  kRight,  ///< from +x, level
  kTop,    ///< from +z, with +y upwards in the picture
  kIso     ///< between front, right and top, with equal angles to all three
};
/// By ViewSide.
inline constexpr std::array<std::string_view, 6> kViewSideNames{"front", "back", "left", "right", "top", "iso"};

/// A camera at `eye` that looks at `target` [m]. +z is upwards in the picture, +y where it looks straight up or down.
struct CameraPlace {
  Vec3 eye = Vec3::Zero(),    ///< in W [m]
      target = Vec3::Zero();  ///< in W, in the middle of the picture [m]
};
inline constexpr double kCameraNearest = 0.01,  ///< shortest distance from eye to target [m]
    kCameraFarthest = 500;                      ///< longest distance from eye to target [m]
inline constexpr double kCameraReach = 10'000;  ///< of each coordinate, from the origin [m]

inline constexpr int kPictureSmallest = 64,  ///< shortest width or height [pixel]
    kPictureLargest = 8192;                  ///< longest width or height [pixel]

/// How a picture looks, apart from its parts (RunOptions::show). Each default changes nothing and costs nothing.
struct PictureOptions {
  /// How much text stands over the picture.
  enum class Hud {
    kOff,      ///< nothing but what is asked for by name
    kMinimal,  ///< scene, time and a scale bar
    kFull
  };
  /// What is behind bodies and fingers.
  enum class Background {
    kScene,       ///< floor and sky
    kWhite,       ///< neither of them
    kTransparent  ///< neither of them; PNG with alpha
  };
  std::optional<std::variant<ViewSide, CameraPlace>> camera{};  ///< none: the view's own
  int width = 1280,                                             ///< of a picture, and of a window when it opens [pixel]
      height = 720;                                             ///< the same [pixel]
  double video_rate = 30;                                       ///< pictures of a video in a simulated second
  Hud hud = Hud::kFull;                                         ///< text over the picture
  bool legend = false;                                          ///< explains arrows, cones and colours
  Background background = Background::kScene;                   ///< behind bodies and fingers
  /// Time of day.
  enum class Light {
    kNoon,
    kEvening  ///< a low, warm sun and long shadows
  };
  Light light = Light::kNoon;  ///< of scenes out of doors; other scenes have the light of a room
};

/// The value of `--camera`: a name of kViewSideNames, or EYE:TARGET as x,y,z:x,y,z [m]. Error: E706.
std::optional<std::variant<ViewSide, CameraPlace>> parseCamera(const std::string& text, Diagnostics& diagnostics);
/// The same text for a place, to 0.01 mm.
std::string cameraText(const CameraPlace& place);

/// Sets width and height from the value of `--picture-size`: WxH [pixel]. Error: E707.
void parsePictureSize(const std::string& text, PictureOptions& options, Diagnostics& diagnostics);

}  // namespace presa
