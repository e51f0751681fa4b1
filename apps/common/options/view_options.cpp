#include "apps/common/options/view_options.h"

#include <cstdlib>

#include "framework/core/diagnostics/printable.h"
#include "framework/session/shown_parts.h"

namespace presa {

RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn) {
  if (wanted == "window") return RunOptions::View::kWindow;
  if (wanted == "offscreen") return RunOptions::View::kOffscreen;
  if (wanted == "none") return RunOptions::View::kNone;
  const char* display = std::getenv("DISPLAY");
  if (live && display != nullptr && *display != '\0') return RunOptions::View::kWindow;
  return drawn ? RunOptions::View::kOffscreen : RunOptions::View::kNone;
}

void addVideoRate(Command command, PictureArguments& asked) {
  command
      .option("--video-rate", asked.video_rate,
              "pictures of a video for each simulated second, 1 to 240; above the rate of the view (<rates view>) they "
              "repeat")
      .within(1, 240)
      .showDefault();
}

void addPictureOptions(Command command, PictureArguments& asked, std::vector<std::string>& show) {
  command
      .option(
          "--camera", asked.camera,
          "where from: EYE:TARGET in metres, as 0.5,-0.8,0.4:0,0,0.1, or front, back, left, right, top or iso, as\n"
          "near as bodies and fingers fit (default: chosen so that fingers are seen); the key c of the window tells\n"
          "its own")
      .kind("EYE:TARGET");
  command
      .option("--picture-size,--video-size", asked.size,
              "pixels of a picture, a video, or the window at first (default: 1280x720)")
      .kind("WxH");
  command
      .option("--hud", asked.hud,
              "figures over the scene: off, minimal (scene, time, scale bar) or full; what other options ask for stays")
      .oneOf({"off", "minimal", "full"})
      .showDefault();
  command.flag("--legend", asked.legend, "explain arrows, cones and colours in the picture, large enough for print");
  command
      .option("--background", asked.background,
              "scene, or without floor and sky: white, or transparent (PNG with alpha); off-screen pictures only")
      .oneOf({"scene", "white", "transparent"})
      .showDefault();
  command.option("--light", asked.light, "time of day out of doors: noon, or evening with long shadows")
      .oneOf({"noon", "evening"})
      .showDefault();
  std::string parts;
  for (const std::string_view part : kShownPartNames) (parts += parts.empty() ? "" : ", ") += part;
  command
      .option("--show", show,
              "parts that the picture shows in addition to its default, separated by commas: " + parts +
                  ";\nno-PART leaves one out")
      .separatedBy(',')
      .oneValueEach();
}

PictureOptions pictureOf(const PictureArguments& asked, const RunOptions& options, Diagnostics& diagnostics) {
  PictureOptions picture;
  if (!asked.camera.empty()) picture.camera = parseCamera(asked.camera, diagnostics);
  if (!asked.size.empty()) parsePictureSize(asked.size, picture, diagnostics);
  if (asked.hud != "full") picture.hud = asked.hud == "off" ? PictureOptions::Hud::kOff : PictureOptions::Hud::kMinimal;
  picture.legend = asked.legend;
  picture.video_rate = asked.video_rate;
  if (asked.video_rate != PictureOptions{}.video_rate && options.video.empty())
    diagnostics.error(123, {"--video-rate", 0, 0}, "says nothing without a video", "add --video FILE.mp4");
  if (asked.light == "evening") picture.light = PictureOptions::Light::kEvening;
  if (asked.background == "scene") return picture;
  const bool transparent = asked.background == "transparent";
  picture.background = transparent ? PictureOptions::Background::kTransparent : PictureOptions::Background::kWhite;
  std::string trouble;
  if (options.view == RunOptions::View::kWindow)
    trouble = "a window always shows floor and sky";
  else if (!options.video.empty())
    trouble = "a video always shows floor and sky";
  else if (transparent && !options.screenshot.empty() && !options.screenshot.ends_with(".png"))
    trouble = "only a PNG can be transparent, found --screenshot " + printable(options.screenshot);
  if (!trouble.empty())
    diagnostics.error(708, {"--background", 0, 0}, trouble + ", found --background " + asked.background,
                      "a still picture: --view offscreen --screenshot FILE.png");
  return picture;
}

}  // namespace presa
