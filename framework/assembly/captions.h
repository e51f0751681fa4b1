#pragma once
#include <string>

#include "framework/assembly/assembly_guide.h"

namespace presa {

/// What stands on the screen, in the language of the scene's words; empty: nothing.
struct Captions {
  std::string progress;  ///< "3 of 6 stones stand"
  std::string title;     ///< what is in the hand: "Capital"
  std::string sentence;  ///< about it
  std::string reason;    ///< why it must wait
  std::string hint;      ///< what comes next
  std::string news;      ///< what was just placed, taken out, dropped
  bool good = false;     ///< and that helps
  std::string finish, took;
};
Captions captionsOf(const Scene& scene, const Guidance& guidance);

/// What people call what stands there: the element's name, else the goal's.
std::string calledGoal(const Assembly& assembly, std::int32_t goal);
/// Likewise, of what belongs to no goal the body's name.
std::string calledBody(const Scene& scene, std::int32_t body);
/// "2 min 5 s"
std::string durationText(double seconds);

}  // namespace presa
