#pragma once
#include <string>

#include "framework/scene/frame_state.h"
#include "framework/scene/scene.h"

namespace presa {

/// One sentence about what happens to a frame now, for the screen and the terminal; empty: nothing. First that its tool
/// is lost, then what its user does. A scale other than 1 is said as long as it lasts.
std::string frameSentence(const Frame& frame, const FrameNow& now);

/// One line about a run: how often the frame was moved and had to wait, and how often its tool was lost. Empty for a
/// frame to which neither happens.
std::string frameSummary(const Frame& frame, const FrameNow& last);

}  // namespace presa
