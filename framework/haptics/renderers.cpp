#include "framework/haptics/renderers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/haptics/plugin_object.h"
#include "framework/scene/manifest.h"

namespace presa {
namespace {

/// The element of a renderer's settings; its defaults where the scene has none.
PluginElement settingsOf(const Scene& scene, const std::string& name, PluginKind kind) {
  const auto written = std::ranges::find_if(scene.plugin_elements, [&](const PluginElement& element) {
    return element.kind == kind && element.plugin == name;
  });
  if (written != scene.plugin_elements.end()) return *written;
  PluginElement settings{name, "haptics", kNoBody, {}, {scene.file, 0, 0}, kind};
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
  const PluginElement settings = settingsOf(world.scene, world.scene.haptics.renderer, PluginKind::kRenderer);
  const auto& table = pluginTable<RendererPlugin>(settings.plugin, "presaRendererPlugin");
  return madeFor(settings, [&] {
    auto renderer = table.create(settings, world);
    if (renderer && world.scene.haptics.proxy && renderer->mover() == nullptr)
      throw std::logic_error("its manifest says gives=\"proxy\", but it has no mover");
    return renderer;
  });
}

std::unique_ptr<ToolRenderer> makeToolRenderer(const World& world) {
  const PluginElement settings = settingsOf(world.scene, world.scene.haptics.tool_renderer, PluginKind::kToolRenderer);
  const auto& table = pluginTable<ToolRendererPlugin>(settings.plugin, "presaToolRendererPlugin");
  return madeFor(settings, [&] { return table.create(settings, world); });
}

std::vector<ToolField> toolFieldsOf(const World& world) {
  const PluginElement settings = settingsOf(world.scene, world.scene.haptics.tool_renderer, PluginKind::kToolRenderer);
  const auto& table = pluginTable<ToolRendererPlugin>(settings.plugin, "presaToolRendererPlugin");
  if (table.fields == nullptr) return {};
  return *madeFor(settings, [&] { return std::make_unique<std::vector<ToolField>>(table.fields(settings, world)); });
}

bool keepsContract(const BoundedList<ToolForce>& forces, const Pose& X_WT, const Touchables& touchables) noexcept {
  double sum = X_WT.p.sum() + X_WT.q.coeffs().sum();
  bool touchable = true;
  for (const ToolForce& one : forces) {
    sum += one.p_W.sum() + one.nhat_W.sum() + one.f_W.sum() + one.stiffness;
    touchable = touchable && one.stiffness > 0 && touchables.has(one.body);
  }
  return std::isfinite(sum) && touchable;
}

bool keepsContract(const ProxyContact& contact, const BoundedList<RenderedContact>& own,
                   const Touchables& touchables) noexcept {
  const ProxyState& state = contact.state;
  // a number that is not finite makes the sum so
  double sum = contact.depth + contact.x.sum() + state.x.sum() + state.god_object.sum() + contact.nhat.sum();
  bool touchable = !state.touching || touchables.has(contact.body);
  for (int a = 0; a < contact.active.count; ++a) {
    const ActiveSet::Member& member = contact.active.member[static_cast<std::size_t>(a)];
    sum += member.weight + member.nhat.sum();
    touchable = touchable && touchables.has(member.body);
  }
  for (const RenderedContact& one : own) {
    sum += one.depth + one.nhat.sum();
    touchable = touchable && one.depth > 0 && touchables.has(one.body);
  }
  return std::isfinite(sum) && touchable;
}

ProxyContact contactOf(const ProxyMove& moved, const Vec3& g) noexcept {
  ProxyContact contact;
  contact.x = contact.state.x = contact.state.god_object = moved.x;
  contact.depth = (moved.x - g).norm();
  if (!moved.touching || !(contact.depth > 0)) {
    contact.depth = 0;
    return contact;
  }
  contact.state.touching = contact.state.slipping = true;
  contact.first_touch = moved.first_touch;
  contact.body = moved.body;
  contact.nhat = (moved.x - g) / contact.depth;
  contact.active = moved.active;
  return contact;
}

}  // namespace presa
