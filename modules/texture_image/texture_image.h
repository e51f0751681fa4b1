#pragma once
#include <memory>

#include "framework/haptics/surface_effect.h"
#include "framework/scene/scene.h"

namespace presa {

/// Heights of an image, <texture_image>. Throws std::invalid_argument: the errors of ImageOnFace, slopes above 1.
std::unique_ptr<SurfaceEffect> makeTextureImage(const PluginElement& element);

/// Shares of a material's stiffness and friction by an image, <material_image>. Throws std::invalid_argument: the errors
/// of ImageOnFace, a stiffness that changes too steeply.
std::unique_ptr<SurfaceEffect> makeMaterialImage(const PluginElement& element, const Material& material);

}  // namespace presa
