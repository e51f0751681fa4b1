#pragma once
#include <memory>

#include "framework/record/recording.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

namespace presa {

/// Shows a recording with the view that `options` names: in a window until its user has enough, off-screen one moment
/// (RunOptions::screenshot_time; -1: the end) or all of it as a video. Returns the exit status. Throws InputError.
/// Thread: main.
int play(const RecordedSamples& samples, const std::shared_ptr<const World>& world, const RunOptions& options,
         double speed);

}  // namespace presa
