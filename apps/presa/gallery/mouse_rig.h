#pragma once
#include <string>

#include "framework/scene/scene.h"

namespace presa::gallery {

/// A rig for the scene, in which mouse and keys move its first thumb and its first other finger, or its stylus (a role of
/// that name). Further fingers keep their devices of `own`, the scene's rig, as do all if the scene has none to move.
std::string mouseRig(const Scene& scene, const Rig& own);

}  // namespace presa::gallery
