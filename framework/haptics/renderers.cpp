#include "framework/haptics/renderers.h"

#include <algorithm>
#include <stdexcept>

#include "framework/haptics/plugin_object.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

/// The element of the renderer's settings; its defaults where the scene has none.
PluginElement settingsOf(const Scene& scene) {
  const std::string& name = scene.haptics.renderer;
  const auto written = std::ranges::find_if(scene.plugin_elements, [&](const PluginElement& element) {
    return element.kind == PluginKind::kRenderer && element.plugin == name;
  });
  if (written != scene.plugin_elements.end()) return *written;
  PluginElement settings{name, "haptics", kNoBody, {}, {scene.file, 0, 0}, PluginKind::kRenderer};
  const Manifest* manifest = findManifest(name);
  if (manifest == nullptr) return settings;
  for (const Manifest::Element& element : manifest->elements) {
    for (const Manifest::Attribute& attribute : element.attributes)
      settings.attributes[attribute.name] = attribute.default_value;
  }
  return settings;
}

}  // namespace

std::unique_ptr<Renderer> makeRenderer(const World& world) {
  const PluginElement settings = settingsOf(world.scene);
  const auto& table = pluginTable<RendererPlugin>(settings.plugin, "presaRendererPlugin");
  return madeFor(settings, [&] {
    auto renderer = table.create(settings, world);
    if (renderer && world.scene.haptics.proxy && renderer->mover() == nullptr)
      throw std::logic_error("its manifest says gives=\"proxy\", but it has no mover");
    return renderer;
  });
}

}  // namespace presa
