#pragma once
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::check {

enum class FileKind { kScene, kRig, kMotion, kExperiment, kWalls };

/// By the root element, or for a motion of keyframes by the name's end (.csv). A scene, if neither tells: its reader
/// finds what is wrong.
FileKind kindOf(const std::string& file);

/// Checks a rig without a scene: its text, its drivers and their settings' names (E401, E406), and the motions that it names.
/// Returns a line about a good one: "2 devices". Thread: main.
std::string checkRig(const std::string& file, Diagnostics& diagnostics);

/// Checks a motion without rig and scene: phases, or the keyframes of every role. Returns a line about a good one.
std::string checkMotion(const std::string& file, Diagnostics& diagnostics);

/// Checks the walls of a CAVE (framework/walls). Returns a line about good ones: "4 walls".
std::string checkWalls(const std::string& file, Diagnostics& diagnostics);

}  // namespace presa::check
