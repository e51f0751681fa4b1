#pragma once
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"
#include "framework/scene/run_options.h"

namespace presa {

/// Chooses where a picture goes: the user's choice (window, offscreen, none); if that is empty, a window if the run is
/// watched `live` and there is a display, else off-screen if a file is `drawn`, else none.
RunOptions::View chooseView(const std::string& wanted, bool live, bool drawn);

/// What the user asks of a picture, as typed.
struct PictureArguments {
  std::string camera, size, hud = "full", background = "scene", light = "noon";
  double video_rate = PictureOptions{}.video_rate;
  bool legend = false;
};

/// Adds the options of everything that draws: --camera, --picture-size, --hud, --legend, --background, --light, and
/// --show PART,no-PART…: parts that the picture shows in addition to its defaults, or leaves out.
void addPictureOptions(Command command, PictureArguments& asked, std::vector<std::string>& show);

/// Adds --video-rate, to a command with --video.
void addVideoRate(Command command, PictureArguments& asked);

/// The same as the view takes it, for a picture that goes where `options` says (view, video, screenshot). Errors: E706
/// camera, E707 size, E708 a background that can only be drawn off-screen.
PictureOptions pictureOf(const PictureArguments& asked, const RunOptions& options, Diagnostics& diagnostics);

}  // namespace presa
