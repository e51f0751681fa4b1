#pragma once
#include "framework/geometry/model.h"

namespace presa {

/// Finds the textures that a model names and looks at their heads. Fills in file, width and height. Errors and
/// warnings: importDrawn.
void checkTextures(Model& model, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace presa
