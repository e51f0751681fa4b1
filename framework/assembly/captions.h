#pragma once
#include <string>

#include "framework/assembly/assembly_guide.h"

namespace presa {

/// Texts for the screen, in the language of the scene's words; empty: nothing to show.
struct Captions {
  std::string progress;  ///< "3 of 6 stones stand"
  std::string title;     ///< name of the held body: "Capital"
  std::string sentence;  ///< a sentence about it
  std::string reason;    ///< reason why it must wait
  std::string hint;      ///< suggested next step
  std::string news;      ///< body just placed, taken out or dropped
  bool good = false;     ///< the news is a success
  std::string finish, took;
};
Captions captionsOf(const Scene& scene, const Guidance& guidance);

/// Name of a goal for the user: its element's name, else the goal's.
std::string calledGoal(const Assembly& assembly, std::int32_t goal);
/// Name of a body for the user: the element's name of its goal, else the body's.
std::string calledBody(const Scene& scene, std::int32_t body);
/// "2 min 5 s"
std::string durationText(double seconds);

}  // namespace presa
