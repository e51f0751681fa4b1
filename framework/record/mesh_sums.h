#pragma once
#include <string>
#include <vector>

#include "framework/scene/world.h"

namespace presa {

/// SHA-256 of every mesh file that a scene names, a line "SUM file" for each; empty without meshes. Where the lines would
/// not fit an attribute of a recording: one line "SUM *", the sum of them all. Reads the files. Throws as sha256OfFile.
/// Thread: any but the haptic one.
std::string meshSumsOf(const Scene& scene);

/// In sentences: the meshes of a recorded run that are others today, or missing; none for a recording from before the
/// sums. `scene`: the recording's own. Throws the errors of reading a recording.
std::vector<std::string> changedMeshes(const std::string& recording, const Scene& scene);

}  // namespace presa

/// The function of the record plug-in that reads the recorded sums: meshSumsOf the scene of the run.
extern "C" void presaRecordedMeshSums(const std::string& recording, std::string& sums);
