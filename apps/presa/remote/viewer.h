#pragma once
#include <string>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// What `presa view --join` was asked for.
struct ViewerSettings {
  std::string scene;                ///< own scene file; empty: the run's
  std::vector<std::string> meshes;  ///< folders, as of bus::takeFromShelf
  BusSettings bus;
  double wait = 10;     ///< for a run [s]
  double duration = 0;  ///< wall [s]; 0: to the end of the run
  RunOptions::View view = RunOptions::View::kNone;
  std::string screenshot;
  double screenshot_time = -1;    ///< of the run [s]; -1: when the viewer ends
  std::vector<std::string> show;  ///< as RunOptions
  bool quiet = false;
};

inline constexpr int kExitNoRun = 3;

/// Joins, draws, and says on the terminal what it sees; returns the exit status. Throws InputError.
int showRemote(const ViewerSettings& settings);

}  // namespace presa
