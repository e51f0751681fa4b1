#pragma once
#include <functional>
#include <string>

#include "apps/temple/kept_session.h"
#include "apps/temple/rebuild.h"
#include "framework/session/load_world.h"

namespace presa::temple {

struct VisitSettings {
  /// Over when all stands and the finish has been shown for so long [simulated s]; negative: when the user ends it.
  double finish = -1;
  double time_scale = 0;  ///< simulated seconds in one of the clock, in lockstep; 0: as fast as the machine goes
  bool quiet = false;     ///< no status line
  /// Simulated seconds without a touch after which simulated hands take over, until somebody touches anything; 0: never.
  double attract = 0;
  bool attracting = false;                                    ///< they have it from the start
  std::string folder;                                         ///< where the visit is kept (VisitLog); empty: nowhere
  KeptSession start;                                          ///< what it starts with
  std::string language;                                       ///< for the log
  std::function<bool(int placed, int pieces)> progress = {};  ///< called now and then; false stops
};

struct VisitEnd {
  Rebuilt rebuilt;
  bool again = false;  ///< the hands have put all together, and nobody came: time for other ruins
};
/// Runs a scene with an <assembly> and fingers, whoever moves them: until it is over, or for RunOptions::duration. Undo by the key u, in the
/// window or on the terminal. Throws InputError, std::system_error. Thread: main.
VisitEnd visit(const Loaded& loaded, const VisitSettings& settings);

}  // namespace presa::temple
