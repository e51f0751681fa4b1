#pragma once
#include <string>
#include <vector>

#include "framework/record/recording.h"

namespace presa {

/// Times at which status bits of the output stages changed, a line each: "12.345 s: device lost, fading".
std::vector<std::string> statusTimeline(const RecordedSamples& samples);

/// What a program adds to the page: rules of its style sheet, HTML that follows the heading, and HTML at the end.
struct PagePart {
  std::string style, html, end = {};
};

/// Page of a recording: its faults, and each finger's force, penetration, speed and position over time. `bodies`: names
/// of the bodies in scene order; others are shown by their number.
std::string recordingPage(const std::string& file, const RecordedSamples& samples,
                          const std::vector<std::string>& bodies = {}, const PagePart& part = {});

/// Names of the bodies in the scene of a recording, in scene order; empty if it cannot be read.
std::vector<std::string> bodyNames(const std::string& scene_xml);

}  // namespace presa
