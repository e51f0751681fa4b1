#pragma once
#include <string>
#include <vector>

#include "apps/presa/remote/cave.h"
#include "framework/scene/run_options.h"

namespace presa {

/// Options of `presa view --join`.
struct ViewerSettings {
  std::string scene;                ///< the viewer's own scene file; empty: the run's scene
  std::vector<std::string> meshes;  ///< folders, as of bus::takeFromMeshStore
  BusSettings bus;
  double wait = 10;     ///< longest wait for a run [s]
  double duration = 0;  ///< wall-clock time [s]; 0: to the end of the run
  RunOptions::View view = RunOptions::View::kNone;
  std::string screenshot;
  double screenshot_time = -1;    ///< of the run [s]; -1: when the viewer ends
  std::vector<std::string> show;  ///< as RunOptions
  PictureOptions picture;
  bool quiet = false;
  bool guide = false;  ///< this viewer guides the assembly of the run
  CaveSettings cave;
};

inline constexpr int kExitNoRun = 3;

/// Joins a run, draws it, and reports on the terminal; returns the exit status. Throws InputError.
int showRemote(const ViewerSettings& settings);

}  // namespace presa
