#pragma once
#include <string>
#include <vector>

#include "apps/temple/building/block.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// Gives blocks the models of a folder (README.md): Block::model and Block::haptic; the rest stays. Lets this process's
/// scenes name files of the folder. Returns a line for each kind: file, triangles, Hausdorff distance of what is felt. Errors
/// E270, E271 and those of importMesh, with the model's file. Thread: main.
std::vector<std::string> useModels(Building& building, const std::string& folder, Diagnostics& diagnostics);

}  // namespace presa::temple
