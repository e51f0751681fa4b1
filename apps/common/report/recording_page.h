#pragma once
#include <string>
#include <vector>

#include "framework/record/recording.h"

namespace presa {

/// Times at which status bits of the output stages changed, a line each: "12.345 s: device lost, fading".
std::vector<std::string> statusTimeline(const RecordedSamples& samples);

/// Page of a recording: its faults, and each finger's force, penetration, speed and position over time.
std::string recordingPage(const std::string& file, const RecordedSamples& samples);

}  // namespace presa
