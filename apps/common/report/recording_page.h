#pragma once
#include <string>
#include <vector>

#include "framework/record/recording.h"

namespace presa {

/// When the bits of the output stages came and went, a line each: "12.345 s: device lost, fading".
std::vector<std::string> statusTimeline(const RecordedSamples& samples);

/// A recording to be looked at: what went wrong, and each finger's force, penetration, speed and place over time.
std::string recordingPage(const std::string& file, const RecordedSamples& samples);

}  // namespace presa
