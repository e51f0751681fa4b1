#pragma once
#include <functional>
#include <string>

#include "apps/temple/building/words.h"
#include "apps/temple/kept_session.h"
#include "apps/temple/rebuild.h"
#include "framework/session/load_world.h"

namespace presa::temple {

struct VisitSettings {
  /// Time that the finished building is shown before the visit ends [simulated s]; negative: until the user ends it.
  double finish = -1;
  double time_scale = 0;  ///< simulated seconds per wall-clock second, in lockstep; 0: as fast as possible
  bool quiet = false;     ///< no status line
  /// Idle time after which simulated hands take over, until the visitor's next input [simulated s]; 0: never.
  double attract = 0;
  bool attracting = false;   ///< the simulated hands begin
  std::string folder{};      ///< folder for saving (VisitLog); empty: not saved
  KeptSession start{};       ///< initial state
  std::string language{};    ///< language, for the log
  bool voice = false;        ///< read the sentences about the blocks aloud (Voice)
  bool sound = false;        ///< play stone on stone (sound::Loudspeaker)
  std::string sound_file{};  ///< WAV of it, written at the end; empty: none
  double density = 2000;     ///< of the stones [kg/m³]
  double full_size = 1;      ///< size of the building over that of its model
  std::string counts{};      ///< file to which the visit is added (VisitCounts); empty: none
  TaskWords task{};          ///< `stands`: told when it is complete
  TaskWords next{};          ///< `offers`: told after that, and begun (VisitEnd::onward); empty: no next task
  bool help = true;          ///< help a visitor with a mouse to grasp (GraspHelp); no effect on devices that are felt
  std::function<bool(int placed, int pieces)> progress = {};  ///< called regularly; return false to stop
};

struct VisitEnd {
  Rebuilt rebuilt;
  bool onward = false;  ///< the next task was asked for, or began by itself
  bool again = false;   ///< the simulated hands finished without a visitor: start over with new ruins
};
/// Runs a scene with an <assembly> and fingers until the visit ends, at most for RunOptions::duration. The key u, in
/// the window or on the terminal, undoes a placement. Throws InputError, std::system_error. Thread: main.
VisitEnd visit(Loaded loaded, const VisitSettings& settings);

}  // namespace presa::temple
