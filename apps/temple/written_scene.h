#pragma once
#include <string>

#include "apps/temple/building/scene_text.h"

namespace presa::temple {

/// Writes scene.xml and meshes/ into `folder`, which is created if it is missing; returns the scene's path. Throws
/// InputError (E978) when `folder` is not a folder, std::system_error when a file cannot be written.
std::string writeScene(const Building& building, const SceneSpec& spec, const std::string& folder);

/// E978 when `folder` is not a folder, or is not empty and `overwrite` is false.
void checkTarget(const std::string& folder, bool overwrite, Diagnostics& diagnostics);

}  // namespace presa::temple
