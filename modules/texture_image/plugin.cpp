#include "framework/haptics/face_height.h"
#include "modules/texture_image/texture_image.h"

namespace presa {
namespace {

const SurfaceEffectPlugin kPlugin{
    .name = "texture_image",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      requireFlatSides(element, world);
      return element.element == "material_image" ? makeMaterialImage(element) : makeTextureImage(element);
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
