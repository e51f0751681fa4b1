#include "framework/haptics/material_pair.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace presa {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;

Pair sorted(std::size_t a, std::size_t b) noexcept { return {std::min(a, b), std::max(a, b)}; }

// The scene has been checked: the names are those of materials.
std::size_t find(const std::string& name, const Scene& scene) {
  return static_cast<std::size_t>(std::ranges::find(scene.materials, name, &Material::name) - scene.materials.begin());
}

Pair pairOf(const PluginElement& element, const Scene& scene) {
  return sorted(find(element.text("a"), scene), find(element.text("b"), scene));
}

}  // namespace

MaterialPair::MaterialPair(const PluginElement& element, const Scene& scene) {
  const Pair pair = pairOf(element, scene);
  std::tie(a_, b_) = pair;
  const auto same = std::ranges::count_if(scene.plugin_elements, [&](const PluginElement& other) {
    return other.element == element.element && pairOf(other, scene) == pair;
  });
  if (same > 1)
    throw std::invalid_argument("the scene has " + std::to_string(same) + " <" + element.element + "> of '" +
                                element.text("a") + "' and '" + element.text("b") + "'; one is allowed");
}

bool MaterialPair::holds(const BodyHit& hit, const Scene& scene) const noexcept {
  const auto material = [&](std::int32_t body) { return scene.bodies[static_cast<std::size_t>(body)].material; };
  return sorted(material(hit.A), material(hit.B)) == Pair(a_, b_);
}

}  // namespace presa
