#pragma once
#include <string>

#include "framework/record/recording.h"

namespace presa::replay_page {

/// Refuses a page that cannot be written, before the work starts: makes its folder, creates and removes a file there.
/// Throws InputError E126.
void checkPlace(const std::string& page);

/// The page of a recording: the motion in 3-D and the plots, linked by one time, then what recordingPage has. Where the
/// recorded scene cannot be loaded again, the plots alone, with the reason. Self-contained: sends no request.
/// `three_js`: the scripts of threeJs(). Thread: main. Throws InputError when a plug-in is missing.
std::string page(const Recording& recording, const RecordedSamples& samples, const std::string& three_js);

}  // namespace presa::replay_page
