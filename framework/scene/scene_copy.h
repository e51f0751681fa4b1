#pragma once
#include <string>
#include <vector>

#include "framework/scene/load.h"

namespace presa {

/// The text of the scene `file` with the overrides written into it, to be stored as `to`. Comments, order and layout
/// stay as they are; only the attributes that an override sets change, and relative paths of meshes, of the rig and of
/// plug-ins' files if `to` lies in another folder. `to` then loads as `file` does with the overrides, for overrides
/// that loadScene accepts, but those of what `file` includes, which its own text does not hold. An unreadable file or
/// an unknown path goes to `diagnostics`, and the text is empty.
std::string sceneCopy(const std::string& file, const std::vector<Override>& overrides, const std::string& to,
                      Diagnostics& diagnostics);
/// Reads a text that is to be stored as `to`, as loadScene would read that file.
Scene readCopy(const std::string& text, const std::string& to, Diagnostics& diagnostics);

}  // namespace presa
