#pragma once
#include <string>

#include "apps/temple/building/scene_text.h"

namespace presa::temple {

/// Writes scene.xml and meshes/ into `folder`, which is made where it is missing; returns the scene's path.
/// Throws InputError (E978) when something other than a folder has that name, std::system_error when a file cannot be written.
std::string writeScene(const Building& building, const SceneSpec& spec, const std::string& folder);

/// E978 when `folder` holds something already and may not be written over.
void checkTarget(const std::string& folder, bool overwrite, Diagnostics& diagnostics);

}  // namespace presa::temple
