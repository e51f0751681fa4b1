#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/common/options/command_line.h"
#include "apps/common/options/view_options.h"
#include "framework/session/load_world.h"
#include "framework/session/view.h"

namespace presa {

/// A run as the command line asks for it.
struct RunArguments {
  Inputs inputs;
  RunOptions options;
  bool lockstep = false, realtime = false, quiet = false, plug_ins = false;
  bool traced = true;  ///< samples are kept for a report
  std::string view;    ///< empty: automatic
  PictureArguments picture;
  double speed = 0;   ///< 0: default
  double memory = 0;  ///< for distance fields [MiB]; 0: what the scene allows
  std::string summary, report;
};

/// The options of a run, all but its scene. `arguments` must live until the program ends.
void addRunOptions(Command command, RunArguments& arguments);

/// Where the picture of the run goes.
RunOptions::View viewOf(const RunArguments& arguments);

/// Scenes that the window of a run offers, and which of them runs. None: no menu.
struct SceneOffer {
  std::vector<OfferedScene> scenes;
  std::size_t now = 0;
};

struct RunEnd {
  int status = 0;                      ///< exit status
  bool complete = false;               ///< it came to its end: no fault, and nobody stopped it
  std::optional<SceneWish> wish = {};  ///< what the user of the window wants to go on with
};

/// Loads a scene, runs it at the terminal, and writes what was asked for. Findings go to stderr. Thread: main.
RunEnd runScene(RunArguments arguments, SceneOffer offer = {});

}  // namespace presa
