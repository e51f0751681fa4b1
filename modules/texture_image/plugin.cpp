#include "framework/haptics/face_height.h"
#include "modules/texture_image/texture_image.h"

namespace presa {
namespace {

const SurfaceEffectPlugin kPlugin{
    .name = "texture_image",
    .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<SurfaceEffect> {
      requireFlatSides(element, world);
      if (element.element != "material_image") return makeTextureImage(element);
      return makeMaterialImage(element,
                               world.scene.materialOf(world.scene.bodies[static_cast<std::size_t>(element.body)]));
    }};

}  // namespace
}  // namespace presa

PRESA_SURFACE_EFFECT_PLUGIN(presa::kPlugin)
