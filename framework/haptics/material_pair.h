#pragma once
#include <stdexcept>

#include "framework/haptics/body_hits.h"
#include "framework/scene/plugin_element.h"
#include "framework/scene/scene.h"

namespace presa {

/// The pair of materials that an element names by its attributes `a` and `b`.
class MaterialPair {
 public:
  /// Throws std::invalid_argument (E596) for a material that the scene does not have.
  MaterialPair(const PluginElement& element, const Scene& scene)
      : a_(find(element.text("a"), scene)), b_(find(element.text("b"), scene)) {}

  /// Whether the two bodies of the hit are of these materials.
  bool holds(const BodyHit& hit, const Scene& scene) const noexcept {
    const std::size_t A = materialOf(hit.A, scene), B = materialOf(hit.B, scene);
    return (A == a_ && B == b_) || (A == b_ && B == a_);
  }

 private:
  static std::size_t materialOf(std::int32_t body, const Scene& scene) noexcept {
    return scene.bodies[static_cast<std::size_t>(body)].material;
  }
  static std::size_t find(const std::string& name, const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
      if (scene.materials[i].name == name) return i;
    std::string all;
    for (const Material& material : scene.materials) all += (all.empty() ? "" : ", ") + material.name;
    throw std::invalid_argument("the scene has no material '" + name + "'; it has " + all);
  }

  std::size_t a_, b_;
};

}  // namespace presa
