#pragma once
#include <string>

#include "framework/scene/frame_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// One sentence about what a user does with a frame now, for the screen and the terminal; empty: nothing. A scale other
/// than 1 is said as long as it lasts.
std::string frameSentence(const Frame& frame, const FrameNow& now);

/// One line about a run: how often the frame was moved, and how often it had to wait. Empty for a frame that nobody moves.
std::string frameSummary(const Frame& frame, const FrameNow& last);

}  // namespace presa
